// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/speed_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace stairway::drivers {
namespace {

using Finding = std::optional<DiskTroubleEvent>;

// Of the wanted speed; slower counts as standing.
constexpr double kStandingShare = 0.2;

std::string show(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

// All digits before the point, for values that are to be typed into the settings.
std::string show_setting(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.0f", std::abs(value));
  return text.data();
}

std::string show_speed(const std::optional<double>& speed_rad_s) {
  return speed_rad_s ? show(*speed_rad_s) + " rad/s" : "nothing";
}

const char* other(bool value) { return value ? "false" : "true"; }

class Comparison {
 public:
  Comparison(const DiskSpeeds& speeds, const SpeedLimits& limits, const DiskUnits& units)
      : speeds_(speeds), limits_(limits), units_(units) {}

  Finding standing() const {
    const bool is_drive_moving = is_moving(speeds_.drive_speed_rad_s) || is_moving(speeds_.drive_position_rad_s);
    if (!is_drive_moving && !is_moving(speeds_.encoder_rad_s)) return std::nullopt;
    return found(DiskTrouble::Unasked,
                 "the disk should stand; " + readings() + ". Is it pushed, or does another program command the drive?");
  }

  Finding turning() const {
    if (auto finding = silence()) return finding;
    if (auto finding = direction()) return finding;
    if (auto finding = units()) return finding;
    return speed();
  }

 private:
  static Finding found(DiskTrouble trouble, std::string detail) { return DiskTroubleEvent{trouble, std::move(detail)}; }

  double standing_speed_rad_s() const {
    return speeds_.wanted_rad_s == 0.0 ? limits_.standing_speed_rad_s : kStandingShare * std::abs(speeds_.wanted_rad_s);
  }
  bool is_moving(const std::optional<double>& speed_rad_s) const {
    return speed_rad_s && std::abs(*speed_rad_s) > standing_speed_rad_s();
  }
  bool is_against(const std::optional<double>& speed_rad_s) const {
    return is_moving(speed_rad_s) && *speed_rad_s * speeds_.wanted_rad_s < 0.0;
  }
  bool is_near(double a, double b) const {
    return std::abs(a - b) <= limits_.tolerance * std::max(std::abs(a), std::abs(b));
  }
  std::string readings() const {
    std::string text = "the drive tells " + show_speed(speeds_.drive_speed_rad_s);
    if (speeds_.has_encoder) text += ", the encoder " + show_speed(speeds_.encoder_rad_s);
    return text;
  }
  std::string wanted() const { return show(speeds_.wanted_rad_s) + " rad/s are wanted; "; }

  Finding silence() const {
    const bool is_drive_moving = is_moving(speeds_.drive_speed_rad_s) || is_moving(speeds_.drive_position_rad_s);
    const bool is_encoder_moving = is_moving(speeds_.encoder_rad_s);
    if (!is_drive_moving && !is_encoder_moving) {
      return found(DiskTrouble::NotTurning,
                   wanted() + readings() + ". Check brake, load and the power of the drive's output stage");
    }
    if (!is_drive_moving) {
      return found(DiskTrouble::DriveSilent, wanted() + readings() + ". Check the drive's feedback");
    }
    if (speeds_.has_encoder && !is_encoder_moving) {
      return found(DiskTrouble::EncoderSilent, wanted() + readings() +
                                                   ". Check the encoder's supply, its lines A and B, and the coupling "
                                                   "between motor and disk");
    }
    return std::nullopt;
  }

  Finding direction() const {
    const bool is_drive_against = is_against(speeds_.drive_speed_rad_s) || is_against(speeds_.drive_position_rad_s);
    const bool is_encoder_against = is_against(speeds_.encoder_rad_s);
    if (!is_drive_against && !is_encoder_against) return std::nullopt;
    std::string advice;
    if (!is_drive_against) {
      advice = std::string(". Look at the disk from above: if it turns ") +
               (speeds_.wanted_rad_s > 0.0 ? "counter-clockwise" : "clockwise") +
               ", set encoder.reverse = " + other(units_.is_encoder_reversed) +
               ", else motor.reverse = " + other(units_.is_drive_reversed);
    } else if (is_encoder_against) {
      advice = ". The drive turns against its target: check its polarity (object 607E)";
    } else {
      advice = ". The drive's feedback has another sign than its target: check its polarity (object 607E)";
    }
    return found(DiskTrouble::Reversed, wanted() + readings() + advice);
  }

  Finding units() const {
    if (!speeds_.drive_speed_rad_s || !speeds_.drive_position_rad_s) return std::nullopt;
    const double speed_rad_s = *speeds_.drive_speed_rad_s, position_rad_s = *speeds_.drive_position_rad_s;
    const double truth_rad_s = speeds_.encoder_rad_s.value_or(speed_rad_s);
    const bool is_position_right = is_near(position_rad_s, truth_rad_s);
    const bool is_speed_right = is_near(speed_rad_s, truth_rad_s);
    if (is_position_right && is_speed_right) return std::nullopt;
    if (!limits_.is_check) return found(DiskTrouble::Slip, slip_text(speed_rad_s, position_rad_s));
    if (!speeds_.encoder_rad_s) return found(DiskTrouble::Mismatch, drive_text(speed_rad_s, position_rad_s));
    return found(DiskTrouble::Mismatch,
                 mismatch_text(is_speed_right, is_position_right, speed_rad_s, position_rad_s, truth_rad_s));
  }

  std::string slip_text(double speed_rad_s, double position_rad_s) const {
    if (!speeds_.encoder_rad_s)
      return "the drive tells " + show(speed_rad_s) + " rad/s, and its position changes by " + show(position_rad_s);
    return "the encoder sees " + show(*speeds_.encoder_rad_s) + " rad/s, the drive " + show(speed_rad_s) +
           " rad/s. Check the coupling between motor and disk, and the encoder for lost counts";
  }

  std::string fitting_counts(double factor) const {
    return "motor.counts_per_turn (" + show_setting(units_.counts_per_turn * factor) + " would fit)";
  }
  std::string fitting_velocity(double factor) const {
    return "motor.velocity_units_per_turn_per_s (" + show_setting(units_.velocity_units_per_turn_per_s * factor) +
           " would fit)";
  }
  std::string fitting_encoder(double factor) const {
    return "encoder.counts_per_turn (" + show_setting(units_.encoder_counts_per_turn * factor) + " would fit)";
  }

  std::string drive_text(double speed_rad_s, double position_rad_s) const {
    return "the drive's position changes " + show(position_rad_s / speed_rad_s) +
           " times as fast as its speed says: check " + fitting_counts(position_rad_s / speed_rad_s) + " or " +
           fitting_velocity(speed_rad_s / position_rad_s);
  }

  // A drive keeps the speed that it was told in its own units, so a wrong unit shows in what the disk really does.
  std::string mismatch_text(bool is_speed_right, bool is_position_right, double speed_rad_s, double position_rad_s,
                            double truth_rad_s) const {
    if (is_speed_right) {
      return "the encoder turns " + show(truth_rad_s / position_rad_s) +
             " times as fast as the drive's position says: check " + fitting_counts(position_rad_s / truth_rad_s);
    }
    std::string text =
        "the encoder turns " + show(truth_rad_s / speed_rad_s) + " times as fast as the drive says: check ";
    if (is_position_right) return text + fitting_velocity(speed_rad_s / truth_rad_s);
    text += fitting_counts(position_rad_s / truth_rad_s) + " and " + fitting_velocity(speed_rad_s / truth_rad_s);
    if (is_near(speed_rad_s, position_rad_s)) text += ", or " + fitting_encoder(truth_rad_s / position_rad_s);
    return text;
  }

  Finding speed() const {
    const double truth_rad_s = speeds_.encoder_rad_s.value_or(speeds_.drive_speed_rad_s.value_or(0.0));
    if (is_near(truth_rad_s, speeds_.wanted_rad_s)) return std::nullopt;
    return found(DiskTrouble::NotReached,
                 wanted() + readings() + ". Check load, the drive's limits of current and speed, and its ramps");
  }

  const DiskSpeeds& speeds_;
  const SpeedLimits& limits_;
  const DiskUnits& units_;
};

}  // namespace

std::optional<DiskTroubleEvent> compare_speeds(const DiskSpeeds& speeds, const SpeedLimits& limits,
                                               const DiskUnits& units) {
  const Comparison comparison(speeds, limits, units);
  return speeds.wanted_rad_s == 0.0 ? comparison.standing() : comparison.turning();
}

}  // namespace stairway::drivers
