// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk_motor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tools/sim/fake_can_bus.hpp"
#include "tools/sim/fake_drive.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr HostStamp kMs = 1'000'000;

// A simulated drive on a bus whose readers move the time on.
struct World {
  sim::FakeDrive drive{sim::FakeDriveOptions{}};
  sim::FakeCanBus bus{drive};
  HostStamp now_ns = 0;
  std::vector<HostStamp> openings_ns;
  bool is_cable_seen = false;  // what the opener's wait says
  std::vector<std::string> states;

  void take(const std::vector<MotorEvent>& events) {
    for (const MotorEvent& event : events) {
      if (const auto* state = std::get_if<MotorStateEvent>(&event)) states.emplace_back(to_string(state->state));
    }
  }
};

class WorldPort : public CanPort {
 public:
  explicit WorldPort(World& world) : world_(world) {}

  tl::expected<std::vector<CanArrival>, PortError> read(nanoseconds timeout) override {
    const HostStamp end_ns = world_.now_ns + timeout.count();
    for (;;) {
      auto arrivals = world_.bus.take(world_.now_ns);
      if (!arrivals || !arrivals->empty() || world_.now_ns >= end_ns) return arrivals;
      world_.now_ns = std::clamp(world_.bus.next_due_ns(), world_.now_ns + 1, end_ns);
    }
  }
  tl::expected<void, PortError> write(const CanFrame& frame) override { return world_.bus.write(frame, world_.now_ns); }

 private:
  World& world_;
};

DiskMotor make_motor(World& world) {
  PortOpener<CanPort> opener(
      [&world]() -> tl::expected<std::unique_ptr<CanPort>, std::string> {
        world.openings_ns.push_back(world.now_ns);
        if (world.bus.is_removed()) return tl::unexpected(std::string("can0 does not exist"));
        return std::make_unique<WorldPort>(world);
      },
      [&world](nanoseconds timeout) {
        world.now_ns += world.is_cable_seen ? 0 : timeout.count();
        return world.is_cable_seen;
      });
  return DiskMotor(
      std::move(opener), [&world] { return world.now_ns; }, MotorOptions{});
}

void run(World& world, DiskMotor& motor, double seconds) {
  for (const HostStamp end_ns = world.now_ns + static_cast<HostStamp>(1e9 * seconds); world.now_ns < end_ns;) {
    world.take(motor.poll(milliseconds(50)));
  }
}

TEST(DiskMotor, opens_the_port_and_turns_the_disk) {
  World world;
  DiskMotor motor = make_motor(world);
  motor.set_speed(0.18);
  EXPECT_FALSE(motor.is_port_open());
  run(world, motor, 2.0);
  EXPECT_EQ(world.openings_ns.size(), 1U);
  EXPECT_NEAR(world.drive.disk_speed_rad_s(), 0.18, 1e-4);
  EXPECT_GT(motor.session().counters().feedbacks, 100U);
}

TEST(DiskMotor, stops_the_disk_when_it_is_told_or_destroyed) {
  World world;
  {
    DiskMotor motor = make_motor(world);
    motor.set_speed(0.5);
    run(world, motor, 3.0);
    EXPECT_TRUE(motor.stop());
    EXPECT_EQ(world.drive.disk_speed_rad_s(), 0.0);
    motor.start();
    run(world, motor, 3.0);
    EXPECT_NEAR(world.drive.disk_speed_rad_s(), 0.5, 1e-4);
  }
  EXPECT_EQ(world.drive.disk_speed_rad_s(), 0.0);
  EXPECT_EQ(world.drive.state(), DriveState::SwitchOnDisabled);
}

TEST(DiskMotor, stops_early_without_a_bus) {
  for (const bool is_removed : {false, true}) {
    World world;
    DiskMotor motor = make_motor(world);
    motor.set_speed(0.5);
    run(world, motor, 3.0);
    if (is_removed) world.bus.set_removed(true);
    if (!is_removed) world.bus.set_unheard(true, world.now_ns);
    const HostStamp begin_ns = world.now_ns;
    EXPECT_FALSE(motor.stop());
    EXPECT_EQ(motor.session().state(), MotorState::Stopped);
    EXPECT_LT(world.now_ns - begin_ns, 1000 * kMs);
  }
}

