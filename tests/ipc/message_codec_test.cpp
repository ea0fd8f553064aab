// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/message_codec.hpp"

#include <gtest/gtest.h>

#include "tests/ipc/message_fixtures.hpp"

namespace stairway::ipc {
namespace {

using test::kAck, test::kCommand, test::kRaw, test::kSlice;
using test::kAngles, test::kDisk, test::kHealth, test::kSettings;

void expect_equal(const detect::Stairway& a, const detect::Stairway& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.step_height, b.step_height);
  EXPECT_EQ(a.step_depth, b.step_depth);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.heading, b.heading);
  EXPECT_EQ(a.turn_per_step, b.turn_per_step);
  EXPECT_EQ(a.step_height_sigma, b.step_height_sigma);
  EXPECT_EQ(a.step_depth_sigma, b.step_depth_sigma);
  EXPECT_EQ(a.width_sigma, b.width_sigma);
  EXPECT_EQ(a.heading_sigma, b.heading_sigma);
  EXPECT_EQ(a.anchor, b.anchor);
  EXPECT_EQ(a.anchor_side, b.anchor_side);
  EXPECT_EQ(a.railing_left, b.railing_left);
  EXPECT_EQ(a.railing_right, b.railing_right);
  EXPECT_EQ(a.score, b.score);
  ASSERT_EQ(a.nosings.size(), b.nosings.size());
  for (std::size_t i = 0; i < a.nosings.size(); ++i) {
    EXPECT_EQ(a.nosings[i].left, b.nosings[i].left);
    EXPECT_EQ(a.nosings[i].right, b.nosings[i].right);
  }
  EXPECT_EQ(a.is_irregular, b.is_irregular);
  ASSERT_EQ(a.step_sizes.size(), b.step_sizes.size());
  for (std::size_t i = 0; i < a.step_sizes.size(); ++i) {
    EXPECT_EQ(a.step_sizes[i].height, b.step_sizes[i].height);
    EXPECT_EQ(a.step_sizes[i].height_sigma, b.step_sizes[i].height_sigma);
    EXPECT_EQ(a.step_sizes[i].depth, b.step_sizes[i].depth);
    EXPECT_EQ(a.step_sizes[i].depth_sigma, b.step_sizes[i].depth_sigma);
  }
}

TEST(MessageCodec, stairways_come_back_as_sent) {
  StairwaysMessage sent = test::sample_stairways();
  sent.seen_utimes_us = {sent.utime_us - 5};
  const auto got = decode<StairwaysMessage>(encode(sent));
  ASSERT_TRUE(got) << to_string(got.error());
  EXPECT_EQ(got->utime_us, sent.utime_us);
  EXPECT_EQ(got->sweep_start_utime_us, sent.sweep_start_utime_us);
  EXPECT_EQ(got->sweep, sent.sweep);
  EXPECT_EQ(got->is_final, sent.is_final);
  EXPECT_EQ(got->track_ids, sent.track_ids);
  EXPECT_EQ(got->seen_utimes_us, (std::vector{sent.utime_us - 5, sent.utime_us}));
  ASSERT_EQ(got->detection.stairways.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) expect_equal(got->detection.stairways[i], sent.detection.stairways[i]);
  ASSERT_EQ(got->detection.rejected.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(got->detection.rejected[i].reason, sent.detection.rejected[i].reason);
    EXPECT_EQ(got->detection.rejected[i].detail, sent.detection.rejected[i].detail);
    EXPECT_EQ(got->detection.rejected[i].figures, sent.detection.rejected[i].figures);
  }
}

