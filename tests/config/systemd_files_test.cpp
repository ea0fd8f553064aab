// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/config/command.hpp"

namespace stairway::config {
namespace {

constexpr const char* kRules = STAIRWAY_SOURCE_DIR "/systemd/60-stairway.rules";

struct Term {
  std::string key;  // with its braces, e.g. ATTR{idVendor}
  std::string op;
  std::string value;
  bool is_match() const { return op == "==" || op == "!="; }
};
using Rule = std::vector<Term>;
using Properties = std::map<std::string, std::string>;

/// The terms of a rule; empty when something in it is no term.
std::optional<Rule> parse_rule(const std::string& line) {
  static const std::regex kTerm(R"re(\s*([A-Z_]+(?:\{[A-Za-z_]+\})?)(==|!=|\+=|:=|=)"([^"]*)"\s*(,|$))re");
  Rule rule;
  for (auto at = line.begin(); at != line.end();) {
    std::smatch found;
    if (!std::regex_search(at, line.end(), found, kTerm, std::regex_constants::match_continuous)) return std::nullopt;
    rule.push_back({found[1], found[2], found[3]});
    at = found[0].second;
  }
  return rule;
}

std::vector<Rule> shipped_rules() {
  std::vector<Rule> rules;
  std::ifstream file(kRules);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const auto rule = parse_rule(line);
    EXPECT_TRUE(rule) << line;
    if (rule) rules.push_back(*rule);
  }
  return rules;
}

bool fits(const Term& term, const Properties& device) {
  const auto found = device.find(term.key);
  const std::string value = found == device.end() ? "" : found->second;
  const bool is_pattern = term.value.ends_with('*');
  const bool is_equal =
      is_pattern ? value.starts_with(term.value.substr(0, term.value.size() - 1)) : value == term.value;
  return is_equal == (term.op == "==");
}

/// What the rules assign to a device.
Properties assigned(const Properties& device) {
  Properties result;
  for (const Rule& rule : shipped_rules()) {
    bool is_for_it = true;
    for (const Term& term : rule) is_for_it = is_for_it && (!term.is_match() || fits(term, device));
    for (const Term& term : rule) {
      if (is_for_it && !term.is_match()) result[term.key] = term.value;
    }
  }
  return result;
}

const Properties kIgnoredScanner{{"GROUP", "stairway"}, {"MODE", "0660"}, {"ENV{ID_MM_DEVICE_IGNORE}", "1"}};

TEST(UdevRules, give_the_scanner_to_the_daemon_and_not_to_modem_manager) {
  EXPECT_EQ(assigned({{"SUBSYSTEM", "usb"}, {"ENV{DEVTYPE}", "usb_device"}, {"ATTR{idVendor}", "15d1"}}),
            kIgnoredScanner);
  Properties tty = kIgnoredScanner;
  tty["ENV{ID_MM_PORT_IGNORE}"] = "1";
  EXPECT_EQ(assigned({{"SUBSYSTEM", "tty"}, {"ATTRS{idVendor}", "15d1"}}), tty);
}

TEST(UdevRules, give_the_lines_of_gpio_chips_to_their_group) {
  EXPECT_EQ(assigned({{"SUBSYSTEM", "gpio"}, {"KERNEL", "gpiochip4"}}),
            (Properties{{"GROUP", "gpio"}, {"MODE", "0660"}}));
}

TEST(UdevRules, lengthen_the_queue_of_can_interfaces) {
  EXPECT_EQ(assigned({{"SUBSYSTEM", "net"}, {"ACTION", "add"}, {"ATTR{type}", "280"}}),
            (Properties{{"ATTR{tx_queue_len}", "100"}}));
}

TEST(UdevRules, leave_everything_else_alone) {
  for (const Properties& device : {
           Properties{{"SUBSYSTEM", "usb"}, {"ENV{DEVTYPE}", "usb_device"}, {"ATTR{idVendor}", "1d6b"}},
           Properties{{"SUBSYSTEM", "usb"}, {"ENV{DEVTYPE}", "usb_interface"}, {"ATTR{idVendor}", "15d1"}},
           Properties{{"SUBSYSTEM", "tty"}, {"ATTRS{idVendor}", "0403"}},
           Properties{{"SUBSYSTEM", "net"}, {"ACTION", "add"}, {"ATTR{type}", "1"}},
           Properties{{"SUBSYSTEM", "gpio"}, {"KERNEL", "gpio17"}},
       })
    EXPECT_EQ(assigned(device), Properties{});
}

TEST(UdevRules, come_before_those_of_modem_manager) {
  EXPECT_LT(std::string(kRules).substr(std::string(kRules).rfind('/') + 1), "77-mm");
}

// udevadm has no way to look at a single file, so it finds this one in the folder of a mount namespace.
TEST(UdevRules, hold_nothing_that_udev_does_not_know) {
  if (!has_program("udevadm")) GTEST_SKIP() << "no udevadm here";
  if (run("unshare -m mount -t tmpfs none /run").exit_code != 0) GTEST_SKIP() << "no mount namespaces here";
  const std::string script = "mount -t tmpfs none /run && mkdir -p /run/udev/rules.d && cp " + std::string(kRules) +
                             " /run/udev/rules.d && udevadm test /sys/class/net/lo";
  const CommandResult result = run("SYSTEMD_LOG_LEVEL=debug unshare -m sh -c '" + script + "'");
  ASSERT_NE(result.output.find("Reading rules file: /run/udev/rules.d/60-stairway.rules"), std::string::npos)
      << result.output;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    const bool is_complaint = line.find("60-stairway.rules:") != std::string::npos;
    // The groups come with the installation.
    EXPECT_TRUE(!is_complaint || line.find("Unknown group") != std::string::npos) << line;
  }
}

TEST(Sysctl, is_one_setting_in_bytes) {
  std::ifstream file(STAIRWAY_SOURCE_DIR "/systemd/60-stairway-sysctl.conf");
  std::vector<std::string> settings;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && !line.starts_with('#')) settings.push_back(line);
  }
  EXPECT_EQ(settings, std::vector<std::string>{"net.core.rmem_max = 8388608"});
}

}  // namespace
}  // namespace stairway::config
