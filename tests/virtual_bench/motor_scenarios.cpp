// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "drivers/can/socket_can_port.hpp"
#include "drivers/disk_motor.hpp"
#include "drivers/host_clock.hpp"
#include "tests/virtual_bench/machine.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

constexpr double kSpeed_rad_s = 3.0;

drivers::MotorOptions motor_options() {
  drivers::MotorOptions options;
  options.interface = Rig::kBus;
  options.acceleration_rad_s2 = 10.0;
  options.deceleration_rad_s2 = 10.0;
  options.max_backoff_s = 1.0;
  return options;
}

// The driver of the motor alone, as in scanner_scenarios.cpp.
class MotorDriver : public testing::Test {
 protected:
  ~MotorDriver() override { motor_.stop(); }

  bool comes_to(const std::function<bool()>& is_there, std::chrono::seconds timeout = 30s) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (!is_there()) {
      if (std::chrono::steady_clock::now() > end) return false;
      for (const drivers::MotorEvent& event : motor_.poll(20ms)) {
        if (const auto* trouble = std::get_if<drivers::MotorTroubleEvent>(&event)) troubles_ += trouble->detail + "; ";
        if (const auto* feedback = std::get_if<drivers::DriveFeedback>(&event)) told_rad_s_ = feedback->speed_rad_s;
      }
    }
    return true;
  }
  bool turns() {
    return comes_to([this] { return std::abs(told_rad_s_ - kSpeed_rad_s) < 0.05; });
  }
  bool state_is(drivers::MotorState state) {
    return comes_to([this, state] { return motor_.session().state() == state; });
  }
  double true_speed_rad_s() const { return std::stod(Machine::get().order("disk speed")); }

  Rig& rig_ = Machine::get().rig();
  drivers::DiskMotor motor_{{[] {
                              return drivers::open_socket_can({Rig::kBus, 1, 127});
                            }},
                            drivers::monotonic_now_ns,
                            motor_options()};
  double told_rad_s_ = 0.0;
  std::string troubles_;
};

TEST_F(MotorDriver, turns_the_disk_and_stops_it) {
  motor_.set_speed(kSpeed_rad_s);
  ASSERT_TRUE(turns()) << troubles_;
  EXPECT_NEAR(true_speed_rad_s(), kSpeed_rad_s, 0.05);
  EXPECT_TRUE(motor_.stop());
  EXPECT_EQ(true_speed_rad_s(), 0.0);
}

TEST_F(MotorDriver, the_drive_brakes_when_the_bus_is_down_and_turns_when_it_is_up) {
  motor_.set_speed(kSpeed_rad_s);
  ASSERT_TRUE(turns()) << troubles_;
  rig_.lower_bus();
  EXPECT_TRUE(state_is(drivers::MotorState::Searching)) << troubles_;
  EXPECT_TRUE(comes_to([this] { return true_speed_rad_s() == 0.0; }));
  told_rad_s_ = 0.0;
  rig_.raise_bus();
  EXPECT_TRUE(turns()) << troubles_;
}

TEST_F(MotorDriver, turns_again_when_the_interface_was_removed_and_comes_back) {
  motor_.set_speed(kSpeed_rad_s);
  ASSERT_TRUE(turns()) << troubles_;
  rig_.remove_bus();
  EXPECT_TRUE(comes_to([this] { return !motor_.is_port_open(); })) << troubles_;
  told_rad_s_ = 0.0;
  rig_.add_bus();
  EXPECT_TRUE(turns()) << troubles_;
}

}  // namespace
}  // namespace stairway::bench
