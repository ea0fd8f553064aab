// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/run_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace stairway::bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageCost, name, wall_ms, cpu_ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunReport, points, thinned, regions, step_parts, seen, found, height_error_mm,
                                   growth_MB, stages)

const StageCost& RunReport::stage(std::string_view name) const {
  static const StageCost kNone;
  const auto found_stage =
      std::find_if(stages.begin(), stages.end(), [&](const StageCost& s) { return s.name == name; });
  return found_stage == stages.end() ? kNone : *found_stage;
}

StageCost RunReport::sum() const {
  StageCost sum{.name = "total"};
  for (const StageCost& stage : stages) {
    sum.wall_ms += stage.wall_ms;
    sum.cpu_ms += stage.cpu_ms;
  }
  return sum;
}

std::string to_json(const RunReport& report) { return nlohmann::json(report).dump(); }

RunReport report_from_json(const std::string& line) { return nlohmann::json::parse(line).get<RunReport>(); }

}  // namespace stairway::bench
