// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "drivers/can/socket_can_port.hpp"
#include "drivers/disk_encoder.hpp"
#include "drivers/disk_motor.hpp"
#include "drivers/gpio/encoder_lines.hpp"
#include "drivers/host_clock.hpp"
#include "tests/virtual_bench/machine.hpp"
#include "tests/virtual_bench/robot.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

constexpr double kSpeed_rad_s = 3.0;

drivers::MotorOptions motor_options() {
  drivers::MotorOptions options;
  options.interface = Rig::kBus;
  options.acceleration_rad_s2 = 10.0;
  options.deceleration_rad_s2 = 10.0;
  return options;
}

drivers::EncoderOptions encoder_options(drivers::GpioAccess access) {
  drivers::EncoderOptions options;
  options.chip = Rig::kEncoderChip;
  options.counts_per_turn = kEncoderCountsPerTurn;
  options.access = access;
  options.max_backoff_s = 1.0;
  return options;
}

// The drivers of the encoder and of the motor that turns it, as in scanner_scenarios.cpp.
class EncoderDriver : public testing::TestWithParam<drivers::GpioAccess> {
 protected:
  EncoderDriver() { motor_.set_speed(kSpeed_rad_s); }
  ~EncoderDriver() override { motor_.stop(); }

  bool comes_to(const std::function<bool()>& is_there) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (!is_there()) {
      if (std::chrono::steady_clock::now() > end) return false;
      motor_.poll(0ms);
      for (const drivers::EncoderEvent& event : encoder_.poll(10ms)) {
        if (const auto* trouble = std::get_if<drivers::EncoderTroubleEvent>(&event))
          troubles_ += trouble->detail + "; ";
        if (const auto* samples = std::get_if<std::vector<drivers::AngleSample>>(&event)) take(*samples);
      }
    }
    return true;
  }
  bool is_indexed() {
    return comes_to([this] { return newest_.valid; });
  }

  Rig& rig_ = Machine::get().rig();
  const drivers::EncoderOptions options_ = encoder_options(GetParam());
  drivers::DiskMotor motor_{{[] {
                              return drivers::open_socket_can({Rig::kBus, 1, 127});
                            }},
                            drivers::monotonic_now_ns,
                            motor_options()};
  drivers::DiskEncoder encoder_{
      {[this] { return drivers::open_encoder_lines(options_); }}, drivers::monotonic_now_ns, options_};
  drivers::AngleSample newest_;
  std::string troubles_;

 private:
  void take(const std::vector<drivers::AngleSample>& samples) {
    if (!samples.empty()) newest_ = samples.back();
  }
};

TEST_P(EncoderDriver, follows_the_disk_without_a_lost_edge) {
  ASSERT_TRUE(is_indexed()) << troubles_;
  const double angle_rad = newest_.angle_rad;
  EXPECT_TRUE(comes_to([&] { return newest_.angle_rad > angle_rad + 2.0 * M_PI; })) << troubles_;
  EXPECT_TRUE(newest_.valid);
  EXPECT_EQ(troubles_, "");
}

TEST_P(EncoderDriver, is_found_again_when_the_chip_was_removed_and_comes_back) {
  ASSERT_TRUE(is_indexed()) << troubles_;
  rig_.remove_encoder_chip();
  EXPECT_TRUE(comes_to([this] { return !encoder_.is_port_open(); })) << troubles_;
  newest_ = {};
  rig_.add_encoder_chip();
  EXPECT_TRUE(is_indexed()) << troubles_;
}

TEST_P(EncoderDriver, finds_its_lines_by_name_and_tells_who_has_them) {
  drivers::EncoderOptions options = options_;
  options.line_a = "disk-a";
  options.line_b = "disk-b";
  options.line_index = "disk-index";
  const auto port = drivers::open_encoder_lines(options);
  ASSERT_TRUE(port) << port.error();
  const auto second = drivers::open_encoder_lines(options_);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("is in use by stairwayd"), std::string::npos) << second.error();
  options.line_b = "disk-c";
  const auto unknown = drivers::open_encoder_lines(options);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().find("disk-c"), std::string::npos) << unknown.error();
}

INSTANTIATE_TEST_SUITE_P(Access, EncoderDriver,
                         testing::Values(drivers::GpioAccess::Kernel, drivers::GpioAccess::Libgpiod),
                         [](const testing::TestParamInfo<drivers::GpioAccess>& access) {
                           return access.param == drivers::GpioAccess::Kernel ? "kernel" : "libgpiod";
                         });

}  // namespace
}  // namespace stairway::bench
