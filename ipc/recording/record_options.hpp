// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace stairway::ipc {

enum class RecordMode {
  Off,
  Continuous,  ///< everything, in files that begin anew by size and time
  Snapshot,    ///< the last sweeps, kept in memory and written on request
};

/// What is recorded and how much of the disk it may take.
struct RecordOptions {
  RecordMode mode = RecordMode::Off;
  std::string folder = "/var/lib/stairwayd/recordings";  ///< made if it does not exist
  bool raw = false;              ///< STAIRWAY_RAW too, the bytes to and from the scanner
  int max_file_mb = 500;         ///< a larger file is continued in a new one [MB], 1..100000
  double max_file_s = 3600.0;    ///< an older one likewise [s], 1..100000
  int max_total_mb = 4000;       ///< the oldest recordings go, to keep all together below this [MB], 1..1000000
  int min_free_mb = 200;         ///< recording pauses while the disk has less than this [MB], 0..1000000
  int snapshot_sweeps = 3;       ///< sweeps in a snapshot, 1..1000
  int snapshot_memory_mb = 256;  ///< memory they may take; the oldest messages go [MB], 1..100000

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

}  // namespace stairway::ipc
