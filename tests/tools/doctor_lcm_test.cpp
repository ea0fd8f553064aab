// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/fake_machine.hpp"
#include "tools/doctor/examination.hpp"
#include "tools/doctor/lcm.hpp"

namespace stairway::doctor {
namespace {

using test::FakeMachine;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

const Check& check_named(const std::vector<Check>& checks, const std::string& name) {
  static const Check kNone;
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return check.name == name; });
  return found == checks.end() ? kNone : *found;
}

TEST(DoctorLcmUrl, is_read_as_lcm_does) {
  const auto url = parse_udpm_url("udpm://239.1.2.3:1234?ttl=1&recv_buf_size=4194304");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->address, "239.1.2.3");
  EXPECT_EQ(url->port, 1234);
  EXPECT_EQ(url->ttl, 1);
  EXPECT_EQ(url->receive_buffer_bytes, 4194304);
  EXPECT_TRUE(url->is_multicast());
  const auto bare = parse_udpm_url("udpm://");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->address, "239.255.76.67");
  EXPECT_EQ(bare->port, 7667);
}

TEST(DoctorLcmUrl, refuses_what_is_none) {
  for (const char* url : {"", "memq://", "udpm:/", "udpm://host:1", "udpm://239.1.2.3:0", "udpm://239.1.2.3:99999",
                          "udpm://239.1.2.3:12x", "udpm://239.1.2.3?ttl=", "udpm://239.1.2.3?ttl=-1",
                          "udpm://239.1.2.3?ttl=256", "udpm://239.1.2.3?recv_buf_size=big", "udpm://1.2.3"})
    EXPECT_FALSE(parse_udpm_url(url)) << url;
}

TEST(DoctorLcm, the_longest_prefix_is_the_route) {
  FakeMachine fake;
  fake.file("/proc/net/route",
            "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\tMTU\tWindow\tIRTT\n"
            "eth0\t00000000\t010200C0\t0003\t0\t0\t0\t00000000\t0\t0\t0\n"
            "lo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n"
            "wlan0\t000200C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\nbroken\n");
  EXPECT_EQ(look_at_lcm(fake.machine(), kUrl).route, "lo");
  EXPECT_EQ(look_at_lcm(Machine("/nonexistent"), kUrl).route, std::nullopt);
}

TEST(DoctorLcm, every_fault_has_its_words) {
  struct Case {
    LcmFacts facts;
    const char* name;
    State state;
    const char* part;
  };
  const Case table[] = {
      {{kUrl, "lo", 212992, 8388608}, "lcm-buffers", State::Ok, "8388608"},
      {{kUrl, "lo", 212992, 212992}, "lcm-buffers", State::Warning, "sysctl -w net.core.rmem_max"},
      {{std::string(kUrl) + "&recv_buf_size=9000000", "lo", 212992, 8388608}, "lcm-buffers", State::Warning, "9000000"},
      {{kUrl, "lo", {}, {}}, "lcm-buffers", State::Skipped, "rmem_max"},
      {{kUrl, {}, 212992, 8388608}, "lcm-route", State::Failure, "ip route add 224.0.0.0/4 dev lo"},
      {{"udpm://10.0.0.1:7667", "eth0", 212992, 8388608}, "lcm-url", State::Failure, "no multicast address"},
      {{"udpm://239.1.1.1:x", "eth0", 212992, 8388608}, "lcm-url", State::Failure, "cannot be read"},
      {{"memq://", {}, {}, {}}, "lcm-url", State::Ok, "memq://"},
  };
  for (const Case& row : table) {
    SCOPED_TRACE(row.part);
    const auto checks = judge(row.facts);
    const Check& check = check_named(checks, row.name);
    EXPECT_EQ(check.state, row.state) << check.text;
    EXPECT_NE((check.text + check.remedy).find(row.part), std::string::npos) << check.text << check.remedy;
  }
}

TEST(DoctorLcm, hears_itself) {
  const BusFacts facts = listen_on_bus({.url = "memq://", .channel_prefix = "TEST_"}, std::chrono::milliseconds(1));
  EXPECT_EQ(facts.error, "");
  EXPECT_TRUE(facts.is_own_message_heard);
  EXPECT_FALSE(facts.health);
  const BusFacts broken = listen_on_bus({.url = "file:///nonexistent/log", .channel_prefix = "TEST_"}, {});
  EXPECT_FALSE(broken.error.empty());
  EXPECT_EQ(judge(broken, {}).front().state, State::Failure);
}

