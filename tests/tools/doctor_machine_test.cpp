// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/fake_machine.hpp"
#include "tools/doctor/check.hpp"
#include "tools/doctor/installation.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::doctor {
namespace {

using test::FakeMachine;

TEST(DoctorReport, exit_code_is_that_of_the_worst_check) {
  const Check good = ok("a", "fine"), unseen = skipped("b", "not looked at");
  const Check poor = warning("c", "so so", "do this"), bad = failure("d", "broken", "do that");
  using Checks = std::vector<Check>;
  for (const auto& [checks, code] :
       {std::pair<Checks, int>{{}, 0}, {{good, unseen}, 0}, {{good, poor, unseen}, 1}, {{bad, poor, good}, 2}}) {
    EXPECT_EQ(exit_code(checks), code) << to_text(checks);
  }
}

TEST(DoctorReport, text_has_a_line_for_each_check_with_what_to_do) {
  const std::vector<Check> checks{ok("lcm-url", "fine"), failure("can", "none", "modprobe can-raw")};
  EXPECT_EQ(to_text(checks), "ok       lcm-url  fine\nfailure  can      none -> modprobe can-raw\n");
}

TEST(DoctorReport, json_is_one_object_even_of_texts_that_are_no_utf8) {
  const std::vector<Check> checks{warning("scanner", "named \xff\"", "plug it in")};
  const std::string text = to_json(checks);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto object = nlohmann::json::parse(text);
  EXPECT_EQ(object["state"], "warning");
  ASSERT_EQ(object["checks"].size(), 1U);
  EXPECT_EQ(object["checks"][0]["name"], "scanner");
  EXPECT_EQ(object["checks"][0]["state"], "warning");
  EXPECT_EQ(object["checks"][0]["remedy"], "plug it in");
}

TEST(DoctorMachine, what_is_not_there_is_absent_and_no_error) {
  const Machine machine("/nonexistent");
  EXPECT_FALSE(machine.has("/sys"));
  EXPECT_FALSE(machine.line("/etc/group"));
  EXPECT_FALSE(machine.number("/proc/sys/net/core/rmem_max"));
  EXPECT_TRUE(machine.names("/dev").empty());
  EXPECT_FALSE(machine.link_name("/sys/driver"));
  EXPECT_FALSE(look_at_node(machine, "/dev/gpiochip0").exists);
  EXPECT_TRUE(processes_named(machine, "stairwayd").empty());
}

TEST(DoctorMachine, tells_nodes_by_group_and_mode) {
  FakeMachine fake;
  fake.name_own_group("stairway");
  fake.node("/dev/open", 0660);
  fake.node("/dev/closed", 0600);
  const NodeFacts open = look_at_node(fake.machine(), "/dev/open");
  EXPECT_TRUE(open.exists && open.is_usable && open.is_open_to_group);
  EXPECT_EQ(open.group, "stairway");
  EXPECT_FALSE(look_at_node(fake.machine(), "/dev/closed").is_open_to_group);
}

TEST(DoctorMachine, finds_the_programs_that_have_a_node_open) {
  FakeMachine fake;
  fake.process(12, "stairwayd", "/dev/bus/usb/001/004");
  fake.process(13, "cat", "/dev/ttyACM0");
  fake.process(14, "stairwayd");
  const auto holders = processes_holding(fake.machine(), "/dev/ttyACM0");
  ASSERT_EQ(holders.size(), 1U);
  EXPECT_EQ(to_string(holders.front()), "cat (process 13)");
  EXPECT_EQ(processes_named(fake.machine(), "stairwayd").size(), 2U);
}

std::string states(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks)
    text += std::string(text.empty() ? "" : " ") + check.name + "=" + to_string(check.state);
  return text;
}

TEST(DoctorInstallation, an_empty_machine_has_nothing_installed) {
  EXPECT_EQ(states(judge(look_at_installation(FakeMachine().machine()))),
            "udev-rules=failure accounts=failure service=warning modem-manager=ok");
}

TEST(DoctorInstallation, an_installed_and_running_daemon_is_well) {
  FakeMachine fake;
  fake.file("/usr/lib/udev/rules.d/60-stairway.rules", "");
  fake.file("/etc/group", "root:x:0:\nstairway:x:999:\ngpio:x:998:stairway\n");
  fake.file("/etc/passwd", "root:x:0:0::/root:/bin/bash\nstairway:x:999:999::/:/usr/sbin/nologin\n");
  fake.file("/usr/local/lib/systemd/system/stairwayd.service", "");
  fake.file("/etc/systemd/system/multi-user.target.wants/stairwayd.service", "");
  fake.process(77, "stairwayd");
  fake.process(78, "ModemManager");
  const auto checks = judge(look_at_installation(fake.machine()));
  EXPECT_EQ(states(checks), "udev-rules=ok accounts=ok service=ok modem-manager=ok");
  EXPECT_NE(checks[2].text.find("process 77"), std::string::npos) << checks[2].text;
}

TEST(DoctorInstallation, every_missing_part_has_its_own_remedy) {
  InstallationFacts good{.rules_file = "/r",
                         .has_account = true,
                         .has_group = true,
                         .has_gpio_group = true,
                         .unit_file = "/u",
                         .is_enabled = true,
                         .daemons = {{1, "stairwayd"}},
                         .modem_managers = {}};
  const auto first_fault = [](const InstallationFacts& facts) {
    for (const Check& check : judge(facts)) {
      if (check.state != State::Ok) return check.name + ": " + check.text + " -> " + check.remedy;
    }
    return std::string("none");
  };
  EXPECT_EQ(first_fault(good), "none");
  const auto expect = [&](auto change, const std::string& part) {
    InstallationFacts facts = good;
    change(facts);
    EXPECT_NE(first_fault(facts).find(part), std::string::npos) << first_fault(facts);
  };
  expect([](auto& f) { f.rules_file.reset(); }, "udevadm control --reload");
  expect([](auto& f) { f.has_account = false; }, "missing: account stairway -> run systemd-sysusers");
  expect([](auto& f) { f.has_gpio_group = false; }, "missing: group gpio ->");
  expect([](auto& f) { f.is_enabled = false; }, "systemctl enable --now stairwayd");
  expect([](auto& f) { f.daemons.clear(); }, "systemctl start stairwayd");
  expect([](auto& f) { f.rules_file.reset(), f.modem_managers = {{2, "ModemManager"}}; }, "udev-rules");
}

TEST(DoctorInstallation, modem_manager_without_the_rule_is_a_warning) {
  InstallationFacts facts;
  facts.modem_managers = {{2, "ModemManager"}};
  const auto checks = judge(facts);
  EXPECT_EQ(checks.back().name, "modem-manager");
  EXPECT_EQ(checks.back().state, State::Warning);
}

}  // namespace
}  // namespace stairway::doctor
