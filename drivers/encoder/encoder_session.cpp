// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/encoder/encoder_session.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drivers/backoff.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kRepeat_ns = 50'000'000;
constexpr HostStamp kLongestPatience_ns = 200'000'000;
constexpr HostStamp kRateReport_ns = 10'000'000'000;
constexpr double kStandstill_ns = 0.2e9;
constexpr std::size_t kSpeedSamples = 9;  // two whole periods, so that lines of uneven width make no difference
constexpr int kLeastAlone = 16;

std::int64_t distance(std::int64_t a, std::int64_t b) { return std::abs(a - b); }

const char* name_of(EncoderLine line) {
  return line == EncoderLine::A ? "A" : line == EncoderLine::B ? "B" : "the index";
}

}  // namespace

EncoderSession::EncoderSession(const EncoderOptions& options) : options_(options) {}

std::vector<EncoderEvent> EncoderSession::on_open(const LineLevels& levels, int queued_edges) {
  failures_ = 0;
  queued_edges_ = queued_edges;
  decoder_ = QuadratureDecoder();
  set_levels(levels.a, levels.b);
  asked_ns_ = last_edge_ns_ = levels.asked_ns;
  levels_ns_ = last_step_ns_ = levels.stamp_ns;
  interval_ns_ = 0;
  last_line_ = EncoderLine::Index;
  direction_ = alone_ = 0;
  index_at_.reset();
  recent_.clear();
  is_doubtful_ = false;
  watched_from_ = count_;
  enter(has_index_line() ? EncoderState::Unindexed : EncoderState::Indexed);
  // Somewhere between two boundaries.
  emit(levels.stamp_ns, angle_of(static_cast<double>(count_) + 0.5));
  return take_events();
}

std::vector<EncoderEvent> EncoderSession::on_edges(const EdgeBatch& batch) {
  if (batch.lost_edges > 0) {
    counters_.lost_edges += batch.lost_edges;
    report(EncoderTrouble::LostEdges, std::to_string(batch.lost_edges) +
                                          " edges were not read in time; turn slower or give the reader more "
                                          "priority");
    lose_track();
  }
  for (const Edge& edge : batch.edges) take(edge);
  if (!batch.edges.empty()) watch_rate(batch.edges.back().stamp_ns);
  repeat_angle(batch.complete_ns);
  return take_events();
}

std::vector<EncoderEvent> EncoderSession::on_levels(const LineLevels& levels) {
  is_doubtful_ = false;
  direction_ = 0;
  if (set_levels(levels.a, levels.b) == QuadratureStep::Illegal)
    report(EncoderTrouble::IllegalTransition, "A and B both changed while edges were lost");
  asked_ns_ = std::max(asked_ns_, levels.asked_ns);
  levels_ns_ = std::max(levels_ns_, levels.stamp_ns);
  return take_events();
}

std::vector<EncoderEvent> EncoderSession::on_disconnect(HostStamp now_ns, std::string_view detail) {
  report(EncoderTrouble::Disconnected, std::string(detail));
  enter(EncoderState::Absent);
  deadline_ns_ = now_ns + backoff_ns(++failures_, options_.min_backoff_s, options_.max_backoff_s);
  return take_events();
}

void EncoderSession::retry_now(HostStamp now_ns) { deadline_ns_ = std::min(deadline_ns_, now_ns); }

std::optional<double> EncoderSession::speed_rad_s(HostStamp now_ns) const {
  if (recent_.size() < 2) return std::nullopt;
  const double span_ns = static_cast<double>(recent_.back().stamp_ns - recent_.front().stamp_ns);
  const double interval_ns = span_ns / static_cast<double>(recent_.size() - 1);
  const auto age_ns = static_cast<double>(now_ns - recent_.back().stamp_ns);
  if (age_ns > std::max(kStandstill_ns, 3.0 * interval_ns) || span_ns <= 0.0) return 0.0;
  return 1e9 * (recent_.back().angle_rad - recent_.front().angle_rad) / span_ns;
}

