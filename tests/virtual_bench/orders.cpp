// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/orders.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>

namespace stairway::bench {
namespace {

constexpr std::uint16_t kOvercurrent = 0x2310;

using Order = std::function<std::string(Robot&)>;

Order doing(void (*action)(Robot&)) {
  return [action](Robot& robot) {
    action(robot);
    return std::string("done");
  };
}

Order injecting(sim::SensorFault fault) {
  return [fault](Robot& robot) {
    robot.scanner.inject(fault);
    return std::string("done");
  };
}

const std::map<std::string, Order>& orders() {
  static const std::map<std::string, Order> kOrders{
      {"disk speed", [](Robot& robot) { return fmt::format("{:.4f}", robot.motion.speed_at(now_ns())); }},
      {"drive state", [](Robot& robot) { return std::string(drivers::to_string(robot.drive.state())); }},
      {"drive fault", doing([](Robot& robot) { robot.drive.raise_fault(kOvercurrent, now_ns()); })},
      {"drive fault-stays", doing([](Robot& robot) {
         robot.drive.faults().is_fault_stuck = true;
         robot.drive.raise_fault(kOvercurrent, now_ns());
       })},
      {"drive silent", doing([](Robot& robot) { robot.drive.faults().is_silent = true; })},
      {"drive mend", doing([](Robot& robot) { robot.drive.faults() = {}; })},
      {"drive power-cycle", doing([](Robot& robot) { robot.drive.power_cycle(now_ns()); })},
      {"encoder dead", doing([](Robot& robot) { robot.is_encoder_dead = true; })},
      {"encoder mend", doing([](Robot& robot) { robot.is_encoder_dead = false; })},
      {"scanner streaming", [](Robot& robot) { return std::string(robot.scanner.is_streaming() ? "yes" : "no"); }},
      {"scanner garbage", injecting(sim::SensorFault::Garbage)},
      {"scanner laser-fault", injecting(sim::SensorFault::LaserFault)},
      {"scanner stuck", injecting(sim::SensorFault::Stuck)},
  };
  return kOrders;
}

}  // namespace

std::string obey(Robot& robot, const std::string& order) {
  const auto known = orders().find(order);
  if (known == orders().end()) return "unknown order; there are:\n" + list_of_orders();
  const std::lock_guard lock(robot.mutex);
  robot.drive.advance(now_ns());
  return known->second(robot);
}

std::string list_of_orders() {
  std::string list;
  for (const auto& [name, order] : orders()) list += name + "\n";
  return list;
}

}  // namespace stairway::bench