TEST(DiskMotor, tries_an_absent_interface_less_and_less_often) {
  World world;
  world.bus.set_removed(true);
  DiskMotor motor = make_motor(world);
  run(world, motor, 30.0);
  const std::vector<HostStamp> expected{0, 500 * kMs, 1500 * kMs, 3500 * kMs, 7500 * kMs, 15500 * kMs, 25500 * kMs};
  EXPECT_EQ(world.openings_ns, expected);
  EXPECT_EQ(motor.session().state(), MotorState::Backoff);
  EXPECT_EQ(motor.session().counters().count(MotorTrouble::Disconnected), expected.size());
}

TEST(DiskMotor, tries_at_once_when_the_interface_is_seen_to_come) {
  World world;
  world.bus.set_removed(true);
  DiskMotor motor = make_motor(world);
  run(world, motor, 10.0);
  world.bus.set_removed(false);
  world.is_cable_seen = true;
  const HostStamp begin_ns = world.now_ns;
  for (int i = 0; i < 3 && !motor.is_port_open(); ++i) motor.poll(milliseconds(50));
  EXPECT_TRUE(motor.is_port_open());
  EXPECT_EQ(world.now_ns, begin_ns);
}

TEST(DiskMotor, opens_another_port_after_the_interface_was_removed) {
  World world;
  DiskMotor motor = make_motor(world);
  motor.set_speed(0.18);
  run(world, motor, 3.0);
  world.bus.set_removed(true);
  run(world, motor, 1.0);
  EXPECT_FALSE(motor.is_port_open());
  world.bus.set_removed(false);
  run(world, motor, 10.0);
  EXPECT_EQ(motor.session().state(), MotorState::Running);
  EXPECT_NEAR(world.drive.disk_speed_rad_s(), 0.18, 1e-4);
}

TEST(DiskMotor, keeps_the_port_while_frames_cannot_be_placed) {
  World world;
  DiskMotor motor = make_motor(world);
  motor.set_speed(0.18);
  run(world, motor, 3.0);
  world.bus.set_unheard(true, world.now_ns);
  run(world, motor, 5.0);
  EXPECT_TRUE(motor.is_port_open());
  EXPECT_EQ(world.openings_ns.size(), 1U);
  world.bus.set_unheard(false, world.now_ns);
  run(world, motor, 5.0);
  EXPECT_EQ(motor.session().state(), MotorState::Running);
}

TEST(DiskMotor, a_bus_that_is_down_from_the_start_is_named_as_such) {
  World world;
  world.bus.set_link(false, 0);
  DiskMotor motor = make_motor(world);
  std::vector<std::string> told;
  while (world.now_ns < 2000 * kMs) {
    for (const MotorEvent& event : motor.poll(milliseconds(50))) {
      if (const auto* trouble = std::get_if<MotorTroubleEvent>(&event)) told.push_back(trouble->detail);
    }
  }
  EXPECT_EQ(told, std::vector<std::string>{"can0: the interface is down; `ip link set can0 up`"});
  world.bus.set_link(true, world.now_ns);
  run(world, motor, 2.0);
  EXPECT_EQ(motor.session().state(), MotorState::Running);
}

TEST(DiskMotor, quick_stop_ends_in_stopped) {
  World world;
  DiskMotor motor = make_motor(world);
  motor.set_speed(1.0);
  run(world, motor, 3.0);
  motor.quick_stop();
  run(world, motor, 1.0);
  EXPECT_EQ(motor.session().state(), MotorState::Stopped);
  EXPECT_EQ(world.drive.disk_speed_rad_s(), 0.0);
  EXPECT_EQ(world.states.back(), "stopped");
}

}  // namespace
}  // namespace stairway::drivers