void EncoderSession::take(const Edge& edge) {
  if (is_in_levels(edge)) return;
  if (edge.stamp_ns < last_edge_ns_) {
    report(EncoderTrouble::LostEdges, std::string("an edge of ") + name_of(edge.line) + " came too late to be counted");
    return lose_track();
  }
  ++counters_.edges;
  if (edge.line == EncoderLine::Index) {
    if (!index_change_) index_change_ = IndexChange{.was_high = !edge.is_rising};
    index_change_->is_high = edge.is_rising;
    return;
  }

  const bool is_tie = edge.stamp_ns == last_edge_ns_ && edge.line != last_line_ && last_line_ != EncoderLine::Index;
  alone_ = edge.line == last_line_ ? alone_ + 1 : 0;
  last_edge_ns_ = edge.stamp_ns;
  last_line_ = edge.line;
  watch_for_other_line();
  if (level_of(edge.line) == edge.is_rising) {
    report(EncoderTrouble::MissedPair,
           std::string(name_of(edge.line)) + (edge.is_rising ? " rose twice in a row" : " fell twice in a row"));
    return lose_track();
  }
  const bool is_a = edge.line == EncoderLine::A;
  const QuadratureStep step =
      set_levels(is_a ? edge.is_rising : level_of(EncoderLine::A), is_a ? level_of(EncoderLine::B) : edge.is_rising);
  take_step(step, edge.stamp_ns);
  if (!is_tie) return;
  report(EncoderTrouble::IllegalTransition, "A and B changed at the same time");
  lose_track();
}

bool EncoderSession::is_in_levels(const Edge& edge) const {
  if (edge.stamp_ns < asked_ns_) return true;
  return edge.stamp_ns < levels_ns_ && edge.line != EncoderLine::Index && level_of(edge.line) == edge.is_rising;
}

QuadratureStep EncoderSession::set_levels(bool a, bool b) {
  return options_.reverse ? decoder_.take(b, a) : decoder_.take(a, b);
}

bool EncoderSession::level_of(EncoderLine line) const {
  return (line == EncoderLine::A) != options_.reverse ? decoder_.a() : decoder_.b();
}

void EncoderSession::take_step(QuadratureStep step, HostStamp stamp_ns) {
  const int direction = step == QuadratureStep::Forward ? 1 : -1;
  const auto index_change = std::exchange(index_change_, std::nullopt);
  // Edges may be missing among those that came since there is doubt.
  if (index_change && direction == direction_ && !is_doubtful_) take_index(*index_change);
  direction_ = direction;
  count_ += direction_;
  // Both ways across, a boundary is the same place.
  const std::int64_t boundary = direction_ > 0 ? count_ : count_ + 1;
  watch_for_index();
  emit(stamp_ns, angle_of(static_cast<double>(boundary)));
  interval_ns_ = stamp_ns - std::exchange(last_step_ns_, stamp_ns);
  recent_.push_back({stamp_ns, samples_.back().angle_rad});
  if (recent_.size() > kSpeedSamples) recent_.erase(recent_.begin());
}

void EncoderSession::take_index(const IndexChange& change) {
  // The mark begins within this count: below the count the line is low.
  const bool has_begin = direction_ > 0 ? !change.was_high : !change.is_high;
  if (!has_begin || !has_index_line()) return;
  ++counters_.indices;
  const std::int64_t turn = options_.counts_per_turn;
  const std::int64_t nearest =
      is_zeroed_ ? turn * std::llround(static_cast<double>(count_) / static_cast<double>(turn)) : 0;
  const std::int64_t deviation = count_ - nearest;
  const bool is_expected = distance(count_, nearest) <= options_.index_tolerance;
  if (deviation != 0) recent_.clear();
  count_ = watched_from_ = nearest;
  is_zeroed_ = true;
  const bool was_tracked = std::exchange(index_at_, nearest).has_value();
  if (!was_tracked || is_expected) return enter(EncoderState::Indexed);
  report(EncoderTrouble::IndexDeviation, "the index came " + std::to_string(deviation) + " counts aside of " +
                                             std::to_string(turn) +
                                             " in a turn; check encoder.counts_per_turn and the wiring");
  enter(EncoderState::Unindexed);
}

