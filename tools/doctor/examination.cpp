// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/examination.hpp"

#include <algorithm>
#include <utility>

#include "tools/doctor/can.hpp"
#include "tools/doctor/installation.hpp"
#include "tools/doctor/lcm.hpp"
#include "tools/doctor/scanner_answer.hpp"

namespace stairway::doctor {
namespace {

constexpr const char* kBusy = "not asked: stairwayd is running and tells its health; systemctl stop stairwayd to ask";

/// Checks in the order in which they are made.
class Report {
 public:
  void add(Check check) { checks_.push_back(std::move(check)); }
  void add(std::vector<Check> checks) { std::move(checks.begin(), checks.end(), std::back_inserter(checks_)); }
  std::vector<Check> take() { return std::move(checks_); }

 private:
  std::vector<Check> checks_;
};

bool has_failure(const std::vector<Check>& checks) {
  return std::any_of(checks.begin(), checks.end(), [](const Check& check) { return check.state == State::Failure; });
}

}  // namespace

std::vector<Check> examine(const Machine& machine, const Robot& robot, const Ports& ports, const Patience& patience,
                           bool is_probing) {
  Report report;
  const Caller caller = look_at_caller(machine);
  const InstallationFacts installation = look_at_installation(machine);
  const BusFacts bus = listen_on_bus(robot.lcm, patience.daemon);
  const bool has_daemon = bus.health.has_value() || !installation.daemons.empty();
  const bool may_open = is_probing || !has_daemon;
  report.add(judge(installation));
  report.add(judge(look_at_lcm(machine, robot.lcm.url)));
  report.add(judge(bus, installation.daemons));

  const auto scanner = judge(look_for_scanners(machine), robot.scanner, caller, has_daemon);
  report.add(scanner);
  if (ports.scanner && !may_open) {
    report.add(skipped("scanner-answer", kBusy));
  } else if (ports.scanner && !has_failure(scanner)) {
    report.add(judge(ask_scanner(*ports.scanner, ports.now, robot.lidar, patience.scanner), robot.scanner.serial));
  }

  const auto can = judge(look_at_can(robot.can_interface));
  report.add(can);
  if (ports.can && !has_failure(can)) {
    const auto port = ports.can();
    if (!port) report.add(failure("drive", port.error(), "see can-link above"));
    if (port) report.add(judge(listen_for_drive(**port, robot.drive_node, is_probing, patience.drive, ports.now)));
  }

  const auto encoder = judge(look_at_encoder(machine, robot.encoder), robot.encoder, caller, has_daemon);
  report.add(encoder);
  if (ports.encoder && !robot.encoder.chip.empty() && !may_open) {
    report.add(skipped("encoder-counts", kBusy));
  } else if (ports.encoder && !robot.encoder.chip.empty() && !has_failure(encoder)) {
    const auto port = ports.encoder();
    if (!port) report.add(failure("encoder-counts", port.error(), "see encoder-access and encoder-lines above"));
    if (port) report.add(judge(count_edges(**port, patience.encoder, ports.now)));
  }
  return report.take();
}

}  // namespace stairway::doctor
