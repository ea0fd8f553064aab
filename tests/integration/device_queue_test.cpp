// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/device_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

DeviceNews feedback(drivers::HostStamp stamp_ns) {
  return {stamp_ns, drivers::MotorEvent{drivers::DriveFeedback{.stamp_ns = stamp_ns}}};
}
DeviceNews state(drivers::HostStamp stamp_ns) {
  return {stamp_ns, drivers::MotorEvent{drivers::MotorStateEvent{drivers::MotorState::Running}}};
}

TEST(DeviceQueue, gives_everything_in_order_and_waits_for_the_first) {
  DeviceQueue queue(10);
  EXPECT_TRUE(queue.take(1ms).empty());
  std::jthread later([&] {
    std::this_thread::sleep_for(2ms);
    queue.push(feedback(1));
    queue.push(state(2));
  });
  std::vector<drivers::HostStamp> stamps;
  while (stamps.size() < 2) {
    for (const DeviceNews& news : queue.take(10s)) stamps.push_back(news.stamp_ns);
  }
  EXPECT_EQ(stamps, (std::vector<drivers::HostStamp>{1, 2}));
  EXPECT_EQ(queue.take_dropped(), 0u);
}

TEST(DeviceQueue, drops_the_oldest_measurement_and_keeps_states) {
  DeviceQueue queue(3);
  queue.push(state(1));
  for (int i = 2; i < 7; ++i) queue.push(feedback(i));
  std::vector<drivers::HostStamp> stamps;
  for (const DeviceNews& news : queue.take(0ms)) stamps.push_back(news.stamp_ns);
  EXPECT_EQ(stamps, (std::vector<drivers::HostStamp>{1, 5, 6}));
  EXPECT_EQ(queue.take_dropped(), 3u);
  EXPECT_EQ(queue.take_dropped(), 0u);
}

TEST(DeviceQueue, stays_bounded_by_states_alone) {
  DeviceQueue queue(3);
  for (int i = 0; i < 10; ++i) queue.push(state(i));
  EXPECT_EQ(queue.take(0ms).size(), 3u);
  EXPECT_EQ(queue.take_dropped(), 7u);
}

}  // namespace
}  // namespace stairway::daemon
