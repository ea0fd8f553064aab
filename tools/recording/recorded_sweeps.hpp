// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "config/settings.hpp"
#include "scan_assembly/sweep_assembler.hpp"
#include "tools/recording/recorded_measurements.hpp"

namespace stairway::tools {

/// The sweeps of a recording, assembled as the daemon assembled them: sweep k here is sweep k there if the recording
/// began with the daemon.
class RecordedSweeps {
 public:
  /// @param settings  its mount and sweep are used.
  static tl::expected<RecordedSweeps, ipc::LogError> open(const std::filesystem::path& path,
                                                          const RecordingFacts& facts,
                                                          const config::Settings& settings);

  /// The next sweep. The last one is left out, as it has no end, unless it is the only one. Empty at the end.
  std::optional<scan::Sweep> next();

  const RecordedMeasurements& measurements() const { return measurements_; }

 private:
  RecordedSweeps(RecordedMeasurements measurements, const config::Settings& settings);

  RecordedMeasurements measurements_;
  scan::SweepAssembler assembler_;
  bool has_any_ = false;
};

}  // namespace stairway::tools
