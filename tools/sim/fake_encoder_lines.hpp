// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "drivers/ports/edge_port.hpp"
#include "tools/sim/disk_motion.hpp"
#include "tools/sim/random.hpp"

namespace stairway::sim {

/// What is wrong with the simulated encoder and its lines; may be changed at any time.
struct FakeEncoderFaults {
  bool is_a_dead = false;
  bool is_b_dead = false;
  bool is_index_dead = false;
  bool is_swapped = false;          ///< A on the line of B and the other way round
  int index_shift = 0;              ///< counts by which the index comes too late, forwards
  int index_width = 0;              ///< counts by which the index stays high for longer
  int spurious_indices = 0;         ///< this many of the next edges of A are followed by a pulse of the index
  int dropped_edges = 0;            ///< this many of the next edges get lost and nobody tells
  int lost_edges = 0;               ///< likewise, but the kernel tells
  double bounce_probability = 0.0;  ///< of an edge to come three times, within 20 us
  double jitter_s = 0.0;            ///< of the edges' stamps, at most a quarter of the time between edges
};

/// The lines A, B and index of an encoder on a turning disk, with edges at their exact times. B leads A while the disk
/// turns counter-clockwise. The index is high for a quarter of a count, just after angle 0. It has no thread or clock.
class FakeEncoderLines {
 public:
  /// @param counts_per_turn  edges of A and B together, a multiple of 4.
  FakeEncoderLines(const DiskMotion& motion, drivers::HostStamp start_ns, int counts_per_turn, std::uint64_t seed = 1);

  /// When the next edge is due, or the disk's speed changes; the greatest stamp when neither will happen.
  drivers::HostStamp next_due_ns(const DiskMotion& motion) const;
  /// The edges after those already given, up to `now_ns`, by stamp.
  drivers::EdgeBatch take(const DiskMotion& motion, drivers::HostStamp now_ns);
  /// As of the last `take`.
  drivers::LineLevels levels() const;
  FakeEncoderFaults& faults() { return faults_; }

 private:
  std::int64_t index_end() const;
  std::int64_t next_boundary(int direction) const;
  void cross(std::int64_t boundary, int direction, drivers::EdgeBatch& batch);
  void change(drivers::EncoderLine line, bool level, drivers::EdgeBatch& batch);
  void send(const drivers::Edge& edge, drivers::EdgeBatch& batch);

  std::int64_t ticks_per_turn_;
  double radians_per_tick_;
  FakeEncoderFaults faults_;
  Random random_;
  drivers::HostStamp stamp_ns_;
  std::int64_t tick_;  // four a count
  drivers::LineLevels levels_;
};

}  // namespace stairway::sim
