// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drivers/canopen/little_endian.hpp"
#include "drivers/canopen/motor_setup.hpp"
#include "tests/drivers/can_text.hpp"
#include "tools/sim/disk_motion.hpp"
#include "tools/sim/fake_drive.hpp"

namespace stairway::sim {
namespace {

using drivers::CanFrame;
using drivers::DriveState;
using drivers::HostStamp;
using drivers::NmtState;

constexpr HostStamp kMs = 1'000'000;
constexpr double kTurn = 2 * std::numbers::pi;

struct Bench {
  explicit Bench(const FakeDriveOptions& options = {}) : drive(options) { run(60 * kMs); }

  /// What the drive said, as candump prints it.
  std::vector<std::string> run(HostStamp duration_ns) {
    now_ns += duration_ns;
    std::vector<std::string> said;
    while (const auto sent = drive.take(now_ns)) said.push_back(drivers::to_string(sent->second));
    return said;
  }
  std::vector<std::string> say(const char* text) {
    drive.receive(drivers::frame_of(text), now_ns);
    return run(kMs);
  }
  void enable() {
    for (const char* text :
         {"601#2F60600003000000", "601#2383600000200300", "601#2384600000200300", "601#2385600000200300",
          "601#2B40600006000000", "601#2B40600007000000", "601#2B4060000F000000"}) {
      EXPECT_EQ(say(text).size(), 1U) << text;
    }
  }

  FakeDrive drive;
  HostStamp now_ns = 0;
};

using Texts = std::vector<std::string>;

TEST(FakeDrive, boots_once_and_beats_as_it_is_told) {
  FakeDrive drive{FakeDriveOptions{}};
  EXPECT_FALSE(drive.take(49 * kMs));
  EXPECT_EQ(drive.next_due_ns(), 50 * kMs);
  EXPECT_EQ(drivers::to_string(drive.take(50 * kMs)->second), "701#00");
  EXPECT_FALSE(drive.take(5000 * kMs));
  Bench bench;
  EXPECT_EQ(bench.say("601#2B17100064000000"), (Texts{"701#7F", "581#6017100000000000"}));
  EXPECT_EQ(bench.run(300 * kMs), (Texts{"701#7F", "701#7F", "701#7F"}));
  bench.say("000#0101");
  EXPECT_EQ(bench.run(100 * kMs), Texts{"701#05"});
}

TEST(FakeDrive, answers_objects_as_the_documents_say) {
  Bench bench;
  EXPECT_EQ(bench.say("601#2F60600003000000"), Texts{"581#6060600000000000"});
  EXPECT_EQ(bench.say("601#4061600000000000"), Texts{"581#4F61600003000000"});
  EXPECT_EQ(bench.say("601#4041600000000000"), Texts{"581#4B41600050020000"});
  EXPECT_EQ(bench.say("601#2B41600000000000"), Texts{"581#8041600002000106"});
  EXPECT_EQ(bench.say("601#4000600000000000"), Texts{"581#8000600000000206"});
  EXPECT_EQ(bench.say("601#4018100900000000"), Texts{"581#8018100911000906"});
  EXPECT_EQ(bench.say("601#2B60600003000000"), Texts{"581#8060600010000706"});
  EXPECT_EQ(bench.say("601#2F60600002000000"), Texts{"581#8060600030000906"});
  EXPECT_EQ(bench.say("602#4041600000000000"), Texts{});
}

TEST(FakeDrive, a_map_is_only_changed_while_it_is_off_and_empty) {
  Bench bench;
  EXPECT_EQ(bench.say("601#2F00160000000000"), Texts{"581#8000160022000008"});
  EXPECT_EQ(bench.say("601#2300140101020080"), Texts{"581#6000140100000000"});
  EXPECT_EQ(bench.say("601#2300160110004060"), Texts{"581#8000160122000008"});
  EXPECT_EQ(bench.say("601#2F00160000000000"), Texts{"581#6000160000000000"});
  EXPECT_EQ(bench.say("601#2300160110004060"), Texts{"581#6000160100000000"});
  EXPECT_EQ(bench.say("601#2300160210004160"), Texts{"581#8000160241000406"});  // the statusword is not for writing
  EXPECT_EQ(bench.say("601#2300160220004060"), Texts{"581#8000160241000406"});  // it has 16 bits
  for (const char* text : {"601#230016022000FF60", "601#2300160320008360"}) EXPECT_EQ(bench.say(text).size(), 1U);
  EXPECT_EQ(bench.say("601#2F00160003000000"), Texts{"581#8000160042000406"});
  EXPECT_EQ(bench.say("601#2F00160002000000"), Texts{"581#6000160000000000"});
}

TEST(FakeDrive, process_data_are_as_they_were_mapped) {
  Bench bench;
  for (const drivers::PdoMap& map : drivers::motor_pdo_maps(1)) {
    for (const drivers::ObjectWrite& write : drivers::mapping_writes(map)) {
      drivers::SdoFrame frame{.kind = drivers::SdoKind::DownloadRequest, .object = write.object, .is_expedited = true};
      for (int i = 0; i < write.value.size; ++i) frame.bytes.push_back(static_cast<char>(write.value.value >> (8 * i)));
      bench.drive.receive(drivers::encode_sdo(0x601, frame), bench.now_ns);
      const Texts said = bench.run(kMs);
      ASSERT_EQ(said.size(), 1U);
      EXPECT_EQ(said[0].substr(0, 6), "581#60");
    }
  }
  bench.enable();
  EXPECT_EQ(bench.say("080#"), Texts{});  // not operational
  bench.say("000#0101");
  EXPECT_EQ(bench.say("080#"), (Texts{"181#371600000000", "281#00000000"}));
  EXPECT_EQ(bench.say("201#0F00A00F0000"), Texts{});
  bench.run(1000 * kMs);
  EXPECT_EQ(bench.say("080#")[0], "181#3706A00F0000");
  EXPECT_EQ(bench.say("201#0F00A00F00"), Texts{"081#1082010000000000"});  // too short
}

TEST(FakeDrive, a_disk_that_listens_follows_the_drives_position) {
  Bench bench;
  DiskMotion disk(0, 0.0, 0.0);
  bench.drive.listen([&](HostStamp at_ns, double speed_rad_s) { disk.set_speed(at_ns, speed_rad_s); });
  bench.enable();
  bench.say("601#23FF600000200300");  // a turn per second
  bench.run(1500 * kMs);
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), kTurn, 1e-9);
  bench.say("601#23FF600000E0FCFF");  // and back
  bench.run(700 * kMs);
  const CanFrame answer = drivers::frame_of(bench.say("601#4064600000000000").back());
  const double counts = static_cast<std::int32_t>(drivers::load_little_endian(std::span(answer.data).subspan(4), 4));
  EXPECT_NEAR(disk.angle_at(bench.now_ns - kMs), counts / 204800.0 * kTurn, 2 * kTurn / 204800.0);
  EXPECT_GT(counts, 0.0);
}

