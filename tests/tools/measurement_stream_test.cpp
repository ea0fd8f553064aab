// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/measurement_stream.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ipc/message_codec.hpp"

namespace stairway::tools {
namespace {

using drivers::HostStamp;

constexpr HostStamp kScan_ns = 25'000'000;
constexpr std::int64_t kEpoch_us = 1'700'000'000'000'000;

const ipc::Channels kChannels;

ipc::Bytes scan_bytes(HostStamp stamp_ns, std::int64_t epoch_us = kEpoch_us) {
  ipc::ScanMessage message;
  message.utime_us = epoch_us + stamp_ns / 1000;
  message.scan.first_beam_stamp_ns = stamp_ns;
  message.scan.beam_interval_ns = 1e6;
  message.scan.ranges_m.assign(11, 1.0F);
  message.scan.statuses.assign(11, drivers::BeamStatus::Ok);
  message.disk_angle_start_rad = 1.0;
  message.disk_angle_end_rad = 1.5;
  message.disk_angle_valid = true;
  return ipc::encode(message);
}

ipc::Bytes angles_bytes(HostStamp stamp_ns, HostStamp scan_stamp_ns) {
  return ipc::encode(ipc::AnglesMessage{
      kEpoch_us + stamp_ns / 1000, scan_stamp_ns, {{stamp_ns, 0.5, true}, {stamp_ns + 1, 0.6, true}}});
}

struct Taken {
  std::vector<HostStamp> scans_ns, angles_ns;
};

Taken take_all(MeasurementStream& stream) {
  Taken taken;
  while (const auto measurement = stream.next()) {
    if (const auto* scan = std::get_if<drivers::LaserScan>(&*measurement)) {
      taken.scans_ns.push_back(scan->first_beam_stamp_ns);
    } else {
      for (const auto& sample : std::get<std::vector<drivers::AngleSample>>(*measurement))
        taken.angles_ns.push_back(sample.stamp_ns);
    }
  }
  return taken;
}

TEST(MeasurementStream, sender_of_scans_alone_is_found_out_and_served_with_their_angles) {
  MeasurementStream stream(kChannels, std::nullopt);
  for (int i = 0; i < 10; ++i) stream.take(kChannels.scan, scan_bytes(i * kScan_ns));
  EXPECT_TRUE(take_all(stream).scans_ns.empty()) << "angles may come yet";
  stream.take(kChannels.scan, scan_bytes(10 * kScan_ns));
  const Taken taken = take_all(stream);
  EXPECT_EQ(taken.scans_ns, std::vector<HostStamp>{10 * kScan_ns});
  EXPECT_EQ(taken.angles_ns, (std::vector<HostStamp>{10 * kScan_ns, 10 * kScan_ns + 10'000'000}));
  EXPECT_EQ(stream.utime_us(10 * kScan_ns), kEpoch_us + 250'000);
}

TEST(MeasurementStream, angles_that_are_sent_are_those_that_count) {
  MeasurementStream stream(kChannels, std::nullopt);
  stream.take(kChannels.scan, scan_bytes(0));
  stream.take(kChannels.angles, angles_bytes(5, 0));
  stream.take(kChannels.scan, scan_bytes(kScan_ns));
  const Taken taken = take_all(stream);
  EXPECT_EQ(taken.scans_ns, std::vector<HostStamp>{kScan_ns});
  EXPECT_EQ(taken.angles_ns, (std::vector<HostStamp>{5, 6}));
}

TEST(MeasurementStream, times_go_on_when_the_sender_begins_anew) {
  MeasurementStream stream(kChannels, true);
  const HostStamp late_ns = 100'000'000'000;
  stream.take(kChannels.angles, angles_bytes(late_ns, std::numeric_limits<HostStamp>::min()));
  stream.take(kChannels.scan, scan_bytes(late_ns));
  take_all(stream);
  EXPECT_EQ(stream.restarts(), 0u);

  const HostStamp early_ns = 7'000'000'000;
  stream.take(kChannels.angles, angles_bytes(early_ns, early_ns));
  stream.take(kChannels.scan, scan_bytes(early_ns, kEpoch_us + 500'000'000));
  const Taken taken = take_all(stream);
  EXPECT_EQ(stream.restarts(), 1u);
  ASSERT_EQ(taken.scans_ns.size(), 1u);
  EXPECT_GT(taken.scans_ns[0], late_ns);
  EXPECT_EQ(taken.angles_ns[0], taken.scans_ns[0]) << "they were taken at the same time";
  EXPECT_EQ(stream.utime_us(taken.scans_ns[0]), kEpoch_us + 500'000'000 + early_ns / 1000);
}

TEST(MeasurementStream, message_that_was_overtaken_is_no_restart) {
  MeasurementStream stream(kChannels, true);
  stream.take(kChannels.scan, scan_bytes(3 * kScan_ns));
  stream.take(kChannels.scan, scan_bytes(2 * kScan_ns));
  EXPECT_EQ(stream.restarts(), 0u);
}

TEST(MeasurementStream, impossible_stamps_and_damage_are_counted_and_left_out) {
  MeasurementStream stream(kChannels, true);
  for (const HostStamp stamp_ns : {std::numeric_limits<HostStamp>::max(), std::numeric_limits<HostStamp>::min()}) {
    stream.take(kChannels.scan, scan_bytes(stamp_ns, 0));
    stream.take(kChannels.angles, angles_bytes(stamp_ns - (stamp_ns > 0 ? 1 : 0), 0));
  }
  stream.take(kChannels.scan, angles_bytes(1, 1));
  stream.take("ANOTHER", angles_bytes(1, 1));
  EXPECT_EQ(stream.undecodable_messages(), 5u);
  EXPECT_TRUE(take_all(stream).scans_ns.empty());
  stream.take(kChannels.scan, scan_bytes(kScan_ns));
  EXPECT_EQ(take_all(stream).scans_ns.size(), 1u);
}

}  // namespace
}  // namespace stairway::tools