TEST(MessageCodec, scan_comes_back_bit_for_bit) {
  const ScanMessage sent = test::sample_scan();
  const auto got = decode<ScanMessage>(encode(sent));
  ASSERT_TRUE(got) << to_string(got.error());
  EXPECT_EQ(got->utime_us, sent.utime_us);
  EXPECT_EQ(got->scan.sequence, sent.scan.sequence);
  EXPECT_EQ(got->scan.device_stamp_ms, sent.scan.device_stamp_ms);
  EXPECT_EQ(got->scan.first_beam_stamp_ns, sent.scan.first_beam_stamp_ns);
  EXPECT_EQ(got->scan.beam_interval_ns, sent.scan.beam_interval_ns);
  EXPECT_EQ(got->scan.first_angle_rad, sent.scan.first_angle_rad);
  EXPECT_EQ(got->scan.angle_increment_rad, sent.scan.angle_increment_rad);
  EXPECT_EQ(got->disk_angle_start_rad, sent.disk_angle_start_rad);
  EXPECT_EQ(got->disk_angle_end_rad, sent.disk_angle_end_rad);
  EXPECT_EQ(got->disk_angle_valid, sent.disk_angle_valid);
  EXPECT_EQ(got->scan.statuses, sent.scan.statuses);
  ASSERT_EQ(got->scan.ranges_m.size(), sent.scan.ranges_m.size());
  for (std::size_t i = 0; i < sent.scan.ranges_m.size(); ++i) {
    if (sent.scan.statuses[i] == drivers::BeamStatus::Ok) {
      EXPECT_EQ(got->scan.ranges_m[i], sent.scan.ranges_m[i]);
    } else {
      EXPECT_TRUE(std::isnan(got->scan.ranges_m[i]));
    }
  }
}

TEST(MessageCodec, scan_carries_intensities_for_all_beams_or_none) {
  ScanMessage sent = test::sample_scan();
  EXPECT_TRUE(decode<ScanMessage>(encode(sent))->scan.intensities.empty());
  for (std::size_t i = 0; i < sent.scan.ranges_m.size(); ++i) {
    sent.scan.intensities.push_back(static_cast<std::uint32_t>(16 * i));
  }
  const Bytes bytes = encode(sent);
  EXPECT_LT(bytes.size(), 16384U);
  const auto got = decode<ScanMessage>(bytes);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->scan.intensities, sent.scan.intensities);

  Bytes negative = bytes;
  negative[negative.size() - 4] = 0x80;
  EXPECT_EQ(decode<ScanMessage>(negative).error(), MessageFault::ImpossibleValue);

  sent.scan.intensities.pop_back();
  EXPECT_TRUE(decode<ScanMessage>(encode(sent))->scan.intensities.empty());
}

TEST(MessageCodec, scan_fits_one_datagram_of_a_slow_link) { EXPECT_LT(encode(test::sample_scan()).size(), 16384U); }

TEST(MessageCodec, scan_with_lists_of_different_lengths_is_sent_with_invalid_beams) {
  ScanMessage sent;
  sent.scan.ranges_m = {1.0F, 2.0F};
  sent.scan.statuses = {drivers::BeamStatus::Ok};
  const auto got = decode<ScanMessage>(encode(sent));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->scan.statuses,
            (std::vector<drivers::BeamStatus>{drivers::BeamStatus::Ok, drivers::BeamStatus::Invalid}));
}

