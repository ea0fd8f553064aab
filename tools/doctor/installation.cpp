// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/installation.hpp"

#include <algorithm>
#include <initializer_list>

namespace stairway::doctor {
namespace {

constexpr const char* kRules = "60-stairway.rules";
constexpr const char* kUnit = "stairwayd.service";
constexpr const char* kInstall = "install the programs (cmake --install, or the package)";

std::optional<std::string> first_of(const Machine& machine, std::initializer_list<std::string> folders,
                                    const std::string& name) {
  for (const std::string& folder : folders) {
    if (machine.has(folder + "/" + name)) return folder + "/" + name;
  }
  return std::nullopt;
}

bool has_account(const Machine& machine, std::string_view name) {
  const auto lines = machine.lines("/etc/passwd");
  const std::string start = std::string(name) + ":";
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(start); });
}

Check judge_rules(const InstallationFacts& facts) {
  if (facts.rules_file) return ok("udev-rules", *facts.rules_file);
  return failure("udev-rules", std::string(kRules) + " is not installed",
                 std::string(kInstall) + ", then udevadm control --reload && udevadm trigger");
}

Check judge_accounts(const InstallationFacts& facts) {
  if (facts.has_account && facts.has_group && facts.has_gpio_group) {
    return ok("accounts", "account stairway and groups stairway, gpio exist");
  }
  std::string missing;
  if (!facts.has_account) missing += " account stairway,";
  if (!facts.has_group) missing += " group stairway,";
  if (!facts.has_gpio_group) missing += " group gpio,";
  missing.pop_back();
  return failure("accounts", "missing:" + missing, "run systemd-sysusers, which reads stairway.conf of sysusers.d");
}

Check judge_service(const InstallationFacts& facts) {
  if (!facts.unit_file) return warning("service", std::string(kUnit) + " is not installed", kInstall);
  const std::string running = facts.daemons.empty() ? "not running" : "running, " + to_string(facts.daemons.front());
  if (!facts.is_enabled) {
    return warning("service", *facts.unit_file + ", not started at boot, " + running,
                   "systemctl enable --now stairwayd");
  }
  if (facts.daemons.empty()) {
    return warning("service", *facts.unit_file + ", enabled, " + running,
                   "systemctl start stairwayd, and journalctl -u stairwayd says why it ended");
  }
  return ok("service", *facts.unit_file + ", enabled, " + running);
}

Check judge_modem_manager(const InstallationFacts& facts) {
  if (facts.modem_managers.empty()) return ok("modem-manager", "not running");
  if (facts.rules_file) return ok("modem-manager", "running, and told by the udev rules to leave scanners alone");
  return warning("modem-manager", "running: it may send its own commands to the scanner",
                 std::string("install ") + kRules + ", which tells it to leave scanners alone");
}

}  // namespace

InstallationFacts look_at_installation(const Machine& machine) {
  InstallationFacts facts;
  facts.rules_file = first_of(
      machine, {"/etc/udev/rules.d", "/run/udev/rules.d", "/usr/local/lib/udev/rules.d", "/usr/lib/udev/rules.d"},
      kRules);
  facts.has_account = has_account(machine, "stairway");
  facts.has_group = group_id(machine, "stairway").has_value();
  facts.has_gpio_group = group_id(machine, "gpio").has_value();
  facts.unit_file = first_of(
      machine,
      {"/etc/systemd/system", "/run/systemd/system", "/usr/local/lib/systemd/system", "/usr/lib/systemd/system"},
      kUnit);
  // The link's target may lie outside of what is seen here.
  const auto enabled = machine.names("/etc/systemd/system/multi-user.target.wants");
  facts.is_enabled = std::find(enabled.begin(), enabled.end(), kUnit) != enabled.end();
  facts.daemons = processes_named(machine, "stairwayd");
  facts.modem_managers = processes_named(machine, "ModemManager");
  return facts;
}

std::vector<Check> judge(const InstallationFacts& facts) {
  return {judge_rules(facts), judge_accounts(facts), judge_service(facts), judge_modem_manager(facts)};
}

}  // namespace stairway::doctor
