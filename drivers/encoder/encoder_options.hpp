// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace stairway::drivers {

enum class LineBias { None, PullUp, PullDown };

/// By which way the kernel's GPIO lines are read.
enum class GpioAccess {
  Auto,      ///< the kernel's interface where it has version 2, else libgpiod
  Libgpiod,  ///< the library that this program was built with
  Kernel,    ///< version 2 of the kernel's own interface (Linux 5.10): longer queue, lost edges are told
};

/// The disk's quadrature encoder, its lines, and how its angles are made.
struct EncoderOptions {
  std::string chip = "gpiochip0";   ///< name, label or path of the GPIO chip
  std::string line_a = "0";         ///< offset on the chip, or name of the line
  std::string line_b = "1";         ///< likewise
  std::string line_index = "2";     ///< likewise; empty: none, the position at the start counts as angle 0
  int counts_per_turn = 4096;       ///< edges of A and B together in one turn of the disk, 4..1000000, by fours
  bool reverse = false;             ///< false: B leads A while the disk turns counter-clockwise, seen from above
  LineBias bias = LineBias::None;   ///< of all lines
  int index_tolerance = 2;          ///< counts by which the index may come aside, 0..1000
  double harmonic_rad = 0.0;        ///< amplitude of the angle's error of an eccentric disk [rad], 0..0.1
  double harmonic_phase_rad = 0.0;  ///< the error is harmonic * sin(angle + phase) [rad], in [-pi, pi]
  GpioAccess access = GpioAccess::Auto;
  int event_buffer = 1024;      ///< edges that the kernel keeps (version 2 only), 16..1024
  int debounce_us = 0;          ///< shorter pulses are dropped (version 2 only) [us], 0..100000
  double min_backoff_s = 0.5;   ///< pause before the lines are asked for again, doubled by failures [s], 0.01..60
  double max_backoff_s = 10.0;  ///< its bound [s], min_backoff..600

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

/// What is wrong with a disk that turns at `speed_rad_s` while the kernel keeps only `queued_edges` of each line: the
/// reader would have to come back within less than 10 ms, which nobody promises. Empty when that is enough time.
std::string edge_rate_problem(const EncoderOptions& options, double speed_rad_s, int queued_edges);

}  // namespace stairway::drivers