TEST(MessageCodec, disk_health_and_settings_come_back_as_sent) {
  const auto disk = decode<DiskMessage>(encode(kDisk));
  ASSERT_TRUE(disk);
  EXPECT_EQ(disk->utime_us, kDisk.utime_us);
  EXPECT_EQ(disk->sample.stamp_ns, kDisk.sample.stamp_ns);
  EXPECT_EQ(disk->sample.angle_rad, kDisk.sample.angle_rad);
  EXPECT_EQ(disk->sample.valid, kDisk.sample.valid);
  EXPECT_EQ(disk->speed_rad_s, kDisk.speed_rad_s);
  EXPECT_EQ(disk->index_count, kDisk.index_count);
  EXPECT_EQ(disk->fault, kDisk.fault);
  EXPECT_EQ(disk->fault_text, kDisk.fault_text);

  const auto health = decode<HealthMessage>(encode(kHealth));
  ASSERT_TRUE(health);
  EXPECT_EQ(health->utime_us, kHealth.utime_us);
  EXPECT_EQ(health->state, kHealth.state);
  EXPECT_EQ(health->sweep, kHealth.sweep);
  EXPECT_EQ(health->sweep_progress, kHealth.sweep_progress);
  EXPECT_EQ(health->scan_rate_hz, kHealth.scan_rate_hz);
  EXPECT_EQ(health->disk_rate_hz, kHealth.disk_rate_hz);
  EXPECT_EQ(health->points, kHealth.points);
  EXPECT_EQ(health->drops, kHealth.drops);
  EXPECT_EQ(health->devices, kHealth.devices);
  EXPECT_EQ(health->reasons, kHealth.reasons);
  EXPECT_EQ(health->clock, kHealth.clock);
  EXPECT_EQ(health->stages, kHealth.stages);
  EXPECT_EQ(health->result, kHealth.result);

  const auto settings = decode<SettingsMessage>(encode(kSettings));
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->utime_us, kSettings.utime_us);
  EXPECT_EQ(settings->version, kSettings.version);
  EXPECT_EQ(settings->toml, kSettings.toml);
}

template <class Message>
void expect_error_for_every_other_length(const Message& message) {
  const Bytes good = encode(message);
  for (std::size_t length = 0; length < good.size(); ++length) {
    const auto got = decode<Message>(std::span(good).first(length));
    ASSERT_FALSE(got) << "cut at " << length;
    ASSERT_EQ(got.error(), length < 8 ? MessageFault::WrongType : MessageFault::BadSize) << "cut at " << length;
  }
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_EQ(decode<Message>(longer).error(), MessageFault::BadSize);
}

TEST(MessageCodec, angles_come_back_bit_for_bit) {
  const AnglesMessage& sent = kAngles;
  const auto got = decode<AnglesMessage>(encode(sent));
  ASSERT_TRUE(got) << to_string(got.error());
  EXPECT_EQ(got->utime_us, sent.utime_us);
  EXPECT_EQ(got->scan_stamp_ns, sent.scan_stamp_ns);
  ASSERT_EQ(got->samples.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(got->samples[i].stamp_ns, sent.samples[i].stamp_ns);
    EXPECT_EQ(got->samples[i].angle_rad, sent.samples[i].angle_rad);
    EXPECT_EQ(got->samples[i].valid, sent.samples[i].valid);
  }
  EXPECT_EQ(message_utime_us(encode(sent)), -7);
  EXPECT_EQ(message_utime_us({}), std::nullopt);
}

TEST(MessageCodec, commands_and_their_answers_come_back_as_sent) {
  const auto command = decode<CommandMessage>(encode(kCommand));
  ASSERT_TRUE(command);
  EXPECT_EQ(command->utime_us, kCommand.utime_us);
  EXPECT_EQ(command->id, kCommand.id);
  EXPECT_EQ(command->action, kCommand.action);
  EXPECT_EQ(command->speed_rad_s, kCommand.speed_rad_s);
  EXPECT_EQ(decode<CommandAckMessage>(encode(kAck)), kAck);

  Bytes strange = encode(kCommand);
  strange[24] = 99;  // behind fingerprint, utime and id
  EXPECT_EQ(decode<CommandMessage>(strange)->action, CommandAction::Unknown) << "its sender gets an answer";
}

