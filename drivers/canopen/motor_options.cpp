// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/motor_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/option_range.hpp"

namespace stairway::drivers {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFairRounding = 0.05;

}  // namespace

std::string MotorOptions::problem() const {
  const OptionRange ranges[] = {
      {"node_id", static_cast<double>(node_id), 1, 127},
      {"host_node_id", static_cast<double>(host_node_id), 1, 127},
      {"counts_per_turn", counts_per_turn, 1, 1e12},
      {"velocity_units_per_turn_per_s", velocity_units_per_turn_per_s, 1, 1e12},
      {"acceleration_units_per_turn_per_s2", acceleration_units_per_turn_per_s2, 1e-3, 1e12},
      {"acceleration", acceleration_rad_s2, 1e-3, 1000},
      {"deceleration", deceleration_rad_s2, 1e-3, 1000},
      {"quick_stop_deceleration", quick_stop_deceleration_rad_s2, 1e-3, 1000},
      {"standstill_speed", standstill_speed_rad_s, 1e-4, 1},
      {"heartbeat_s", heartbeat_s, 0.02, 10},
      {"host_heartbeat_s", host_heartbeat_s, 0.1, 10},
      {"sync_rate_hz", sync_rate_hz, 10, 500},
      {"sdo_timeout_s", sdo_timeout_s, 0.05, 10},
      {"state_timeout_s", state_timeout_s, 0.2, 60},
      {"boot_timeout_s", boot_timeout_s, 0.5, 60},
      {"reach_timeout_s", reach_timeout_s, 0.1, 600},
      {"stop_timeout_s", stop_timeout_s, 0.1, 60},
      {"max_fault_resets", static_cast<double>(max_fault_resets), 0, 100},
      {"fault_reset_window_s", fault_reset_window_s, 1, 3600},
      {"min_backoff_s", min_backoff_s, 0.01, 60},
      {"max_backoff_s", max_backoff_s, min_backoff_s, 600},
  };
  // The kernel's names have at most 15 characters, none of them a slash or a space.
  if (interface.empty() || interface.size() > 15 || interface.find_first_of("/ \t\n") != std::string::npos) {
    return "interface must be the name of a network interface like can0";
  }
  if (auto problem = range_problem(ranges); !problem.empty()) return problem;
  if (node_id == host_node_id) return "node_id and host_node_id must differ";
  return {};
}

MotorUnits::MotorUnits(const MotorOptions& options)
    : speed_of_unit_((options.reverse ? -kTurn : kTurn) / options.velocity_units_per_turn_per_s),
      angle_of_count_((options.reverse ? -kTurn : kTurn) / options.counts_per_turn),
      acceleration_of_unit_(kTurn / options.acceleration_units_per_turn_per_s2) {}

std::int32_t MotorUnits::velocity_units(double speed_rad_s) const {
  using Limits = std::numeric_limits<std::int32_t>;
  const double units = speed_rad_s / speed_of_unit_;
  if (std::isnan(units)) return 0;
  return static_cast<std::int32_t>(std::clamp(std::round(units), double{Limits::min()}, double{Limits::max()}));
}

std::uint32_t MotorUnits::acceleration_units(double acceleration_rad_s2) const {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(std::round(acceleration_rad_s2 / acceleration_of_unit_), 1.0, kMost));
}

std::string speed_problem(const MotorOptions& options, double speed_rad_s) {
  if (MotorUnits(options).velocity_units(speed_rad_s) != 0) return {};
  return std::to_string(speed_rad_s) +
         " rad/s is less than half of the drive's unit of speed; turn faster, check velocity_units_per_turn_per_s, or "
         "give the drive a finer unit";
}

std::string speed_warning(const MotorOptions& options, double speed_rad_s) {
  const MotorUnits units(options);
  const double rounded_rad_s = units.speed_rad_s(units.velocity_units(speed_rad_s));
  const double share = rounded_rad_s / speed_rad_s - 1.0;
  if (std::abs(share) <= kFairRounding) return {};
  return "in whole units of the drive " + std::to_string(speed_rad_s) + " rad/s become " +
         std::to_string(rounded_rad_s) + " rad/s (" + std::to_string(std::lround(100.0 * share)) + " %)";
}

}  // namespace stairway::drivers
