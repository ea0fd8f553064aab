// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/types.hpp"
#include "scan_assembly/angle_track.hpp"
#include "scan_assembly/frames.hpp"
#include "scan_assembly/point_cloud.hpp"
#include "scan_assembly/scan_placement.hpp"

namespace stairway::scan {

struct SweepOptions {
  double min_range_m = 0.1;      ///< nearer returns are dropped [m], >= 0; the scanner's specified range
  double max_range_m = 30.0;     ///< farther ones likewise [m], > min_range, <= 100
  double max_duration_s = 60.0;  ///< a sweep is cut after this even if the disk has not turned once [s], 0.1..600
  int max_points = 3000000;      ///< and when it holds this many points [points], 1000..20000000
  int max_waiting_scans = 40;    ///< scans held back until their disk angle is known [scans], 1..10000
  AngleTrackOptions angle;

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// More scans are not lost in a row; a larger step of the sequence numbers says that the stream began anew.
inline constexpr std::uint64_t kMaxLostScans = 100000;

/// Why a sweep ended where it did.
enum class SweepEnd {
  FullTurn,    ///< the disk passed a whole turn
  TimeLimit,   ///< max_duration_s: the disk stands, turns too slowly, or its angle is not known
  PointLimit,  ///< max_points
  NewStream,   ///< the scanner's stream paused, and began anew at a much larger sequence number
  Flushed,     ///< the caller asked for it
};
const char* to_string(SweepEnd end);

struct SweepStatistics {
  SweepEnd end = SweepEnd::FullTurn;  ///< says nothing before the sweep has ended
  bool is_whole_turn = false;         ///< began and ended at whole turns of the disk
  double covered_angle_rad = 0.0;     ///< between the smallest and the largest disk angle of its points [rad]
  BeamCounts beams;                   ///< of its scans; a scan across the cut counts where it began, but for `kept`
  std::uint64_t scans = 0;            ///< mirror turns that began in it
  std::uint64_t lost_scans = 0;       ///< missing between them by their sequence numbers
  std::uint64_t hurried_scans = 0;    ///< placed before their angle was known, since too many were waiting

  /// Whether it covers a turn, but for a degree or three, wherever it began.
  bool covers_whole_turn() const { return covered_angle_rad >= 0.99 * 2.0 * std::numbers::pi; }

  /// What a person should know before trusting the cloud, one sentence each; empty for a good sweep.
  std::vector<std::string> flaws() const;
};

/// One turn of the disk. `cloud.points`, `lines` and `beams` belong together; points stand in the order of measurement.
struct Sweep {
  std::uint64_t number = 0;          ///< counts from 0
  drivers::HostStamp begin_ns = 0;   ///< its first beam; the first sweep begins with the first disk angle [ns]
  drivers::HostStamp end_ns = 0;     ///< last beam of its last scan [ns]
  PointCloud cloud;                  ///< `base` frame; `sensor_origin` = the mean place of the scanner
  std::vector<std::uint32_t> lines;  ///< mirror turn of the point, 0 = the first of the sweep, lost ones counted
  std::vector<std::uint16_t> beams;  ///< index of the point's beam in its scan
  SweepStatistics statistics;
};

/// Builds sweeps from scans and disk angles that arrive in any interleaving.
///
/// A scan waits until the angle is known at its last beam (at most `max_waiting_scans` do; then the oldest is placed
/// with the angles there are). Every beam gets its own time and angle. The disk may turn either way; a sweep is cut at
/// the beam where the angle passes a whole turn, and trembling about that place cuts only once. The first sweep may be
/// a part of a turn. A sweep comes out even when it is poor or empty, with the reasons in its statistics. Memory is
/// bounded by the options.
///
/// Scans must come in the order of time, and angle samples likewise; a scan that begins before the one before it ended
/// is taken as it is.
class SweepAssembler {
 public:
  /// @pre  options.problem() is empty.
  explicit SweepAssembler(const Calibration& calibration, const SweepOptions& options = {});

  void add(drivers::LaserScan scan);
  void add(std::span<const drivers::AngleSample> samples);

  /// The oldest finished sweep; empty when none is. Call it after every `add`: of sweeps nobody takes, the newest two
  /// are kept.
  std::optional<Sweep> take_sweep();

  /// What the next sweep holds so far, up to the last beam of its newest scan that is placed; null when none has begun.
  /// It grows with the next `add`: whoever wants to look at it for longer takes a copy.
  const Sweep* sweep_under_way() const { return sweep_ ? &*sweep_ : nullptr; }

  /// Places what is waiting with the angles there are and ends the sweep, if it has begun.
  void flush();

  const AngleTrack& angle_track() const { return track_; }
  std::size_t waiting_scans() const { return waiting_.size(); }
  std::uint64_t untaken_sweeps() const { return untaken_sweeps_; }

 private:
  enum class Direction { Up, Down };
  // The disk angles that do not end the sweep: [low, high).
  struct Turn {
    double low_rad = 0.0;
    double high_rad = 0.0;
    std::optional<Direction> entered;  // empty when the sweep did not begin at a whole turn
    bool contains(double angle_rad) const { return angle_rad >= low_rad && angle_rad < high_rad; }
  };

  static Turn first_turn(double angle_rad);
  static Turn turn_entered(double angle_rad, Direction direction);

  void place_known_scans();
  void place_oldest();
  void begin_sweep(drivers::HostStamp begin_ns);
  void count_scan(const drivers::LaserScan& scan);
  void append_points(const drivers::LaserScan& scan);
  void append_run(std::size_t begin, std::size_t end);
  void follow_turn(double angle_rad, drivers::HostStamp stamp_ns);
  void cut_sweep(SweepEnd end);
  void end_sweep(SweepEnd end);

  SweepOptions options_;
  ScanPlacer placer_;
  AngleTrack track_;
  std::deque<drivers::LaserScan> waiting_;
  PlacedScan placed_;

  std::optional<Sweep> sweep_;
  std::optional<Turn> turn_;
  double min_angle_rad_ = 0.0;
  double max_angle_rad_ = 0.0;
  std::uint64_t line_ = 0;        // of the scan at hand
  std::uint64_t first_line_ = 0;  // of the sweep
  std::optional<std::uint64_t> last_sequence_;
  std::uint64_t next_number_ = 0;
  std::size_t expected_points_ = 0;
  std::deque<Sweep> finished_;
  std::uint64_t untaken_sweeps_ = 0;
};

}  // namespace stairway::scan
