// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/drivers/scripted_sensor.hpp"
#include "tests/tools/fake_machine.hpp"
#include "tools/doctor/scanner.hpp"
#include "tools/doctor/scanner_answer.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;
using test::FakeMachine;

constexpr const char* kNode = "/dev/bus/usb/001/004";

/// A scanner at port 1-1.2 as Linux shows it when nobody has claimed it.
void plug_in(FakeMachine& fake, const std::string& port = "1-1.2") {
  const std::string folder = "/sys/bus/usb/devices/" + port;
  fake.file(folder + "/idVendor", "15d1\n");
  fake.file(folder + "/idProduct", "0000\n");
  fake.file(folder + "/product", "URG Series USB Driver\n");
  fake.file(folder + "/busnum", "1\n");
  fake.file(folder + "/devnum", "4\n");
  fake.link(folder + ":1.0/driver", "../../../drivers/cdc_acm");
  fake.file(folder + ":1.0/tty/ttyACM0/dev", "166:0\n");
  fake.link(folder + ":1.1/driver", "../../../drivers/cdc_acm");
}

struct ScannerCase {
  const char* what;
  std::function<void(UsbScanner&)> change;
  WantedScanner wanted;
  bool has_daemon;
  std::string fault;  ///< "name=state" of the first check that is not ok, or ""
  std::string part;   ///< of its text or remedy
};

UsbScanner good_scanner() {
  return {.port = "1-1.2",
          .product = "URG Series USB Driver",
          .node = {.path = kNode, .exists = true, .is_usable = true, .group = "stairway", .is_open_to_group = true},
          .drivers = {"cdc_acm", "cdc_acm"},
          .ttys = {"ttyACM0"},
          .holders = {}};
}

Check first_fault(const std::vector<Check>& checks) {
  const auto found = std::find_if(checks.begin(), checks.end(), [](const Check& c) { return c.state != State::Ok; });
  return found == checks.end() ? Check{} : *found;
}

TEST(DoctorScanner, is_found_in_the_usb_tree) {
  FakeMachine fake;
  plug_in(fake);
  fake.file("/sys/bus/usb/devices/usb1/idVendor", "1d6b\n");
  fake.node(kNode, 0660);
  fake.name_own_group("stairway");
  fake.process(20, "cat", "/dev/ttyACM0");
  const ScannerFacts facts = look_for_scanners(fake.machine());
  ASSERT_TRUE(facts.has_usb);
  ASSERT_EQ(facts.scanners.size(), 1U);
  const UsbScanner& scanner = facts.scanners.front();
  EXPECT_EQ(scanner.port, "1-1.2");
  EXPECT_EQ(scanner.node.path, kNode);
  EXPECT_TRUE(scanner.node.exists);
  EXPECT_EQ(scanner.drivers, (std::vector<std::string>{"cdc_acm", "cdc_acm"}));
  EXPECT_EQ(scanner.ttys, std::vector<std::string>{"ttyACM0"});
  ASSERT_EQ(scanner.holders.size(), 1U);
  EXPECT_EQ(scanner.holders.front().name, "cat");
}

TEST(DoctorScanner, a_machine_without_usb_is_told) {
  const Check fault = first_fault(judge(look_for_scanners(Machine("/nonexistent")), {}, {}, false));
  EXPECT_EQ(fault.state, State::Failure);
  EXPECT_NE(fault.text.find("no USB"), std::string::npos);
}

TEST(DoctorScanner, every_fault_has_its_words) {
  const auto same = [](UsbScanner&) {};
  const ScannerCase table[] = {
      {"good", same, {}, false, "", ""},
      {"absent", [](auto& s) { s.port.clear(); }, {}, false, "scanner=failure", "12 V supply"},
      {"elsewhere", same, {.serial = "", .port = "2-1"}, false, "scanner=failure", "at 1-1.2"},
      {"no node", [](auto& s) { s.node.exists = false; }, {}, false, "scanner-access=failure", "systemd-udevd"},
      {"no rule", [](auto& s) { s.node.group = "root"; }, {}, false, "scanner-access=failure", "60-stairway.rules"},
      {"rule without mode",
       [](auto& s) { s.node.is_open_to_group = false; },
       {},
       false,
       "scanner-access=failure",
       "60-stairway.rules"},
      {"not in the group",
       [](auto& s) { s.node.is_usable = false; },
       {},
       false,
       "scanner-access=warning",
       "usermod -aG stairway"},
      {"a program has the tty",
       [](auto& s) {
         s.holders = {{5, "cat"}};
       },
       {},
       false,
       "scanner-interfaces=failure",
       "cat (process 5)"},
      {"a hidden program",
       [](auto& s) {
         s.drivers = {"usbfs", "usbfs"};
       },
       {},
       false,
       "scanner-interfaces=failure",
       "fuser -v"},
      {"the daemon",
       [](auto& s) {
         s.drivers = {"usbfs", "usbfs"};
         s.holders = {{5, "stairwayd"}};
       },
       {},
       true,
       "",
       ""},
  };
  for (const ScannerCase& row : table) {
    SCOPED_TRACE(row.what);
    ScannerFacts facts{.has_usb = true, .scanners = {good_scanner()}};
    row.change(facts.scanners.front());
    if (facts.scanners.front().port.empty()) facts.scanners.clear();
    const Check fault = first_fault(judge(facts, row.wanted, Caller{}, row.has_daemon));
    EXPECT_EQ(fault.name.empty() ? "" : fault.name + "=" + to_string(fault.state), row.fault) << fault.text;
    EXPECT_NE((fault.text + fault.remedy).find(row.part), std::string::npos) << fault.text << fault.remedy;
  }
}

