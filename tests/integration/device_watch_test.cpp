// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/device_watch.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

using drivers::EncoderState;
using drivers::EncoderStateEvent;
using drivers::EncoderTroubleEvent;
using drivers::HostStamp;
using drivers::MotorState;
using drivers::MotorStateEvent;
using drivers::MotorTroubleEvent;
using drivers::ScipState;
using drivers::ScipStateEvent;
using drivers::ScipTroubleEvent;

constexpr HostStamp kSecond_ns = 1'000'000'000;

template <class Event>
std::vector<Event> only(const std::vector<SourceEvent>& events) {
  std::vector<Event> found;
  for (const SourceEvent& event : events) {
    if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
  }
  return found;
}

/// The last state told of a device.
std::optional<SourceState> last_state(const std::vector<SourceEvent>& events, Device device) {
  std::optional<SourceState> last;
  for (const SourceState& state : only<SourceState>(events)) {
    if (state.device == device) last = state;
  }
  return last;
}

TEST(DeviceWatch, every_device_has_a_state_from_the_start) {
  DeviceWatch watch({});
  const auto states = only<SourceState>(watch.take_events());
  ASSERT_EQ(states.size(), 4u);
  for (const SourceState& state : states)
    EXPECT_EQ(state.condition, state.device == Device::Disk ? Condition::Good : Condition::Starting);
  config::Settings settings;
  settings.disk.angle_source = drivers::AngleSource::Drive;
  EXPECT_FALSE(last_state(DeviceWatch(settings).take_events(), Device::Encoder));
}

TEST(DeviceWatch, state_of_a_device_that_failed_is_its_last_trouble) {
  DeviceWatch watch({});
  watch.take(ScipTroubleEvent{drivers::ScipTrouble::Disconnected, "no scanner found: is it plugged in?"}, 1);
  watch.take(ScipStateEvent{ScipState::Backoff}, 1);
  watch.take(MotorTroubleEvent{drivers::MotorTrouble::Bus, "can0 is down"}, 2);
  watch.take(EncoderTroubleEvent{drivers::EncoderTrouble::Disconnected, ""}, 3);
  const auto events = watch.take_events();
  const auto scanner = last_state(events, Device::Scanner);
  EXPECT_EQ(scanner->condition, Condition::Failed);
  EXPECT_EQ(scanner->text, "no scanner found: is it plugged in?");
  EXPECT_EQ(scanner->reason, "disconnected");
  EXPECT_EQ(last_state(events, Device::Motor)->text, "can0 is down");
  EXPECT_EQ(last_state(events, Device::Encoder)->condition, Condition::Failed);
  EXPECT_FALSE(last_state(events, Device::Encoder)->text.empty());
  EXPECT_EQ(only<SourceTrouble>(events).front().name, "scanner: disconnected");

  watch.take(ScipStateEvent{ScipState::Opening}, kSecond_ns);
  EXPECT_FALSE(last_state(watch.take_events(), Device::Scanner)) << "the same reason is told once";
  watch.take(ScipStateEvent{ScipState::Streaming}, 2 * kSecond_ns);
  EXPECT_EQ(last_state(watch.take_events(), Device::Scanner)->condition, Condition::Good);
}

TEST(DeviceWatch, old_trouble_is_not_why_a_device_fails_now) {
  DeviceWatch watch({});
  watch.take(ScipStateEvent{ScipState::Streaming}, 0);
  watch.take_events();
  watch.take(ScipTroubleEvent{drivers::ScipTrouble::Corrupt, "bad sum"}, kSecond_ns);
  EXPECT_FALSE(last_state(watch.take_events(), Device::Scanner)) << "a single bad scan changes no state";
  watch.take(ScipStateEvent{ScipState::Opening}, 60 * kSecond_ns);
  const auto state = last_state(watch.take_events(), Device::Scanner);
  EXPECT_EQ(state->condition, Condition::Starting);
  EXPECT_EQ(state->text.find("bad sum"), std::string::npos);

  watch.take(ScipStateEvent{ScipState::Streaming}, 61 * kSecond_ns);
  watch.take(ScipTroubleEvent{drivers::ScipTrouble::Silence, "no scan for 0.2 s"}, 70 * kSecond_ns);
  watch.take(ScipStateEvent{ScipState::Opening}, 70 * kSecond_ns);
  EXPECT_EQ(last_state(watch.take_events(), Device::Scanner)->text, "no scan for 0.2 s");
}

