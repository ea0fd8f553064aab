// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/sweep_assembler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stairway::scan {
namespace {

using drivers::AngleSample;
using drivers::HostStamp;
using drivers::LaserScan;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kTremble_rad = 0.02;        // about 13 counts of a 4096-line encoder
constexpr double kMaxCutDistance_rad = 0.5;  // farther from the whole turn, the angle jumped
constexpr double kFlawShare = 0.01;
constexpr double kRounding_turns = 1e-9;  // keeps an angle on the boundary on its side of it
constexpr std::size_t kMaxUntaken = 2;

HostStamp last_beam_stamp_ns(const LaserScan& scan) {
  return beam_stamp_ns(scan, std::max<std::size_t>(1, scan.ranges_m.size()) - 1);
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  const double share = whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  return std::to_string(std::lround(100.0 * share)) + " %";
}

bool is_notable(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) > kFlawShare * static_cast<double>(whole);
}

}  // namespace

const char* to_string(SweepEnd end) {
  switch (end) {
    case SweepEnd::FullTurn:
      return "full turn";
    case SweepEnd::TimeLimit:
      return "time limit";
    case SweepEnd::PointLimit:
      return "point limit";
    case SweepEnd::NewStream:
      return "a pause of the scanner";
    case SweepEnd::Flushed:
      return "flushed";
  }
  return "unknown";
}

std::string SweepOptions::problem() const {
  if (const std::string problem = RangeLimits{min_range_m, max_range_m}.problem(); !problem.empty()) return problem;
  if (!(max_duration_s >= 0.1 && max_duration_s <= 600.0)) return "max_duration must lie between 0.1 and 600 s";
  if (max_points < 1000 || max_points > 20000000) return "max_points must lie between 1000 and 20000000";
  if (max_waiting_scans < 1 || max_waiting_scans > 10000) return "max_waiting_scans must lie between 1 and 10000";
  return angle.problem();
}

std::vector<std::string> SweepStatistics::flaws() const {
  std::vector<std::string> flaws;
  const std::uint64_t total = beams.total();
  if (end != SweepEnd::FullTurn)
    flaws.push_back(std::string("ended by ") + to_string(end) + ", not by a turn of the disk");
  if (!is_whole_turn) {
    flaws.push_back("covers " + std::to_string(std::lround(covered_angle_rad * 360.0 / kTurn_rad)) + " of 360 degrees");
  }
  if (beams.kept == 0) flaws.emplace_back("holds no point");
  if (lost_scans > 0) flaws.push_back(std::to_string(lost_scans) + " scans were lost");
  if (hurried_scans > 0) flaws.push_back(std::to_string(hurried_scans) + " scans did not wait for their disk angle");
  if (is_notable(beams.no_angle, total))
    flaws.push_back("no disk angle for " + percent(beams.no_angle, total) + " of the beams");
  if (is_notable(beams.angle_invalid, total)) {
    flaws.push_back("invalid disk angle for " + percent(beams.angle_invalid, total) + " of the beams");
  }
  if (is_notable(beams.disturbed, total))
    flaws.push_back(percent(beams.disturbed, total) + " of the beams were disturbed");
  return flaws;
}

SweepAssembler::SweepAssembler(const Calibration& calibration, const SweepOptions& options)
    : options_(options), placer_(calibration, {options.min_range_m, options.max_range_m}), track_(options.angle) {}

void SweepAssembler::add(LaserScan scan) {
  waiting_.push_back(std::move(scan));
  place_known_scans();
  if (waiting_.size() <= static_cast<std::size_t>(options_.max_waiting_scans)) return;
  place_oldest();
  ++sweep_->statistics.hurried_scans;
}

void SweepAssembler::add(std::span<const AngleSample> samples) {
  for (const AngleSample& sample : samples) track_.add(sample);
  place_known_scans();
}

std::optional<Sweep> SweepAssembler::take_sweep() {
  if (finished_.empty()) return std::nullopt;
  Sweep sweep = std::move(finished_.front());
  finished_.pop_front();
  return sweep;
}

void SweepAssembler::flush() {
  while (!waiting_.empty()) place_oldest();
  if (sweep_) cut_sweep(SweepEnd::Flushed);
}

void SweepAssembler::place_known_scans() {
  const auto newest_ns = track_.newest_ns();
  while (newest_ns && !waiting_.empty() && last_beam_stamp_ns(waiting_.front()) <= *newest_ns) place_oldest();
}

void SweepAssembler::place_oldest() {
  const LaserScan scan = std::move(waiting_.front());
  waiting_.pop_front();
  placer_.place(scan, track_, placed_);
  count_scan(scan);
  append_points(scan);
  sweep_->end_ns = last_beam_stamp_ns(scan);
}

void SweepAssembler::count_scan(const LaserScan& scan) {
  std::uint64_t lost = 0;
  if (last_sequence_) {
    const bool is_later = scan.sequence > *last_sequence_;
    const bool is_gap = is_later && scan.sequence - *last_sequence_ <= kMaxLostScans;
    if (is_later && !is_gap && sweep_) cut_sweep(SweepEnd::NewStream);
    lost = is_gap ? scan.sequence - *last_sequence_ - 1 : 0;
    line_ += lost + 1;
  }
  last_sequence_ = scan.sequence;

  if (sweep_) {
    const double age_s = static_cast<double>(scan.first_beam_stamp_ns - sweep_->begin_ns) * 1e-9;
    const std::size_t points = sweep_->cloud.points.size() + placed_.points.size();
    const bool is_too_long = age_s >= options_.max_duration_s;
    const bool is_too_large = points > static_cast<std::size_t>(options_.max_points);
    if (is_too_long || is_too_large) cut_sweep(is_too_long ? SweepEnd::TimeLimit : SweepEnd::PointLimit);
  }
  if (!sweep_) begin_sweep(scan.first_beam_stamp_ns);

  SweepStatistics& statistics = sweep_->statistics;
  ++statistics.scans;
  statistics.lost_scans += lost;
  statistics.beams += placed_.counts;
  statistics.beams.kept -= placed_.counts.kept;
}

