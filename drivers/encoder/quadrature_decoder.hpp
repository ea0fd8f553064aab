// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace stairway::drivers {

/// What a change of the levels of A and B means.
enum class QuadratureStep : std::uint8_t {
  None,      ///< nothing changed
  Forward,   ///< one count on: B leads A
  Backward,  ///< one count back: A leads B
  Illegal,   ///< both changed, so at least one edge is missing, and nobody knows in which direction
};

/// Reads two levels a quarter of a period apart.
class QuadratureDecoder {
 public:
  explicit QuadratureDecoder(bool a = false, bool b = false) : state_(pack(a, b)) {}

  /// The next levels. They are taken over in any case.
  QuadratureStep take(bool a, bool b);
  bool a() const { return (state_ & 2) != 0; }
  bool b() const { return (state_ & 1) != 0; }

 private:
  static std::uint8_t pack(bool a, bool b) { return static_cast<std::uint8_t>((a ? 2 : 0) | (b ? 1 : 0)); }
  std::uint8_t state_;
};

}  // namespace stairway::drivers
