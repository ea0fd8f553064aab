// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "drivers/types.hpp"

namespace stairway::scan {

struct AngleTrackOptions {
  double max_gap_s = 0.25;            ///< longest gap between samples that a line may bridge [s], 0.001..10
  double max_extrapolation_s = 0.01;  ///< how far past the newest sample the angle is still told [s], 0..1
  int max_samples = 20000;            ///< history; older samples are forgotten [samples], 2..10000000

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

enum class AngleError {
  Unknown,  ///< before the history, after the newest sample, or inside a gap
  Invalid,  ///< next to a sample that was not valid
};

/// A stretch of time in which the angle follows one line.
struct AngleSegment {
  drivers::HostStamp begin_ns = 0;  ///< [ns]
  drivers::HostStamp end_ns = 0;    ///< first instant that belongs to the next segment [ns]
  double angle_rad = 0.0;           ///< at `begin_ns` [rad]
  double speed_rad_per_ns = 0.0;    ///< [rad/ns]

  double at(drivers::HostStamp stamp_ns) const {
    return angle_rad + speed_rad_per_ns * static_cast<double>(stamp_ns - begin_ns);
  }
};

/// The disk's angle as a function of time: straight lines between samples.
class AngleTrack {
 public:
  /// @pre  options.problem() is empty.
  explicit AngleTrack(const AngleTrackOptions& options = {}) : options_(options) {}

  /// Takes the next sample; one that is not newer than the last, or not finite, is left out (false) and counted.
  bool add(const drivers::AngleSample& sample);

  /// The angle [rad], by interpolation, or for `max_extrapolation_s` past the newest sample by its line.
  /// O(log samples).
  tl::expected<double, AngleError> at(drivers::HostStamp stamp_ns) const;

  /// The line that holds at `stamp_ns`; for loops over beams.
  tl::expected<AngleSegment, AngleError> segment_at(drivers::HostStamp stamp_ns) const;

  /// Stamp of the newest sample, valid or not; empty before the first.
  std::optional<drivers::HostStamp> newest_ns() const;

  /// Mean speed over the newest 0.2 s of valid samples [rad/s]; empty when the newest sample is invalid or alone.
  std::optional<double> speed_rad_s() const;

  std::uint64_t refused_samples() const { return refused_samples_; }
  std::size_t size() const { return samples_.size(); }

 private:
  bool is_bridged(const drivers::AngleSample& from, const drivers::AngleSample& to) const;
  tl::expected<AngleSegment, AngleError> line_through(const drivers::AngleSample& from,
                                                      const drivers::AngleSample& to) const;
  tl::expected<AngleSegment, AngleError> segment_past_newest(drivers::HostStamp stamp_ns) const;

  AngleTrackOptions options_;
  std::deque<drivers::AngleSample> samples_;
  std::uint64_t refused_samples_ = 0;
};

}  // namespace stairway::scan