TEST(MessageCodec, slices_and_raw_bytes_come_back_as_sent) {
  const auto slice = decode<CloudSliceMessage>(encode(kSlice));
  ASSERT_TRUE(slice);
  EXPECT_EQ(slice->utime_us, kSlice.utime_us);
  EXPECT_EQ(slice->sweep_start_utime_us, kSlice.sweep_start_utime_us);
  EXPECT_EQ(slice->sweep, kSlice.sweep);
  EXPECT_EQ(slice->slice, kSlice.slice);
  EXPECT_EQ(slice->slices, kSlice.slices);
  EXPECT_EQ(slice->first_point, kSlice.first_point);
  EXPECT_EQ(slice->sweep_points, kSlice.sweep_points);
  EXPECT_EQ(slice->points, kSlice.points);
  const Bytes bytes = encode(kSlice);
  const Bytes first_float(bytes.end() - 24, bytes.end() - 20);
  EXPECT_EQ(first_float, (Bytes{0x00, 0x00, 0x80, 0x3f})) << "1.0, little-endian";

  const auto raw = decode<RawMessage>(encode(kRaw));
  ASSERT_TRUE(raw);
  EXPECT_EQ(raw->utime_us, kRaw.utime_us);
  EXPECT_EQ(raw->host_stamp_ns, kRaw.host_stamp_ns);
  EXPECT_EQ(raw->device, kRaw.device);
  EXPECT_EQ(raw->is_sent, kRaw.is_sent);
  EXPECT_EQ(raw->bytes, kRaw.bytes);
}

TEST(MessageCodec, cut_or_longer_message_is_an_error) {
  expect_error_for_every_other_length(test::sample_stairways());
  expect_error_for_every_other_length(test::sample_scan());
  expect_error_for_every_other_length(kDisk);
  expect_error_for_every_other_length(kAngles);
  expect_error_for_every_other_length(kHealth);
  expect_error_for_every_other_length(kSettings);
  expect_error_for_every_other_length(kCommand);
  expect_error_for_every_other_length(kAck);
  expect_error_for_every_other_length(kSlice);
  expect_error_for_every_other_length(kRaw);
}

template <class Message>
void expect_survival_of_damage(const Message& message) {
  const Bytes good = encode(message);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
      Bytes bad = good;
      bad[i] = static_cast<std::uint8_t>(value);
      const auto got = decode<Message>(bad);
      if (got) {
        EXPECT_EQ(encode(*got).size(), good.size());
      }
    }
  }
  EXPECT_TRUE(decode<Message>(good));
}

TEST(MessageCodec, damaged_message_gives_an_error_or_one_of_the_same_size) {
  expect_survival_of_damage(test::sample_stairways());
  ScanMessage scan = test::sample_scan();
  scan.scan.ranges_m.resize(20);
  expect_survival_of_damage(scan);
  expect_survival_of_damage(kDisk);
  expect_survival_of_damage(kAngles);
  expect_survival_of_damage(kHealth);
  expect_survival_of_damage(kSettings);
  expect_survival_of_damage(kCommand);
  expect_survival_of_damage(kAck);
  expect_survival_of_damage(kSlice);
  expect_survival_of_damage(kRaw);
}

TEST(MessageCodec, values_outside_an_enumeration_are_refused) {
  // Offsets from ipc/types: fingerprint 8, then the fields in order.
  Bytes scan = encode(test::sample_scan());
  scan[scan.size() - 5] = 5;  // the last status; four bytes behind it say that there are no intensities
  EXPECT_EQ(decode<ScanMessage>(scan).error(), MessageFault::ImpossibleValue);

  Bytes disk = encode(kDisk);
  disk[8 + 4 * 8 + 1 + 8] = 4;
  EXPECT_EQ(decode<DiskMessage>(disk).error(), MessageFault::ImpossibleValue);

  const std::size_t first_stairway = 8 + 3 * 8 + 1 + 4;
  for (const std::size_t field : {16, 17, 18 + 13 * 8}) {
    for (const int value : {3, 255}) {
      Bytes stairways = encode(test::sample_stairways());
      stairways[first_stairway + field] = static_cast<std::uint8_t>(value);
      EXPECT_EQ(decode<StairwaysMessage>(stairways).error(), MessageFault::ImpossibleValue) << field;
    }
  }
}

TEST(MessageCodec, other_type_is_refused) {
  EXPECT_EQ(decode<DiskMessage>(encode(kHealth)).error(), MessageFault::WrongType);
}

}  // namespace
}  // namespace stairway::ipc
