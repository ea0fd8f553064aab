// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/encoder/encoder_options.hpp"

#include <cmath>
#include <numbers>

namespace stairway::drivers {
namespace {

constexpr double kSafeReturn_s = 0.010;

}  // namespace

std::string EncoderOptions::problem() const {
  if (chip.empty()) return "chip must name a GPIO chip, e.g. gpiochip0 or its label";
  if (line_a.empty() || line_b.empty()) return "line_a and line_b must be offsets or names of lines";
  if (line_a == line_b || line_a == line_index || line_b == line_index) return "each line must be another one";
  if (counts_per_turn < 4 || counts_per_turn > 1'000'000 || counts_per_turn % 4 != 0)
    return "counts_per_turn counts all edges of A and B, so it must be a multiple of 4 within 4 .. 1000000";
  if (index_tolerance < 0 || 4 * index_tolerance >= counts_per_turn)
    return "index_tolerance must lie within 0 and a quarter of counts_per_turn";
  if (!(harmonic_rad >= 0.0 && harmonic_rad <= 0.1)) return "harmonic must lie within 0 .. 100 mrad";
  if (!(std::abs(harmonic_phase_rad) <= std::numbers::pi + 1e-9)) return "harmonic_phase must lie within 180 degrees";
  if (event_buffer < 16 || event_buffer > 1024) return "event_buffer must lie within 16 .. 1024";
  if (debounce_us < 0 || debounce_us > 100'000) return "debounce must lie within 0 .. 100000 us";
  if (!(min_backoff_s >= 0.01 && min_backoff_s <= 60.0)) return "min_backoff must lie within 0.01 .. 60 s";
  if (!(max_backoff_s >= min_backoff_s && max_backoff_s <= 600.0))
    return "max_backoff must lie between min_backoff and 600 s";
  return {};
}

std::string edge_rate_problem(const EncoderOptions& options, double speed_rad_s, int queued_edges) {
  const double counts_per_s = options.counts_per_turn * std::abs(speed_rad_s) / (2.0 * std::numbers::pi);
  const double slack_s = queued_edges / (counts_per_s / 2.0);  // each line has every other edge
  if (!(slack_s < kSafeReturn_s)) return {};
  return std::to_string(std::lround(counts_per_s)) + " edges per second fill the kernel's queue in " +
         std::to_string(std::lround(1e6 * slack_s)) +
         " us; turn slower, or read the lines by the kernel's interface (encoder.access)";
}

}  // namespace stairway::drivers
