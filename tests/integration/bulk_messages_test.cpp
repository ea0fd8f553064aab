// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tests/integration/daemon_process.hpp"
#include "tests/integration/private_network.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 200s;
constexpr std::size_t kDatagram = 65507;

const ipc::Channels kChannels;

class BulkMessages : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
    add_multicast_route();
    bus = ipc::LcmBus::open(ipc::BusOptions{}.url).value();
  }

  template <class Message>
  void keep(const std::string& channel, std::vector<Message>& messages) {
    const auto add = [this, &messages](const ipc::BusMessage& message) {
      largest = std::max(largest, message.bytes.size());
      auto decoded = ipc::decode<Message>(message.bytes);
      if (decoded) messages.push_back(std::move(*decoded));
      EXPECT_TRUE(decoded) << message.channel;
    };
    EXPECT_TRUE(bus->subscribe(channel, add));
  }
  template <class Condition>
  bool listen(Condition is_enough) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!is_enough() && std::chrono::steady_clock::now() < end) EXPECT_TRUE(bus->handle(100ms));
    return is_enough();
  }

  std::unique_ptr<ipc::LcmBus> bus;
  std::size_t largest = 0;
};

TEST_F(BulkMessages, slices_of_a_cloud_arrive_and_make_the_cloud_again) {
  std::vector<ipc::CloudSliceMessage> slices;
  std::vector<ipc::StairwaysMessage> answers;
  keep(kChannels.cloud, slices);
  keep(kChannels.stairways, answers);
  DaemonProcess daemon({"--simulate=straight-flight", "--set", "simulate.speed=0", "--set", "disk.period_s=6", "--set",
                        "detector.voxel_mm=30", "--set", "cloud.send=true", "--set", "preview.every_s=0", "--set",
                        "lcm.scans=false", "--log-level", "debug"});
  const auto is_second_complete = [&] {
    return !slices.empty() && slices.back().sweep == 1 && slices.back().slice + 1 == slices.back().slices;
  };
  ASSERT_TRUE(listen(is_second_complete)) << daemon.output();
  EXPECT_LE(largest, 16000u);
  EXPECT_GT(largest, 15900u);
  EXPECT_LT(largest, kDatagram);

  std::map<std::int64_t, std::vector<Eigen::Vector3f>> clouds;
  std::map<std::int64_t, std::int32_t> next;
  for (const ipc::CloudSliceMessage& slice : slices) {
    EXPECT_EQ(slice.slice, next[slice.sweep]++);
    auto& points = clouds[slice.sweep];
    EXPECT_EQ(static_cast<std::size_t>(slice.first_point), points.size());
    points.insert(points.end(), slice.points.begin(), slice.points.end());
  }
  for (const std::int64_t sweep : {0, 1}) {
    const auto& last =
        *std::find_if(slices.rbegin(), slices.rend(), [&](const auto& one) { return one.sweep == sweep; });
    EXPECT_EQ(next[sweep], last.slices);
    ASSERT_EQ(clouds[sweep].size(), static_cast<std::size_t>(last.sweep_points));
    EXPECT_GT(clouds[sweep].size(), 100'000u);
    ASSERT_GT(answers.size(), static_cast<std::size_t>(sweep));
    EXPECT_EQ(last.utime_us, answers[static_cast<std::size_t>(sweep)].utime_us);
    const std::string count = "sweep " + std::to_string(sweep) + ": " + std::to_string(last.sweep_points) + " points";
    EXPECT_NE(daemon.output().find(count), std::string::npos) << count;
    // The floor is flat, and at 0.
    const auto floor =
        std::ranges::count_if(clouds[sweep], [](const Eigen::Vector3f& p) { return std::abs(p.z()) < 0.1F; });
    EXPECT_GT(floor, 10'000);
  }
}

TEST_F(BulkMessages, scanner_s_bytes_are_sent_on_demand) {
  std::vector<ipc::RawMessage> raws;
  keep(kChannels.raw, raws);
  DaemonProcess daemon({"--simulate=empty-room", "--set", "lcm.raw=true"});
  const auto holds = [&](bool is_sent, const std::string& text) {
    return std::ranges::any_of(raws, [&](const ipc::RawMessage& raw) {
      return raw.is_sent == is_sent && raw.bytes.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(listen([&] { return holds(true, "MD") && holds(false, "MD") && raws.size() > 20; }));
  EXPECT_TRUE(holds(true, "VV\n"));
  EXPECT_EQ(raws.front().device, "scanner");
  for (std::size_t i = 1; i < raws.size(); ++i) EXPECT_GE(raws[i].host_stamp_ns, raws[i - 1].host_stamp_ns);
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
  EXPECT_NEAR(static_cast<double>(raws.back().utime_us), static_cast<double>(now_us), 60e6);
}

}  // namespace
}  // namespace stairway::test
