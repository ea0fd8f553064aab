// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "detector/stage_listener.hpp"

namespace stairway::bench {

/// What a stage took of the world and of the processor.
struct StageCost {
  std::string name;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of all threads of the process
};

/// Measures stages that follow each other.
class StageWatch {
 public:
  void begin(std::string_view stage);
  void stop();

  /// To be handed to detect_stairways(); this object must outlive the call.
  detect::StageListener listener() {
    return [this](std::string_view stage) { begin(stage); };
  }

  const std::vector<StageCost>& costs() const { return costs_; }  ///< complete after stop()

 private:
  std::vector<StageCost> costs_;
  bool is_running_ = false;
  double wall_ms_ = 0.0;
  double cpu_ms_ = 0.0;
};

}  // namespace stairway::bench