TEST(DoctorScanner, of_several_one_must_be_named) {
  ScannerFacts facts{.has_usb = true, .scanners = {good_scanner(), good_scanner()}};
  facts.scanners.back().port = "2-3";
  EXPECT_EQ(first_fault(judge(facts, {}, {}, false)).state, State::Warning);
  EXPECT_EQ(judge(facts, {.serial = "", .port = "2-3"}, {}, false).front().state, State::Ok);
  EXPECT_EQ(judge(facts, {.serial = "H0902680", .port = ""}, {}, false).front().state, State::Ok);
}

/// The scripted sensor behind a port whose reads move the time on.
class SensorPort : public BytePort {
 public:
  SensorPort(ScriptedSensor& sensor, HostStamp& now_ns) : sensor_(sensor), now_ns_(now_ns) {}

  tl::expected<ByteChunk, PortError> read(std::chrono::nanoseconds timeout) override {
    for (const HostStamp end_ns = now_ns_ + timeout.count();; now_ns_ += 1'000'000) {
      std::string bytes;
      for (const auto& [at_ns, message] : sensor_.send(now_ns_)) bytes += message;
      if (!bytes.empty() || now_ns_ >= end_ns) return ByteChunk{now_ns_, bytes};
    }
  }
  tl::expected<void, PortError> write(std::string_view bytes) override {
    sensor_.receive(std::string(bytes), now_ns_);
    return {};
  }

 private:
  ScriptedSensor& sensor_;
  HostStamp& now_ns_;
};

ScannerAnswer ask(ScriptedSensor& sensor) {
  HostStamp now_ns = 1'000'000'000;
  const auto open = [&]() -> tl::expected<std::unique_ptr<BytePort>, std::string> {
    return std::make_unique<SensorPort>(sensor, now_ns);
  };
  const auto wait = [&](std::chrono::nanoseconds timeout) { return now_ns += timeout.count(), false; };
  return ask_scanner(
      {open, wait}, [&] { return now_ns; }, {}, std::chrono::seconds(15));
}

TEST(DoctorScannerAnswer, a_sensor_in_order_is_well_but_old) {
  ScriptedSensor sensor;
  const auto checks = judge(ask(sensor), "");
  ASSERT_EQ(checks.size(), 3U);
  EXPECT_EQ(checks[0].state, State::Ok) << checks[0].text;
  EXPECT_NE(checks[0].text.find("00903971"), std::string::npos);
  EXPECT_EQ(checks[1].state, State::Warning) << "P.1.05 is older than 1.18.01";
  EXPECT_EQ(checks[2].state, State::Ok) << checks[2].text;
  EXPECT_NE(checks[2].text.find("40.0 scans/s"), std::string::npos) << checks[2].text;
  EXPECT_FALSE(sensor.is_streaming) << "it is left stopped";
}

TEST(DoctorScannerAnswer, a_mute_sensor_is_told) {
  ScriptedSensor sensor;
  sensor.is_mute = true;
  const Check fault = first_fault(judge(ask(sensor), ""));
  EXPECT_EQ(fault.name, "scanner-answer");
  EXPECT_EQ(fault.state, State::Failure);
  EXPECT_NE(fault.text.find("not answered"), std::string::npos) << fault.text;
}

TEST(DoctorScannerAnswer, a_sensor_in_trouble_is_quoted) {
  ScriptedSensor sensor;
  sensor.override_reply = [](const std::string& command) -> std::optional<std::string> {
    if (command != "II") return std::nullopt;
    std::string lines;
    for (const auto& [key, value] : {std::pair{"MODL", "UTM-30LX"},
                                     {"LASR", "OFF"},
                                     {"SCSP", "2400"},
                                     {"MESM", "CLASSIC"},
                                     {"SBPS", "USB"},
                                     {"TIME", "000000"},
                                     {"STAT", "Trouble!! Error No. =[00->33] "}}) {
      append_key_value(lines, key, value);
      lines += lines.ends_with('\n') ? "" : "\n";
    }
    return encode_reply("II", "00", lines);
  };
  const Check fault = first_fault(judge(ask(sensor), ""));
  EXPECT_EQ(fault.state, State::Failure);
  EXPECT_NE(fault.text.find("Trouble!!"), std::string::npos) << fault.text;
  EXPECT_NE(fault.remedy.find("power"), std::string::npos) << fault.remedy;
}

TEST(DoctorScannerAnswer, another_serial_than_the_wanted_one_is_a_failure) {
  ScriptedSensor sensor;
  const ScannerAnswer answer = ask(sensor);
  EXPECT_EQ(judge(answer, "H0903971").front().state, State::Ok);
  EXPECT_EQ(judge(answer, "H1").front().state, State::Failure);
}

}  // namespace
}  // namespace stairway::doctor
