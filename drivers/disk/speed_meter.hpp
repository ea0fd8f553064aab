// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// Mean speed of an angle that is told at instants and may start again at another one in between.
class SpeedMeter {
 public:
  /// The next angle [rad]; `is_continued` false when it does not go on from the one before. Stamps must grow; others
  /// are left out.
  void add(HostStamp stamp_ns, double angle_rad, bool is_continued = true) {
    if (last_ && stamp_ns <= last_->stamp_ns) return;
    if (last_ && is_continued) {
      turned_rad_ += angle_rad - last_->angle_rad;
      passed_s_ += 1e-9 * static_cast<double>(stamp_ns - last_->stamp_ns);
    }
    last_ = Place{stamp_ns, angle_rad};
  }

  /// Forgets what was measured, but not where the angle is.
  void restart() {
    turned_rad_ = 0.0;
    passed_s_ = 0.0;
  }

  /// Since the last restart [rad/s]; empty when nothing was told.
  std::optional<double> mean_rad_s() const {
    return passed_s_ > 0.0 ? std::optional(turned_rad_ / passed_s_) : std::nullopt;
  }

 private:
  struct Place {
    HostStamp stamp_ns;
    double angle_rad;
  };
  std::optional<Place> last_;
  double turned_rad_ = 0.0;
  double passed_s_ = 0.0;
};

}  // namespace stairway::drivers
