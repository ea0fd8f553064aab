// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/scan_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "scan_assembly/frames.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::bench {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr std::uint64_t kSeed = 1;

}  // namespace

ScanTable::ScanTable(std::vector<std::uint16_t> values)
    : values_(std::move(values)), rows_(values_.size() / sim::kBeams) {}

ScanTable ScanTable::measure(const sim::Scene& scene, std::size_t rows) {
  const scan::MountOptions mount = scene.mount.value_or(scan::MountOptions{});
  const sim::ScannerModel model(scene.mesh, scan::make_calibration(mount), sim::ScannerOptions{}, kSeed);
  std::vector<std::uint16_t> values;
  values.reserve(rows * sim::kBeams);
  std::vector<std::uint32_t> turn(sim::kBeams);
  for (std::size_t row = 0; row < rows; ++row) {
    const double angle_rad = kTurn_rad * static_cast<double>(row) / static_cast<double>(rows);
    model.measure_turn(row, angle_rad, angle_rad, turn);
    for (const std::uint32_t value : turn) {
      values.push_back(
          static_cast<std::uint16_t>(std::min<std::uint32_t>(value, std::numeric_limits<std::uint16_t>::max())));
    }
  }
  return ScanTable(std::move(values));
}

ScanTable ScanTable::read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const auto bytes = in ? static_cast<std::size_t>(in.tellg()) : 0;
  if (bytes == 0 || bytes % (sim::kBeams * sizeof(std::uint16_t)) != 0)
    throw std::runtime_error(file.string() + " is no scan table; make one with make_scan_table");
  std::vector<std::uint16_t> values(bytes / sizeof(std::uint16_t));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes)))
    throw std::runtime_error("cannot read " + file.string());
  return ScanTable(std::move(values));
}

void ScanTable::write(const std::filesystem::path& file) const {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values_.data()),
            static_cast<std::streamsize>(values_.size() * sizeof(std::uint16_t)));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void ScanTable::look_up(double first_beam_angle_rad, double last_beam_angle_rad,
                        std::span<std::uint32_t> values) const {
  const double rows = static_cast<double>(rows_);
  const double first_turns = first_beam_angle_rad / kTurn_rad;
  const double first_row = rows * (first_turns - std::floor(first_turns));
  const double rows_per_beam =
      rows * (last_beam_angle_rad - first_beam_angle_rad) / kTurn_rad / static_cast<double>(sim::kBeams - 1);
  const auto count = static_cast<std::int64_t>(rows_);
  for (std::size_t beam = 0; beam < values.size(); ++beam) {
    const auto row = std::llround(first_row + rows_per_beam * static_cast<double>(beam)) % count;
    const auto wrapped = static_cast<std::size_t>(row < 0 ? row + count : row);
    values[beam] = values_[wrapped * sim::kBeams + beam];
  }
}

}  // namespace stairway::bench
