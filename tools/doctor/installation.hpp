// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/doctor/check.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::doctor {

/// What `cmake --install` and systemd have put in place.
struct InstallationFacts {
  std::optional<std::string> rules_file;  ///< where 60-stairway.rules is
  bool has_account = false;               ///< stairway in /etc/passwd
  bool has_group = false;                 ///< stairway in /etc/group
  bool has_gpio_group = false;
  std::optional<std::string> unit_file;  ///< where stairwayd.service is
  bool is_enabled = false;
  std::vector<ProcessFacts> daemons;         ///< running stairwayd
  std::vector<ProcessFacts> modem_managers;  ///< running ModemManager
};
InstallationFacts look_at_installation(const Machine& machine);

/// udev-rules, accounts, service, modem-manager.
std::vector<Check> judge(const InstallationFacts& facts);

}  // namespace stairway::doctor
