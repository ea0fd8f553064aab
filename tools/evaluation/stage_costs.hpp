// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "detector/stairway_detector.hpp"

namespace stairway::evaluation {

/// Processor time of the calling thread that every stage of a detection takes [s]. Other processes, and other threads
/// but for the caches they share, do not count.
class StageCosts {
 public:
  /// To be handed to detect_stairways(); this object must outlive the call.
  detect::StageListener listener();
  /// Ends the last stage; from then on the figures are complete.
  void stop();

  double seconds(std::string_view stage) const;  ///< 0 for a stage that did not run
  double total_s() const;

 private:
  void begin(std::string_view stage);

  std::map<std::string, double, std::less<>> seconds_;
  std::string stage_;
  double begun_s_ = 0.0;
};

}  // namespace stairway::evaluation