TEST(DeviceWatch, devices_sign_once_per_batch) {
  DeviceWatch watch({});
  watch.take_events();
  for (int batch = 0; batch < 2; ++batch) {
    for (int i = 1; i < 5; ++i) watch.take(drivers::DriveFeedback{.stamp_ns = 10 * batch + i}, i);
    const auto signs = only<SourceSign>(watch.take_events());
    ASSERT_EQ(signs.size(), 1u);
    EXPECT_EQ(signs.front().device, Device::Motor);
    EXPECT_EQ(signs.front().count, 4u);
  }
}

TEST(DeviceWatch, with_the_drive_as_angle_source_its_positions_are_the_disk_s_angles_from_the_zero_that_was_set) {
  config::Settings settings;
  settings.disk.angle_source = drivers::AngleSource::Drive;
  settings.disk.drive_zero_rad = 0.5;
  DeviceWatch watch(settings);
  watch.take(drivers::DriveFeedback{.stamp_ns = 1, .angle_rad = 2.0}, 1);
  watch.take(MotorStateEvent{MotorState::Running}, 2);
  watch.take(drivers::DriveFeedback{.stamp_ns = 3, .angle_rad = 2.1}, 3);
  watch.take(drivers::DriveFeedback{.stamp_ns = 4, .angle_rad = 2.2}, 4);
  std::vector<drivers::AngleSample> samples;
  for (const auto& batch : only<std::vector<drivers::AngleSample>>(watch.take_events()))
    samples.insert(samples.end(), batch.begin(), batch.end());
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_FALSE(samples[0].valid) << "the drive is not operational yet";
  EXPECT_TRUE(samples[1].valid);
  EXPECT_DOUBLE_EQ(samples[1].angle_rad, 1.6);
  EXPECT_DOUBLE_EQ(samples[2].angle_rad, 1.7);
  EXPECT_EQ(samples[2].stamp_ns, 4);
}

drivers::LaserScan numbered_scan(std::uint64_t sequence) {
  drivers::LaserScan scan;
  scan.sequence = sequence;
  return scan;
}

TEST(DeviceWatch, scans_of_a_resting_disk_are_left_out_and_the_next_one_begins_another_sweep) {
  DeviceWatch watch({});
  watch.take(numbered_scan(1), 1);
  watch.order({false, 0.2}, 2);
  EXPECT_EQ(watch.motor_wish(), MotorWish::Off);
  watch.take(numbered_scan(2), 3);
  watch.take(MotorStateEvent{MotorState::Stopped}, 3);
  watch.order({true, 0.2}, 4);
  watch.take(numbered_scan(3), 5);
  const auto events = watch.take_events();
  const auto scans = only<drivers::LaserScan>(events);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].sequence, 1u);
  EXPECT_EQ(scans[1].sequence, 3u + scan::kMaxLostScans + 1);
  EXPECT_EQ(last_state(events, Device::Motor)->condition, Condition::Good) << "it is off because it shall be";
}

TEST(DeviceWatch, disk_turns_when_all_devices_are_ready) {
  DeviceWatch watch({});
  watch.take(ScipStateEvent{ScipState::Streaming}, 0);
  watch.take(EncoderStateEvent{EncoderState::Unindexed}, 0);
  watch.pass_time(1);
  EXPECT_EQ(watch.wanted_speed_rad_s(), 0.0);
  watch.take(MotorStateEvent{MotorState::Running}, 2);
  watch.pass_time(2);
  EXPECT_NE(watch.wanted_speed_rad_s(), 0.0);
  EXPECT_EQ(last_state(watch.take_events(), Device::Disk)->text, "checking its speeds");
}

}  // namespace
}  // namespace stairway::daemon