TEST(FakeDrive, wrong_units_turn_the_disk_at_another_speed_than_the_drive_believes) {
  Bench bench;
  bench.drive.faults().disk_turns_per_turn = -4.0;
  bench.enable();
  bench.say("601#23FF600000200300");
  bench.run(1500 * kMs);
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), -4.0 * kTurn, 1e-9);
  EXPECT_EQ(bench.say("601#406C600000000000"), Texts{"581#436C600000200300"});
}

TEST(FakeDrive, stops_when_the_host_that_it_watches_falls_silent) {
  Bench bench;
  bench.say("601#23161001F4017F00");
  bench.say("601#2B07600003000000");
  bench.enable();
  bench.say("000#0101");
  bench.say("601#23FF600000200300");
  for (int i = 0; i < 20; ++i) {
    bench.say("77F#05");
    bench.run(100 * kMs);
  }
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), kTurn, 1e-9);
  EXPECT_EQ(bench.run(2000 * kMs), Texts{"081#3081010000000000"});
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
  EXPECT_EQ(bench.drive.nmt_state(), NmtState::PreOperational);
}

TEST(FakeDrive, a_fault_brakes_and_is_reset_by_a_rising_edge_only) {
  Bench bench;
  bench.enable();
  bench.say("601#23FF600000200300");
  bench.run(1500 * kMs);
  bench.drive.raise_fault(0x2310, bench.now_ns);
  EXPECT_EQ(bench.run(kMs), Texts{"081#1023010000000000"});
  EXPECT_EQ(bench.drive.statusword(), 0x021f);
  bench.run(2000 * kMs);
  EXPECT_EQ(bench.drive.statusword(), 0x0218);
  EXPECT_EQ(bench.say("601#403F600000000000"), Texts{"581#4B3F600010230000"});
  EXPECT_EQ(bench.say("601#2B40600080000000"), (Texts{"081#0000000000000000", "581#6040600000000000"}));
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
  bench.drive.raise_fault(0x2310, bench.now_ns);
  bench.say("601#2B40600080000000");  // still set: no edge
  EXPECT_EQ(bench.drive.state(), DriveState::Fault);
  bench.say("601#2B40600000000000");
  bench.say("601#2B40600080000000");
  EXPECT_EQ(bench.drive.state(), DriveState::SwitchOnDisabled);
}

}  // namespace
}  // namespace stairway::sim
