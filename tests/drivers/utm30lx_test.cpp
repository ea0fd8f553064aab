// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/utm30lx.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "tests/drivers/scripted_sensor.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::milliseconds;

// The scripted sensor behind a port whose reads move the time on.
struct World {
  ScriptedSensor sensor;
  HostStamp now_ns = 1'000'000'000;
  bool is_plugged = true;
  HostStamp plugged_in_ns = 0;  // plugs itself in then, and says so
  int openings = 0;
  bool has_stopped = false;
};

class WorldPort : public BytePort {
 public:
  explicit WorldPort(World& world) : world_(world) {}

  tl::expected<ByteChunk, PortError> read(std::chrono::nanoseconds timeout) override {
    for (const HostStamp end_ns = world_.now_ns + timeout.count();; world_.now_ns += 1'000'000) {
      if (!world_.is_plugged) return tl::unexpected(PortError::Closed);
      std::string bytes;
      for (const auto& [at_ns, message] : world_.sensor.send(world_.now_ns)) bytes += message;
      if (!bytes.empty() || world_.now_ns >= end_ns) return ByteChunk{world_.now_ns, bytes};
    }
  }

  tl::expected<void, PortError> write(std::string_view bytes) override {
    if (!world_.is_plugged) return tl::unexpected(PortError::Io);
    world_.has_stopped = bytes == ScipSession::stop_command();
    world_.sensor.receive(std::string(bytes), world_.now_ns);
    return {};
  }

 private:
  World& world_;
};

Utm30lx make_device(World& world, double min_backoff_s = 0.01, double max_backoff_s = 0.02) {
  ScipOptions options;
  options.min_backoff_s = min_backoff_s;
  options.max_backoff_s = max_backoff_s;
  return Utm30lx(
      {[&world]() -> tl::expected<std::unique_ptr<BytePort>, std::string> {
         ++world.openings;
         if (!world.is_plugged) return tl::unexpected(std::string("not plugged in"));
         return std::make_unique<WorldPort>(world);
       },
       [&world](std::chrono::nanoseconds timeout) {
         const HostStamp end_ns = world.now_ns + timeout.count();
         if (world.plugged_in_ns > world.now_ns && world.plugged_in_ns < end_ns) {
           world.now_ns = world.plugged_in_ns;
           return world.is_plugged = true;
         }
         world.now_ns = end_ns;
         return false;
       }},
      [&world] { return world.now_ns; }, options);
}

std::size_t poll_until_scans(Utm30lx& device, std::size_t wanted, int max_polls) {
  std::size_t scans = 0;
  for (int i = 0; i < max_polls && scans < wanted; ++i) {
    for (const ScipEvent& event : device.poll(milliseconds(20))) scans += std::holds_alternative<LaserScan>(event);
  }
  return scans;
}

TEST(Utm30lx, opens_the_port_and_gives_scans) {
  World world;
  Utm30lx device = make_device(world);
  EXPECT_FALSE(device.is_port_open());
  EXPECT_EQ(poll_until_scans(device, 100, 1000), 100U);
  EXPECT_EQ(world.openings, 1);
}

TEST(Utm30lx, waits_for_a_device_that_is_not_there_and_survives_its_loss) {
  World world;
  world.is_plugged = false;
  Utm30lx device = make_device(world);
  for (int i = 0; i < 20; ++i) device.poll(milliseconds(1));
  EXPECT_GE(world.openings, 2);
  EXPECT_FALSE(device.is_port_open());
  for (int loss = 0; loss < 3; ++loss) {
    SCOPED_TRACE(loss);
    world.is_plugged = true;
    ASSERT_EQ(poll_until_scans(device, 50, 2000), 50U);
    world.is_plugged = false;
    device.poll(milliseconds(20));
    EXPECT_FALSE(device.is_port_open());
    EXPECT_EQ(device.session().state(), ScipState::Backoff);
  }
  EXPECT_GE(device.session().counters().count(ScipTrouble::Disconnected), 4U);
}

TEST(Utm30lx, tells_why_there_is_no_port) {
  World world;
  world.is_plugged = false;
  Utm30lx device = make_device(world);
  const auto events = device.poll(milliseconds(1));
  const auto* trouble = std::get_if<ScipTroubleEvent>(&events.at(0));
  ASSERT_NE(trouble, nullptr);
  EXPECT_EQ(trouble->trouble, ScipTrouble::Disconnected);
  EXPECT_EQ(trouble->detail, "not plugged in");
}

TEST(Utm30lx, opens_a_device_as_soon_as_it_is_plugged_in) {
  World world;
  world.is_plugged = false;
  Utm30lx device = make_device(world, 10.0, 10.0);
  device.poll(milliseconds(20));
  world.plugged_in_ns = world.now_ns + 3'123'000'000;
  while (!device.is_port_open() && world.openings < 3) device.poll(milliseconds(100));
  EXPECT_TRUE(device.is_port_open());
  EXPECT_EQ(world.now_ns, world.plugged_in_ns);
}

TEST(Utm30lx, closes_and_opens_the_port_of_a_sensor_that_went_silent) {
  World world;
  Utm30lx device = make_device(world);
  ASSERT_EQ(poll_until_scans(device, 50, 2000), 50U);
  world.sensor.is_mute = true;
  for (int i = 0; i < 2000 && device.is_port_open(); ++i) device.poll(milliseconds(20));
  EXPECT_FALSE(device.is_port_open());
  world.sensor.is_mute = false;
  EXPECT_EQ(poll_until_scans(device, 50, 5000), 50U);
  EXPECT_GE(world.openings, 2);
}

TEST(Utm30lx, stops_the_sensor_when_it_goes) {
  World world;
  {
    Utm30lx device = make_device(world);
    poll_until_scans(device, 10, 1000);
    EXPECT_FALSE(world.has_stopped);
  }
  EXPECT_TRUE(world.has_stopped);
  EXPECT_FALSE(world.sensor.is_streaming);
}

}  // namespace
}  // namespace stairway::drivers