void SweepAssembler::append_points(const LaserScan& scan) {
  std::size_t run_begin = 0;
  for (std::size_t i = 0; i < placed_.points.size(); ++i) {
    const double angle_rad = placed_.disk_angles_rad[i];
    if (turn_ && turn_->contains(angle_rad)) continue;
    append_run(run_begin, i);
    run_begin = i;
    follow_turn(angle_rad, beam_stamp_ns(scan, placed_.beams[i]));
  }
  append_run(run_begin, placed_.points.size());
  if (placed_.last_angle_rad) follow_turn(*placed_.last_angle_rad, last_beam_stamp_ns(scan));
}

void SweepAssembler::append_run(std::size_t begin, std::size_t end) {
  if (begin == end) return;
  const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end);
  Sweep& sweep = *sweep_;
  const auto [low, high] =
      std::minmax_element(placed_.disk_angles_rad.begin() + from, placed_.disk_angles_rad.begin() + to);
  min_angle_rad_ = sweep.cloud.points.empty() ? *low : std::min(min_angle_rad_, *low);
  max_angle_rad_ = sweep.cloud.points.empty() ? *high : std::max(max_angle_rad_, *high);
  sweep.cloud.points.insert(sweep.cloud.points.end(), placed_.points.begin() + from, placed_.points.begin() + to);
  sweep.beams.insert(sweep.beams.end(), placed_.beams.begin() + from, placed_.beams.begin() + to);
  sweep.lines.insert(sweep.lines.end(), end - begin, static_cast<std::uint32_t>(line_ - first_line_));
  sweep.statistics.beams.kept += end - begin;
  sweep.statistics.covered_angle_rad = max_angle_rad_ - min_angle_rad_;
}

void SweepAssembler::follow_turn(double angle_rad, HostStamp stamp_ns) {
  if (!turn_) {
    turn_ = first_turn(angle_rad);
    // What came before the first angle is in no sweep.
    const BeamCounts& beams = sweep_->statistics.beams;
    if (beams.no_angle + beams.angle_invalid > 0) sweep_->begin_ns = stamp_ns;
  }
  if (turn_->contains(angle_rad)) return;
  const Direction direction = angle_rad >= turn_->high_rad ? Direction::Up : Direction::Down;
  const double boundary_rad = direction == Direction::Up ? turn_->high_rad : turn_->low_rad;
  const bool is_jump = std::abs(angle_rad - boundary_rad) > kMaxCutDistance_rad;

  sweep_->statistics.is_whole_turn = turn_->entered == direction && !is_jump;
  sweep_->end_ns = stamp_ns;
  end_sweep(SweepEnd::FullTurn);
  begin_sweep(stamp_ns);
  turn_ = is_jump ? first_turn(angle_rad) : turn_entered(angle_rad, direction);
}

SweepAssembler::Turn SweepAssembler::first_turn(double angle_rad) {
  const double low_rad = std::floor(angle_rad / kTurn_rad) * kTurn_rad;
  const double high_rad = low_rad + kTurn_rad;
  const bool is_near_low = angle_rad - low_rad < kTremble_rad;
  const bool is_near_high = high_rad - angle_rad < kTremble_rad;
  return {low_rad - (is_near_low ? kTremble_rad : 0.0), high_rad + (is_near_high ? kTremble_rad : 0.0), std::nullopt};
}

SweepAssembler::Turn SweepAssembler::turn_entered(double angle_rad, Direction direction) {
  const bool is_up = direction == Direction::Up;
  const double turn = std::floor(angle_rad / kTurn_rad + (is_up ? kRounding_turns : -kRounding_turns));
  const double low_rad = turn * kTurn_rad, high_rad = (turn + 1.0) * kTurn_rad;
  if (is_up) return {low_rad - kTremble_rad, high_rad, direction};
  return {low_rad, high_rad + kTremble_rad, direction};
}

void SweepAssembler::begin_sweep(HostStamp begin_ns) {
  sweep_.emplace();
  sweep_->number = next_number_++;
  sweep_->begin_ns = begin_ns;
  sweep_->end_ns = begin_ns;
  sweep_->cloud.sensor_origin = placer_.calibration().mean_sensor_origin().cast<float>();
  sweep_->cloud.points.reserve(expected_points_);
  sweep_->lines.reserve(expected_points_);
  sweep_->beams.reserve(expected_points_);
  first_line_ = line_;
}

void SweepAssembler::cut_sweep(SweepEnd end) {
  end_sweep(end);
  if (turn_) turn_->entered.reset();
}

void SweepAssembler::end_sweep(SweepEnd end) {
  sweep_->statistics.end = end;
  expected_points_ = sweep_->cloud.points.size();
  finished_.push_back(std::move(*sweep_));
  sweep_.reset();
  if (finished_.size() <= kMaxUntaken) return;
  finished_.pop_front();
  ++untaken_sweeps_;
}

}  // namespace stairway::scan
