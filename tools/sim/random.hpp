// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace stairway::sim {

/// Random numbers that are the same on every machine, unlike the standard distributions.
///
/// The generator is SplitMix64 (Steele, Lea, Flood, OOPSLA 2014). Streams of one seed are independent of each other, so
/// work can be split over threads by giving every piece its own stream.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_{mix(mix(seed) + kGolden * (2 * stream + 1))} {}

  std::uint64_t next() { return mix(state_ += kGolden); }

  /// In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// One of low..high, both included.
  int integer(int low, int high) { return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1)); }
  bool chance(double probability) { return uniform() < probability; }
  /// Mean 0, standard deviation 1.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
  static std::uint64_t mix(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9;
    value = (value ^ (value >> 27)) * 0x94d049bb133111eb;
    return value ^ (value >> 31);
  }
  std::uint64_t state_;
};

}  // namespace stairway::sim
