// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::evaluation {

/// How much more memory the process holds at the most than when this object was made, as Linux counts resident pages.
/// Other threads count, too.
class PeakMemory {
 public:
  PeakMemory();

  /// [MB], or not a number where the system does not tell.
  double growth_MB() const;

 private:
  double before_MB_;
};

}  // namespace stairway::evaluation
