// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_encoder_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace stairway::sim {
namespace {

using drivers::EncoderLine;
using drivers::HostStamp;

constexpr HostStamp kNever_ns = std::numeric_limits<HostStamp>::max();
constexpr std::int64_t kTicksPerCount = 4;
constexpr std::int64_t kIndexBegin = 1;
constexpr std::int64_t kIndexEnd = 2;
constexpr HostStamp kBounce_ns = 10'000;

std::int64_t floor_mod(std::int64_t value, std::int64_t modulus) { return ((value % modulus) + modulus) % modulus; }

// The first tick after `tick`, or backwards the first at or before it, that is `phase` away from a multiple of
// `period`.
std::int64_t next_multiple(std::int64_t tick, std::int64_t phase, std::int64_t period, int direction) {
  const std::int64_t behind = tick - floor_mod(tick - phase, period);
  return direction > 0 ? behind + period : behind;
}

bool level_a(std::int64_t count) { return floor_mod(count, 4) >= 2; }
bool level_b(std::int64_t count) { return floor_mod(count + 3, 4) <= 1; }

}  // namespace

FakeEncoderLines::FakeEncoderLines(const DiskMotion& motion, HostStamp start_ns, int counts_per_turn,
                                   std::uint64_t seed)
    : ticks_per_turn_{kTicksPerCount * counts_per_turn},
      radians_per_tick_{2.0 * std::numbers::pi / static_cast<double>(ticks_per_turn_)},
      random_{seed},
      stamp_ns_{start_ns},
      tick_{static_cast<std::int64_t>(std::floor(motion.angle_at(start_ns) / radians_per_tick_))} {
  const std::int64_t count = tick_ >= 0 ? tick_ / kTicksPerCount : -((-tick_ + kTicksPerCount - 1) / kTicksPerCount);
  levels_ = {start_ns, start_ns, level_a(count), level_b(count), floor_mod(tick_, ticks_per_turn_) == kIndexBegin};
}

std::int64_t FakeEncoderLines::index_end() const { return kIndexEnd + kTicksPerCount * faults_.index_width; }

std::int64_t FakeEncoderLines::next_boundary(int direction) const {
  const std::int64_t shift = kTicksPerCount * faults_.index_shift;
  const std::int64_t edge = next_multiple(tick_, 0, kTicksPerCount, direction);
  const std::int64_t begin = next_multiple(tick_, kIndexBegin + shift, ticks_per_turn_, direction);
  const std::int64_t end = next_multiple(tick_, index_end() + shift, ticks_per_turn_, direction);
  return direction > 0 ? std::min({edge, begin, end}) : std::max({edge, begin, end});
}

HostStamp FakeEncoderLines::next_due_ns(const DiskMotion& motion) const {
  const HostStamp change = motion.next_change(stamp_ns_).value_or(kNever_ns);
  const double speed = motion.speed_at(stamp_ns_);
  if (speed == 0.0) return change;
  const double target = radians_per_tick_ * static_cast<double>(next_boundary(speed > 0 ? 1 : -1));
  const double wait_ns = 1e9 * (target - motion.angle_at(stamp_ns_)) / speed;
  if (wait_ns > 1e17) return change;
  return std::min(change, stamp_ns_ + std::max<HostStamp>(0, std::llround(wait_ns)));
}

drivers::EdgeBatch FakeEncoderLines::take(const DiskMotion& motion, HostStamp now_ns) {
  drivers::EdgeBatch batch;
  for (;;) {
    const HostStamp due = next_due_ns(motion);
    if (due > now_ns) break;
    const bool is_change = motion.next_change(stamp_ns_) == due;
    const double speed = motion.speed_at(stamp_ns_);
    stamp_ns_ = due;
    if (is_change) continue;
    const int direction = speed > 0 ? 1 : -1;
    cross(next_boundary(direction), direction, batch);
  }
  std::ranges::stable_sort(batch.edges, {}, &drivers::Edge::stamp_ns);
  batch.complete_ns = now_ns;
  levels_.asked_ns = levels_.stamp_ns = now_ns;
  return batch;
}

drivers::LineLevels FakeEncoderLines::levels() const {
  drivers::LineLevels levels = levels_;
  if (faults_.is_swapped) std::swap(levels.a, levels.b);
  return levels;
}

void FakeEncoderLines::cross(std::int64_t boundary, int direction, drivers::EdgeBatch& batch) {
  tick_ = direction > 0 ? boundary : boundary - 1;
  const std::int64_t in_turn = floor_mod(boundary - kTicksPerCount * faults_.index_shift, ticks_per_turn_);
  if (in_turn == kIndexBegin) return change(EncoderLine::Index, direction > 0, batch);
  if (in_turn == index_end()) return change(EncoderLine::Index, direction < 0, batch);
  const std::int64_t count = boundary / kTicksPerCount - (direction > 0 ? 0 : 1);
  change(EncoderLine::A, level_a(count), batch);
  change(EncoderLine::B, level_b(count), batch);
}

void FakeEncoderLines::change(EncoderLine line, bool level, drivers::EdgeBatch& batch) {
  const bool is_dead = line == EncoderLine::A   ? faults_.is_a_dead
                       : line == EncoderLine::B ? faults_.is_b_dead
                                                : faults_.is_index_dead;
  bool& old_level = line == EncoderLine::A ? levels_.a : line == EncoderLine::B ? levels_.b : levels_.index;
  if (is_dead || old_level == level) return;
  old_level = level;
  const HostStamp stamp = stamp_ns_ + std::llround(1e9 * faults_.jitter_s * random_.uniform());
  send({stamp, line, level}, batch);
  if (random_.uniform() < faults_.bounce_probability) {
    send({stamp + kBounce_ns, line, !level}, batch);
    send({stamp + 2 * kBounce_ns, line, level}, batch);
  }
  if (line != EncoderLine::A || faults_.spurious_indices <= 0) return;
  --faults_.spurious_indices;
  send({stamp + kBounce_ns, EncoderLine::Index, true}, batch);
  send({stamp + 2 * kBounce_ns, EncoderLine::Index, false}, batch);
}

void FakeEncoderLines::send(const drivers::Edge& edge, drivers::EdgeBatch& batch) {
  if (faults_.dropped_edges > 0) {
    --faults_.dropped_edges;
    return;
  }
  if (faults_.lost_edges > 0) {
    --faults_.lost_edges;
    ++batch.lost_edges;
    return;
  }
  drivers::Edge sent = edge;
  if (faults_.is_swapped && edge.line != EncoderLine::Index)
    sent.line = edge.line == EncoderLine::A ? EncoderLine::B : EncoderLine::A;
  batch.edges.push_back(sent);
}

}  // namespace stairway::sim
