// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace stairway::bench {

/// The exponent of x that fits y = c x^e best, all points counting alike on logarithmic scales: 1 is in proportion.
/// @param x, y  above 0, of the same length; not a number for fewer than two different x.
double fitted_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace stairway::bench
