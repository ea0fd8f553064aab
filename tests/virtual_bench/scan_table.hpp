// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tools/sim/scene.hpp"

namespace stairway::bench {

/// What the scanner sees of a scene, by disk angle and beam: ranges in millimetres or SCIP error codes, noise included.
/// Casting rays is too slow in an emulated machine; looking them up is not. The file is the plain values, row by row,
/// in the machine's byte order.
class ScanTable {
 public:
  /// Casts the rays, for a disk that rests at each of `rows` angles. Cost: 1 s of one core for 700 rows.
  static ScanTable measure(const sim::Scene& scene, std::size_t rows);
  /// Throws std::runtime_error when the file is missing or no table.
  static ScanTable read(const std::filesystem::path& file);
  /// Throws std::runtime_error.
  void write(const std::filesystem::path& file) const;

  /// One mirror turn of a disk that turns evenly from the first to the last beam; kBeams values. Any angles will do.
  void look_up(double first_beam_angle_rad, double last_beam_angle_rad, std::span<std::uint32_t> values) const;

 private:
  explicit ScanTable(std::vector<std::uint16_t> values);

  std::vector<std::uint16_t> values_;
  std::size_t rows_;
};

}  // namespace stairway::bench
