// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "drivers/encoder/encoder_session.hpp"
#include "tests/fuzz/targets.hpp"

namespace stairway::fuzz {
namespace {

using namespace drivers;

constexpr HostStamp kMs = 1'000'000;
constexpr HostStamp kEdge_ns = 2 * kMs;
constexpr HostStamp kPauses_ns[] = {0, 1, kMs, 50 * kMs, 1000 * kMs, 10'000 * kMs, 3'600'000 * kMs};
// The kernel stamps nothing in the future.
constexpr HostStamp kAges_ns[] = {0, 1, kMs, 20 * kMs, 500 * kMs};
constexpr int kCountsPerTurn = 40;
constexpr int kTurnsToRecover = 5;
constexpr int kQueuedEdges = 16;
constexpr std::size_t kMaxDetail = 256;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

enum Action : std::uint8_t {
  AnyEdge,
  Forward,
  Backward,
  Unseen,
  Told,
  Levels,
  TrueLevels,
  Pause,
  Reopen,
  Bounce,
  kActions
};

EncoderOptions options_of(std::uint8_t choice) {
  EncoderOptions options;
  options.counts_per_turn = kCountsPerTurn;
  if ((choice & 1) != 0) options.line_index.clear();
  options.reverse = (choice & 2) != 0;
  options.index_tolerance = (choice & 4) != 0 ? 0 : 2;
  options.harmonic_rad = (choice & 8) != 0 ? 0.01 : 0.0;
  require(options.problem().empty(), "the options of the test are usable");
  return options;
}

/// An encoder without faults. Its index is high for a moment after each whole turn.
class IdealEncoder {
 public:
  explicit IdealEncoder(bool is_reversed) : is_reversed_(is_reversed) {}

  /// The edges of one count further, the index among them.
  std::vector<Edge> step(int direction, HostStamp at_ns) {
    const LineLevels before = levels();
    const std::int64_t boundary = direction > 0 ? count_ + 1 : count_;
    count_ += direction;
    const LineLevels after = levels();
    std::vector<Edge> edges;
    const bool has_index = boundary % kCountsPerTurn == 0;
    const auto add_index = [&](HostStamp rise_ns) {
      edges.push_back({rise_ns, EncoderLine::Index, true});
      edges.push_back({rise_ns + 1, EncoderLine::Index, false});
    };
    if (has_index && direction < 0) add_index(at_ns - 2);
    if (before.a != after.a) edges.push_back({at_ns, EncoderLine::A, after.a});
    if (before.b != after.b) edges.push_back({at_ns, EncoderLine::B, after.b});
    if (has_index && direction > 0) add_index(at_ns + 1);
    return edges;
  }

  /// B leads A forwards; reversed, A leads B.
  LineLevels levels() const {
    const auto phase = static_cast<int>(((count_ % 4) + 4) % 4);
    LineLevels levels{.a = phase >= 2, .b = phase == 1 || phase == 2};
    if (is_reversed_) std::swap(levels.a, levels.b);
    return levels;
  }
  std::int64_t count() const { return count_; }

 private:
  bool is_reversed_;
  std::int64_t count_ = kCountsPerTurn / 3;
};

/// A session on an encoder in order, of which the fuzzer decides what is seen.
class Bench {
 public:
  explicit Bench(const EncoderOptions& options) : encoder_(options.reverse), session_(options) { open(); }

  void open() {
    LineLevels levels = encoder_.levels();
    levels.asked_ns = levels.stamp_ns = now_ns_;
    take(session_.on_open(levels, kQueuedEdges), 0);
  }
  void disconnect() { take(session_.on_disconnect(now_ns_, "removed"), 0); }

  void turn(int counts, int direction, bool is_seen, std::uint64_t told_edges) {
    std::uint64_t lost_edges = told_edges;
    for (; counts > 0; --counts) {
      now_ns_ += kEdge_ns;
      const std::vector<Edge> edges = encoder_.step(direction, now_ns_ - kEdge_ns / 2);
      if (is_seen) see({edges, std::exchange(lost_edges, 0), now_ns_});
    }
    if (lost_edges > 0) see({{}, lost_edges, now_ns_});
  }
  void see(const EdgeBatch& batch) {
    take(session_.on_edges(batch), batch.edges.size());
    require(std::isfinite(session_.speed_rad_s(now_ns_).value_or(0.0)), "a speed is a number");
    if (session_.wants_levels()) tell_levels(encoder_.levels());
  }
  void tell_levels(LineLevels levels) {
    levels.asked_ns = levels.stamp_ns = now_ns_;
    take(session_.on_levels(levels), 0);
    require(!session_.wants_levels(), "levels settle what was doubtful");
  }
  void wait(HostStamp pause_ns) {
    now_ns_ += pause_ns;
    see({{}, 0, now_ns_});
  }

  /// However it was left: after some turns of an encoder in order, angles are those of the disk.
  void recover() {
    wait(kEdge_ns);
    if (session_.state() == EncoderState::Absent) open();
    turn(kTurnsToRecover * kCountsPerTurn, 1, true, 0);
    require(session_.state() == EncoderState::Indexed, "after garbage, an encoder in order has valid angles");
    const double angle_rad = last_angle_rad_.value();
    if (!session_.options().line_index.empty()) {
      const double truth_rad = kTurn_rad * static_cast<double>(encoder_.count()) / kCountsPerTurn;
      const double error_rad = std::remainder(angle_rad - truth_rad, kTurn_rad);
      require(std::abs(error_rad) < 0.02, "and they are those of the disk");
    }
    turn(kCountsPerTurn, 1, true, 0);
    require(std::abs(last_angle_rad_.value() - angle_rad - kTurn_rad) < 1e-6, "and a turn is a turn");
  }

  HostStamp now_ns() const { return now_ns_; }

 private:
  void take(const std::vector<EncoderEvent>& events, std::size_t edges) {
    for (const EncoderEvent& event : events) {
      if (const auto* trouble = std::get_if<EncoderTroubleEvent>(&event))
        require(!trouble->detail.empty() && trouble->detail.size() <= kMaxDetail, "a trouble is told in one line");
      const auto* samples = std::get_if<std::vector<AngleSample>>(&event);
      if (samples == nullptr) continue;
      require(samples->size() <= edges + 1, "there is a sample for an edge, and one for a rest");
      for (const AngleSample& sample : *samples) check(sample);
    }
  }
  void check(const AngleSample& sample) {
    require(sample.stamp_ns >= last_stamp_ns_, "samples come in the order of their stamps");
    require(std::isfinite(sample.angle_rad), "an angle is a number");
    last_stamp_ns_ = sample.stamp_ns;
    last_angle_rad_ = sample.angle_rad;
  }

  IdealEncoder encoder_;
  EncoderSession session_;
  HostStamp now_ns_ = 5'000 * kMs;
  HostStamp last_stamp_ns_ = 0;
  std::optional<double> last_angle_rad_;
};

Edge any_edge(HostStamp now_ns, FuzzInput& input) {
  const std::uint8_t choice = input.byte();
  return {now_ns - kAges_ns[input.byte() % std::size(kAges_ns)], static_cast<EncoderLine>(choice % 3),
          (choice & 0x80) != 0};
}

void bounce(Bench& bench, FuzzInput& input) {
  EdgeBatch batch{.edges = {}, .lost_edges = 0, .complete_ns = bench.now_ns()};
  for (int edges = input.byte() % 32; edges > 0; --edges) batch.edges.push_back(any_edge(bench.now_ns(), input));
  bench.see(batch);
}

void step(Bench& bench, FuzzInput& input) {
  switch (input.byte() % kActions) {
    case AnyEdge:
      return bench.see({{any_edge(bench.now_ns(), input)}, 0, bench.now_ns()});
    case Forward:
      return bench.turn(input.byte() % 64, 1, true, 0);
    case Backward:
      return bench.turn(input.byte() % 64, -1, true, 0);
    case Unseen:
      return bench.turn(input.byte() % 8, (input.byte() & 1) != 0 ? 1 : -1, false, 0);
    case Told:
      return bench.turn(1 + input.byte() % 8, (input.byte() & 1) != 0 ? 1 : -1, false, 1 + input.byte());
    case Levels: {
      const std::uint8_t levels = input.byte();
      return bench.tell_levels({0, 0, (levels & 1) != 0, (levels & 2) != 0, (levels & 4) != 0});
    }
    case TrueLevels:
      return bench.wait(0);
    case Pause:
      return bench.wait(kPauses_ns[input.byte() % std::size(kPauses_ns)]);
    case Reopen:
      bench.disconnect();
      if ((input.byte() & 1) != 0) bench.open();
      return;
    default:
      return bounce(bench, input);
  }
}

}  // namespace

void run_quadrature(std::span<const std::uint8_t> bytes) {
  FuzzInput input(bytes);
  Bench bench(options_of(input.byte()));
  while (!input.is_empty()) step(bench, input);
  bench.recover();
}

std::vector<Seed> quadrature_seeds() {
  std::vector<Seed> seeds;
  // With index, without, reversed, strict: two turns and a half forth and back, with every kind of loss between.
  for (std::uint8_t choice = 0; choice < 16; ++choice) {
    seeds.push_back({choice, Forward, 63, Forward, 50, Backward, 60, Pause, 3, Forward, 20});
    seeds.push_back({choice, Forward, 63, Unseen, 1, 1, Forward, 63, Unseen, 2, 0, Forward, 63, Forward, 40});
    seeds.push_back({choice, Forward, 63, Told, 3, 1, 2, Forward, 63, Forward, 63, Levels, 3, Forward, 10});
    seeds.push_back(
        {choice, Forward, 50, AnyEdge, 0x80, 0, AnyEdge, 0x01, 2, AnyEdge, 0x82, 1, Reopen, 1, Forward, 50});
    seeds.push_back({choice, Backward, 63, Bounce, 4, 0x80, 0, 0x00, 0, 0x80, 1, 0x01, 1, Reopen, 0, Pause, 4});
  }
  return seeds;
}

}  // namespace stairway::fuzz
