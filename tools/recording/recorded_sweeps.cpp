// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/recorded_sweeps.hpp"

#include <utility>
#include <variant>

namespace stairway::tools {

tl::expected<RecordedSweeps, ipc::LogError> RecordedSweeps::open(const std::filesystem::path& path,
                                                                 const RecordingFacts& facts,
                                                                 const config::Settings& settings) {
  auto measurements = RecordedMeasurements::open(path, facts);
  if (!measurements) return tl::unexpected(measurements.error());
  return RecordedSweeps(std::move(*measurements), settings);
}

RecordedSweeps::RecordedSweeps(RecordedMeasurements measurements, const config::Settings& settings)
    : measurements_(std::move(measurements)), assembler_(scan::make_calibration(settings.mount), settings.sweep) {}

std::optional<scan::Sweep> RecordedSweeps::next() {
  while (true) {
    if (auto sweep = assembler_.take_sweep()) {
      has_any_ = true;
      return sweep;
    }
    auto entry = measurements_.next();
    if (!entry) break;
    std::visit([this](auto& measurement) { assembler_.add(std::move(measurement)); }, entry->measurement);
  }
  if (std::exchange(has_any_, true)) return std::nullopt;
  assembler_.flush();
  return assembler_.take_sweep();
}

}  // namespace stairway::tools
