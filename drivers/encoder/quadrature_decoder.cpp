// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/encoder/quadrature_decoder.hpp"

#include <array>

namespace stairway::drivers {

QuadratureStep QuadratureDecoder::take(bool a, bool b) {
  using enum QuadratureStep;
  // Rows: the levels before, as A B = 00, 01, 10, 11; columns: the levels now.
  static constexpr std::array<QuadratureStep, 16> kSteps{None,     Forward,  Backward, Illegal,   //
                                                         Backward, None,     Illegal,  Forward,   //
                                                         Forward,  Illegal,  None,     Backward,  //
                                                         Illegal,  Backward, Forward,  None};
  const std::uint8_t now = pack(a, b);
  const QuadratureStep step = kSteps[static_cast<std::size_t>(state_ * 4 + now)];
  state_ = now;
  return step;
}

}  // namespace stairway::drivers
