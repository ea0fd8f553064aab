// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/machine.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tests/virtual_bench/order_socket.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

constexpr const char* kOrders = "/run/fake_robot";

std::filesystem::path modules() {
  const char* folder = std::getenv("STAIRWAY_BENCH_MODULES");
  if (folder == nullptr) throw std::runtime_error("not in the virtual machine; start tests/virtual_bench/run");
  return folder;
}

}  // namespace

Machine& Machine::get() {
  static Machine machine;
  return machine;
}

Machine::Machine() : rig_(modules()) {
  rig_.plug_scanner();
  rig_.add_bus();
  rig_.add_encoder_chip();
  robot_ = std::make_unique<test::DaemonProcess>(
      std::vector<std::string>{"--table", SCAN_TABLE, "--tty", Rig::kTty, "--can", Rig::kBus, "--socket", kOrders},
      std::vector<std::string>{}, FAKE_ROBOT);
  if (!robot_->has_said("ready", 20s)) throw std::runtime_error("fake_robot: " + robot_->output());
}

std::string Machine::order(const std::string& text) const { return send_order(kOrders, text); }

}  // namespace stairway::bench
