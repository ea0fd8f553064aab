// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/examination.hpp"

#include <algorithm>
#include <utility>

#include "tools/doctor/can.hpp"
#include "tools/doctor/encoder.hpp"
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

/// What every part needs to know.
struct Situation {
  const Machine& machine;
  const Robot& robot;
  const Ports& ports;
  const Patience& patience;
  Caller caller;
  bool has_daemon = false;
  bool is_probing = false;

  bool may_open() const { return is_probing || !has_daemon; }
};

std::vector<Check> examine_scanner(const Situation& at) {
  Report report;
  const auto checks = judge(look_for_scanners(at.machine), at.robot.scanner, at.caller, at.has_daemon);
  report.add(checks);
  if (!at.ports.scanner) return report.take();
  if (!at.may_open()) {
    report.add(skipped("scanner-answer", kBusy));
  } else if (!has_failure(checks)) {
    const auto answer = ask_scanner(*at.ports.scanner, at.ports.now, at.robot.lidar, at.patience.scanner);
    report.add(judge(answer, at.robot.scanner.serial));
  }
  return report.take();
}

std::vector<Check> examine_can(const Situation& at) {
  Report report;
  const auto checks = judge(look_at_can(at.robot.can_interface));
  report.add(checks);
  if (!at.ports.can || has_failure(checks)) return report.take();
  if (const auto port = at.ports.can()) {
    report.add(judge(listen_for_drive(**port, at.robot.drive_node, at.is_probing, at.patience.drive, at.ports.now)));
  } else {
    report.add(failure("drive", port.error(), "see can-link above"));
  }
  return report.take();
}

std::vector<Check> examine_encoder(const Situation& at) {
  if (!at.robot.encoder) return {skipped("encoder", "not wanted: disk.angle_source is the drive")};
  Report report;
  const auto checks = judge(look_at_encoder(at.machine, *at.robot.encoder), at.caller, at.has_daemon);
  report.add(checks);
  if (!at.ports.encoder || has_failure(checks)) return report.take();
  if (!at.may_open()) {
    report.add(skipped("encoder-counts", kBusy));
  } else if (const auto port = at.ports.encoder()) {
    CountFacts counts = count_edges(**port, at.patience.encoder, at.ports.now);
    counts.rate_problem =
        drivers::edge_rate_problem(*at.robot.encoder, at.robot.disk_speed_rad_s, (*port)->queued_edges());
    report.add(judge(counts));
  } else {
    report.add(failure("encoder-counts", port.error(), "see encoder-access and encoder-lines above"));
  }
  return report.take();
}

}  // namespace

std::vector<Check> examine(const Machine& machine, const Robot& robot, const Ports& ports, const Patience& patience,
                           bool is_probing) {
  const InstallationFacts installation = look_at_installation(machine);
  const BusFacts bus = listen_on_bus(robot.lcm, patience.daemon);
  const Situation at{.machine = machine,
                     .robot = robot,
                     .ports = ports,
                     .patience = patience,
                     .caller = look_at_caller(machine),
                     .has_daemon = bus.health.has_value() || !installation.daemons.empty(),
                     .is_probing = is_probing};
  Report report;
  report.add(judge(installation));
  report.add(judge(look_at_lcm(machine, robot.lcm.url)));
  report.add(judge(bus, installation.daemons));
  report.add(examine_scanner(at));
  report.add(examine_can(at));
  report.add(examine_encoder(at));
  return report.take();
}

}  // namespace stairway::doctor