TEST(DoctorDaemon, is_told_by_its_health) {
  const std::vector<ProcessFacts> running{{9, "stairwayd"}};
  ipc::HealthMessage scanning;
  scanning.state = "scanning";
  ipc::HealthMessage lost;
  lost.state = "scanner: no reply";
  lost.reasons = {"scanner:no-reply"};
  lost.drops = {{"no-return", 5}};
  const auto daemon = [&](const BusFacts& facts, const std::vector<ProcessFacts>& daemons) {
    return judge(facts, daemons).back();
  };
  BusFacts facts{.error = "", .is_own_message_heard = true, .health = scanning};
  EXPECT_EQ(daemon(facts, running).state, State::Ok);
  facts.health = lost;
  EXPECT_EQ(daemon(facts, running).state, State::Warning);
  EXPECT_NE(daemon(facts, running).text.find("scanner: no reply"), std::string::npos);
  EXPECT_NE(daemon(facts, running).text.find("5"), std::string::npos);
  facts.health.reset();
  EXPECT_EQ(daemon(facts, {}).state, State::Skipped);
  EXPECT_EQ(daemon(facts, running).state, State::Failure);
  facts.undecodable = 1;
  EXPECT_NE(daemon(facts, running).remedy.find("same version"), std::string::npos);
}

TEST(DoctorDaemon, every_device_that_is_unwell_has_a_line_of_its_own) {
  ipc::HealthMessage health;
  health.state = "disk motor: can0 is down; encoder: no such chip";
  health.reasons = {"disk-motor:can-bus", "encoder:disconnected"};
  health.devices = {{"scanner", "streaming", "", true, 40.0, 0.1, 2},
                    {"disk motor", "can0 is down", "can-bus", false, 0.0, 12.4, 3},
                    {"encoder", "no such chip", "disconnected", false, 0.0, -1.0, 1}};
  const auto checks = judge(BusFacts{.error = "", .is_own_message_heard = true, .health = health}, {});
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_EQ(check_named(checks, "daemon").state, State::Warning);
  EXPECT_EQ(check_named(checks, "daemon-disk-motor").text, "can0 is down (can-bus), last data 12 s ago, 3 troubles");
  EXPECT_EQ(check_named(checks, "daemon-encoder").text, "no such chip (disconnected), no data yet, 1 troubles");
  EXPECT_EQ(check_named(checks, "daemon-encoder").state, State::Warning);
}

struct OpenedPorts {
  int scanners = 0;
  Ports ports() {
    Ports ports;
    ports.scanner.emplace([this]() -> tl::expected<std::unique_ptr<drivers::BytePort>, std::string> {
      ++scanners;
      return tl::unexpected<std::string>("no port in a test");
    });
    ports.now = [this] { return now_ns += 1'000'000'000; };
    return ports;
  }
  drivers::HostStamp now_ns = 0;
};

FakeMachine& with_scanner(FakeMachine& fake) {
  fake.file("/sys/bus/usb/devices/1-1/idVendor", "15d1\n");
  fake.file("/sys/bus/usb/devices/1-1/busnum", "1\n");
  fake.file("/sys/bus/usb/devices/1-1/devnum", "2\n");
  fake.node("/dev/bus/usb/001/002", 0660);
  fake.name_own_group("stairway");
  return fake;
}

std::vector<Check> examine_quickly(const FakeMachine& fake, OpenedPorts& opened, bool is_probing) {
  Robot robot;
  robot.lcm.url = "memq://";
  const Patience patience{.scanner = {}, .drive = {}, .encoder = {}, .daemon = std::chrono::milliseconds(1)};
  return examine(fake.machine(), robot, opened.ports(), patience, is_probing);
}

TEST(DoctorExamination, survives_a_machine_without_anything) {
  OpenedPorts opened;
  const auto checks = examine_quickly(FakeMachine(), opened, true);
  for (const char* name : {"udev-rules", "accounts", "service", "lcm-self-test", "daemon", "scanner", "can", "encoder"})
    EXPECT_EQ(check_named(checks, name).name, name);
  EXPECT_EQ(exit_code(checks), 2);
  EXPECT_EQ(opened.scanners, 0);
}

TEST(DoctorExamination, leaves_its_scanner_to_a_running_daemon_unless_told_to_probe) {
  FakeMachine fake;
  with_scanner(fake).process(50, "stairwayd");
  OpenedPorts polite, probing;
  EXPECT_EQ(check_named(examine_quickly(fake, polite, false), "scanner-answer").state, State::Skipped);
  EXPECT_EQ(polite.scanners, 0);
  EXPECT_EQ(check_named(examine_quickly(fake, probing, true), "scanner-answer").state, State::Failure);
}

TEST(DoctorExamination, asks_the_scanner_when_no_daemon_runs) {
  FakeMachine fake;
  with_scanner(fake);
  OpenedPorts opened;
  EXPECT_EQ(check_named(examine_quickly(fake, opened, false), "scanner-answer").state, State::Failure);
}

}  // namespace
}  // namespace stairway::doctor
