// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
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

/// Takes as many of these characters as the text begins with.
std::string take_while(std::string_view& text, std::string_view characters) {
  const std::string taken(text.substr(0, text.find_first_not_of(characters)));
  text.remove_prefix(taken.size());
  return taken;
}

/// One term of a rule like `ATTR{idVendor}=="15d1"`, taken off the text; empty when it does not begin with one.
std::optional<Term> take_term(std::string_view& text) {
  static constexpr std::string_view kKey = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_{}abcdefghijklmnopqrstuvwxyz";
  Term term;
  take_while(text, " ");
  term.key = take_while(text, kKey);
  term.op = take_while(text, "=!+:");
  const bool is_known = term.op == "==" || term.op == "!=" || term.op == "+=" || term.op == ":=" || term.op == "=";
  if (term.key.empty() || !is_known || !text.starts_with('"')) return std::nullopt;
  text.remove_prefix(1);
  const std::size_t end = text.find('"');
  if (end == std::string_view::npos) return std::nullopt;
  term.value = text.substr(0, end);
  text.remove_prefix(end + 1);
  take_while(text, " ");
  if (!text.empty() && !text.starts_with(',')) return std::nullopt;
  text.remove_prefix(text.empty() ? 0 : 1);
  return term;
}

/// The terms of a rule; empty when something in it is no term.
std::optional<Rule> parse_rule(std::string_view line) {
  Rule rule;
  while (!line.empty()) {
    auto term = take_term(line);
    if (!term) return std::nullopt;
    rule.push_back(std::move(*term));
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
