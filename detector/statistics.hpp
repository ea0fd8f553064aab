// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace stairway::detect {

/// Median of at least one value; of an even number of them the upper of the two in the middle. Cost: O(n).
double median(std::vector<double> values);

/// Standard deviation of the normal distribution whose median absolute deviation about `center` is that of the values
/// (at least one). Half of the values may be wild.
double robust_deviation(std::vector<double> values, double center);

/// The value that a quarter of the values (at least one) lie below, or above when `from_above`: where things end that
/// are often seen cut short and hardly ever too long. Cost: O(n).
double outer_quartile(std::vector<double> values, bool from_above);

}  // namespace stairway::detect
