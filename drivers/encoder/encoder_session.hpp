// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/encoder/encoder_events.hpp"
#include "drivers/encoder/encoder_options.hpp"
#include "drivers/encoder/quadrature_decoder.hpp"
#include "drivers/ports/edge_port.hpp"

namespace stairway::drivers {

/// Turns the edges of A, B and the index into angles. Edges and times in, events out; it has no port, thread or clock.
///
/// Every edge of A and B gives a sample at its own instant. It lies on the boundary between two counts, so both
/// directions tell the same angle for the same place. Angles are valid from the first index on. The index is taken at
/// the same of its two edges in both directions (rising forwards, falling backwards), and only where the disk passed
/// it: counts in the same direction come before and after. Where a revolution has not the right number of counts, the
/// count is set right; by more than `index_tolerance` counts it is a fault, and angles are invalid until two indices
/// agree. After an edge that is known to be lost (told by the kernel, both lines changed, one line rose twice) they are
/// invalid until the next index. Without an index line they are always valid, and what is lost stays lost; it is
/// counted. While nothing moves the last angle is repeated every 50 ms.
///
/// O(edges); it keeps nothing of them.
class EncoderSession {
 public:
  /// @pre  options.problem() is empty.
  explicit EncoderSession(const EncoderOptions& options);

  /// The lines are open; edges from before the levels were asked for are in them already. One that came while they were
  /// read is counted if it leads to another level than the one that was read.
  /// @param queued_edges  how many edges of each line the kernel keeps until they are read.
  std::vector<EncoderEvent> on_open(const LineLevels& levels, int queued_edges);
  /// Edges by stamp. Edges that go back in time are dropped.
  std::vector<EncoderEvent> on_edges(const EdgeBatch& batch);
  /// The levels as they are after edges were lost; wants_levels() said so.
  std::vector<EncoderEvent> on_levels(const LineLevels& levels);
  /// The port failed or could not be opened: wait until `deadline`, then open it.
  std::vector<EncoderEvent> on_disconnect(HostStamp now_ns, std::string_view detail);
  /// Cuts that pause short.
  void retry_now(HostStamp now_ns);

  /// Whether the lines should be read, because what is known of them is doubtful.
  bool wants_levels() const { return is_doubtful_; }
  /// While the port is closed: when to open it [ns].
  HostStamp deadline() const { return deadline_ns_; }

  EncoderState state() const { return state_; }
  const EncoderCounters& counters() const { return counters_; }
  const EncoderOptions& options() const { return options_; }
  /// Over the last eight counts [rad/s, counter-clockwise]; 0 when the last one is older than 0.2 s and than three
  /// times their usual interval, empty before there were two.
  std::optional<double> speed_rad_s(HostStamp now_ns) const;

 private:
  struct Timed {
    HostStamp stamp_ns = 0;
    double angle_rad = 0.0;
  };

  struct IndexChange {
    bool was_high = false;
    bool is_high = false;
  };

  void take(const Edge& edge);
  bool is_in_levels(const Edge& edge) const;
  void take_step(QuadratureStep step, HostStamp stamp_ns);
  void take_index(const IndexChange& change);
  void watch_for_index();
  void watch_for_other_line();
  void watch_rate(HostStamp stamp_ns);
  void lose_track();
  void repeat_angle(HostStamp stamp_ns);
  void emit(HostStamp stamp_ns, double angle_rad);
  void enter(EncoderState state);
  void report(EncoderTrouble trouble, std::string detail);
  QuadratureStep set_levels(bool a, bool b);
  bool level_of(EncoderLine line) const;
  bool has_index_line() const { return !options_.line_index.empty(); }
  double angle_of(double boundary) const;
  std::vector<EncoderEvent> take_events();

  EncoderOptions options_;
  EncoderState state_ = EncoderState::Absent;
  QuadratureDecoder decoder_;
  std::int64_t count_ = 0;
  int direction_ = 0;                        // of the last step, 0 when it is not known
  int alone_ = 0;                            // edges of one line since the last one of the other
  std::optional<IndexChange> index_change_;  // since the last step
  std::optional<std::int64_t> index_at_;     // count at the last index, while no edge has been lost since
  bool is_zeroed_ = false;                   // an index has been seen since the start
  std::int64_t watched_from_ = 0;            // an index is due within one and a half revolutions from this count
  bool is_doubtful_ = false;

  HostStamp asked_ns_ = std::numeric_limits<HostStamp>::min();
  HostStamp levels_ns_ = std::numeric_limits<HostStamp>::min();
  HostStamp last_edge_ns_ = std::numeric_limits<HostStamp>::min();
  HostStamp last_step_ns_ = 0;
  HostStamp interval_ns_ = 0;  // between the last two steps
  EncoderLine last_line_ = EncoderLine::Index;
  std::optional<AngleSample> last_sample_;
  std::vector<Timed> recent_;  // the newest last
  int queued_edges_ = 0;
  std::optional<HostStamp> rate_reported_ns_;

  int failures_ = 0;
  HostStamp deadline_ns_ = std::numeric_limits<HostStamp>::min();
  EncoderCounters counters_;
  std::vector<AngleSample> samples_;
  std::vector<EncoderEvent> events_;
};

}  // namespace stairway::drivers
