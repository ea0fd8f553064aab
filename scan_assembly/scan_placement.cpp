// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/scan_placement.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::scan {
namespace {

using drivers::BeamStatus;
using drivers::HostStamp;
using drivers::LaserScan;
using Eigen::Vector3d;

constexpr std::size_t kMaxBeams = 65536;

double usable_interval_ns(const LaserScan& scan) {
  const bool is_usable = scan.beam_interval_ns >= 0.0 && scan.beam_interval_ns <= 1e9;
  return is_usable ? scan.beam_interval_ns : 0.0;
}

// The field to count a beam in that gives no point; null for one that does.
std::uint64_t* drop_reason(const LaserScan& scan, std::size_t beam, const RangeLimits& limits, BeamCounts& counts) {
  const double range_m = scan.ranges_m[beam];
  switch (scan.statuses[beam]) {
    case BeamStatus::Ok:
      if (!std::isfinite(range_m)) return &counts.invalid;
      return range_m < limits.min_range_m || range_m > limits.max_range_m ? &counts.out_of_limits : nullptr;
    case BeamStatus::NoReturn:
      return &counts.no_return;
    case BeamStatus::TooNear:
      return &counts.too_near;
    case BeamStatus::Disturbed:
      return &counts.disturbed;
    case BeamStatus::Invalid:
      break;
  }
  return &counts.invalid;
}

// First beam that does not belong to a segment any more.
std::size_t end_of_segment(const LaserScan& scan, HostStamp end_ns, std::size_t begin, std::size_t beams) {
  if (beam_stamp_ns(scan, beams - 1) < end_ns) return beams;
  const double beams_until_end = static_cast<double>(end_ns - scan.first_beam_stamp_ns) / scan.beam_interval_ns;
  auto end = std::clamp(static_cast<std::size_t>(std::max(0.0, beams_until_end)), begin + 1, beams);
  while (end < beams && beam_stamp_ns(scan, end) < end_ns) ++end;
  while (end > begin + 1 && beam_stamp_ns(scan, end - 1) >= end_ns) --end;
  return end;
}

}  // namespace

HostStamp beam_stamp_ns(const LaserScan& scan, std::size_t beam) {
  return scan.first_beam_stamp_ns + std::llround(static_cast<double>(beam) * usable_interval_ns(scan));
}

std::string RangeLimits::problem() const {
  if (!(min_range_m >= 0.0 && min_range_m < max_range_m)) return "0 <= min_range < max_range is needed";
  if (!(max_range_m <= 100.0)) return "max_range must not exceed 100 m";
  return {};
}

std::uint64_t BeamCounts::dropped() const {
  return no_return + too_near + disturbed + invalid + out_of_limits + no_angle + angle_invalid;
}

BeamCounts& BeamCounts::operator+=(const BeamCounts& other) {
  kept += other.kept;
  no_return += other.no_return;
  too_near += other.too_near;
  disturbed += other.disturbed;
  invalid += other.invalid;
  out_of_limits += other.out_of_limits;
  no_angle += other.no_angle;
  angle_invalid += other.angle_invalid;
  return *this;
}

ScanPlacer::ScanPlacer(const Calibration& calibration, const RangeLimits& limits)
    : calibration_(calibration), limits_(limits) {}

void ScanPlacer::place(const LaserScan& scan, const AngleTrack& track, PlacedScan& placed) {
  placed.points.clear();
  placed.beams.clear();
  placed.disk_angles_rad.clear();
  placed.last_angle_rad.reset();
  placed.counts = {};
  const std::size_t beams = std::min({scan.ranges_m.size(), scan.statuses.size(), kMaxBeams});
  if (beams == 0) return;
  const bool has_geometry = std::isfinite(scan.first_angle_rad) && std::isfinite(scan.angle_increment_rad);
  if (!has_geometry) {
    placed.counts.invalid = beams;
    return;
  }
  update_table(scan, beams);

  std::size_t beam = 0;
  while (beam < beams) {
    const auto segment = track.segment_at(beam_stamp_ns(scan, beam));
    if (segment) {
      const std::size_t end = end_of_segment(scan, segment->end_ns, beam, beams);
      beam = place_segment(scan, *segment, beam, end, placed);
      continue;
    }
    std::uint64_t& no_angle =
        segment.error() == AngleError::Invalid ? placed.counts.angle_invalid : placed.counts.no_angle;
    std::uint64_t* reason = drop_reason(scan, beam, limits_, placed.counts);
    ++(reason ? *reason : no_angle);
    ++beam;
  }
  const auto last = track.at(beam_stamp_ns(scan, beams - 1));
  if (last) placed.last_angle_rad = *last;
}

void ScanPlacer::update_table(const LaserScan& scan, std::size_t beams) {
  const bool is_same = first_angle_rad_ == scan.first_angle_rad && angle_increment_rad_ == scan.angle_increment_rad;
  if (is_same && directions_disk_.size() >= beams) return;
  first_angle_rad_ = scan.first_angle_rad;
  angle_increment_rad_ = scan.angle_increment_rad;
  directions_disk_.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const double angle_rad = first_angle_rad_ + static_cast<double>(i) * angle_increment_rad_;
    directions_disk_[i] = calibration_.T_disk_lidar.linear() * Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  }
}

std::size_t ScanPlacer::place_segment(const LaserScan& scan, const AngleSegment& segment, std::size_t begin,
                                      std::size_t end, PlacedScan& placed) const {
  const Vector3d lever_arm = calibration_.T_disk_lidar.translation();
  const double turn_per_beam_rad = segment.speed_rad_per_ns * usable_interval_ns(scan);
  const double turn_cos = std::cos(turn_per_beam_rad), turn_sin = std::sin(turn_per_beam_rad);
  const double first_rad = segment.at(beam_stamp_ns(scan, begin));
  double c = std::cos(first_rad), s = std::sin(first_rad);
  for (std::size_t beam = begin; beam < end; ++beam) {
    if (std::uint64_t* reason = drop_reason(scan, beam, limits_, placed.counts)) {
      ++*reason;
    } else {
      const Vector3d p_disk = lever_arm + static_cast<double>(scan.ranges_m[beam]) * directions_disk_[beam];
      const Vector3d turned(c * p_disk.x() - s * p_disk.y(), s * p_disk.x() + c * p_disk.y(), p_disk.z());
      placed.points.push_back((calibration_.T_base_disk * turned).cast<float>());
      placed.beams.push_back(static_cast<std::uint16_t>(beam));
      placed.disk_angles_rad.push_back(first_rad + static_cast<double>(beam - begin) * turn_per_beam_rad);
      ++placed.counts.kept;
    }
    const double next_c = c * turn_cos - s * turn_sin;
    s = s * turn_cos + c * turn_sin;
    c = next_c;
  }
  return end;
}

}  // namespace stairway::scan
