// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/speed/stage_watch.hpp"

namespace stairway::bench {

/// One cloud taken through one program in a process of its own. What a program does not have is 0.
struct RunReport {
  double points = 0;      ///< of the cloud
  double thinned = 0;     ///< left by a voxel grid
  double regions = 0;     ///< planar segments
  double step_parts = 0;  ///< of them pass for a riser or a tread
  double seen = 0;        ///< flights in the cloud
  double found = 0;       ///< of these
  double height_error_mm = 0;
  double growth_MB = 0;  ///< what the process held beyond the cloud itself, at the most
  std::vector<StageCost> stages;

  const StageCost& stage(std::string_view name) const;  ///< zeros for one that did not run
  StageCost sum() const;                                ///< of all stages
};

/// One line.
std::string to_json(const RunReport& report);
/// Throws std::exception for what to_json() did not write.
RunReport report_from_json(const std::string& line);

}  // namespace stairway::bench