void EncoderSession::watch_for_index() {
  if (!has_index_line() || 2 * distance(count_, watched_from_) <= 3 * options_.counts_per_turn) return;
  report(EncoderTrouble::IndexMissing,
         "no index in one and a half turns; check encoder.line_index, "
         "encoder.counts_per_turn and the wiring");
  watched_from_ = count_;
  index_at_.reset();
  enter(EncoderState::Unindexed);
}

void EncoderSession::watch_for_other_line() {
  if (alone_ < std::max(kLeastAlone, options_.counts_per_turn / 8)) return;
  report(EncoderTrouble::DeadLine,
         std::string("only ") + name_of(last_line_) + " changes; check the other line's wiring");
  alone_ = 0;
  lose_track();
}

void EncoderSession::watch_rate(HostStamp stamp_ns) {
  if (rate_reported_ns_ && stamp_ns - *rate_reported_ns_ < kRateReport_ns) return;
  const auto speed_rad_s = this->speed_rad_s(stamp_ns);
  if (!speed_rad_s) return;
  const std::string problem = edge_rate_problem(options_, *speed_rad_s, queued_edges_);
  if (problem.empty()) return;
  rate_reported_ns_ = stamp_ns;
  report(EncoderTrouble::EdgeRate, problem);
}

void EncoderSession::lose_track() {
  is_doubtful_ = true;
  recent_.clear();
  if (!has_index_line()) return;
  index_at_.reset();
  enter(EncoderState::Unindexed);
}

void EncoderSession::repeat_angle(HostStamp stamp_ns) {
  if (!last_sample_ || state_ == EncoderState::Absent) return;
  // A slow disk is not at rest between two edges.
  const HostStamp patience_ns = std::clamp(2 * interval_ns_, kRepeat_ns, kLongestPatience_ns);
  if (stamp_ns - last_sample_->stamp_ns < kRepeat_ns || stamp_ns - last_step_ns_ < patience_ns) return;
  emit(stamp_ns, last_sample_->angle_rad);
}

void EncoderSession::emit(HostStamp stamp_ns, double angle_rad) {
  // An edge may have waited for its interrupt while the angle before it was repeated.
  if (last_sample_) stamp_ns = std::max(stamp_ns, last_sample_->stamp_ns);
  last_sample_ = AngleSample{stamp_ns, angle_rad, state_ == EncoderState::Indexed};
  samples_.push_back(*last_sample_);
}

void EncoderSession::enter(EncoderState state) {
  if (std::exchange(state_, state) == state) return;
  // What came before belongs to the state before.
  if (!samples_.empty()) events_.emplace_back(std::exchange(samples_, {}));
  events_.emplace_back(EncoderStateEvent{state});
}

void EncoderSession::report(EncoderTrouble trouble, std::string detail) {
  ++counters_.troubles[static_cast<std::size_t>(trouble)];
  events_.emplace_back(EncoderTroubleEvent{trouble, std::move(detail)});
}

double EncoderSession::angle_of(double boundary) const {
  const double angle_rad = 2.0 * std::numbers::pi / options_.counts_per_turn * boundary;
  return angle_rad - options_.harmonic_rad * std::sin(angle_rad + options_.harmonic_phase_rad);
}

std::vector<EncoderEvent> EncoderSession::take_events() {
  if (!samples_.empty()) events_.emplace_back(std::exchange(samples_, {}));
  return std::exchange(events_, {});
}

}  // namespace stairway::drivers
