// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace stairway::detect {

/// Called when a stage of the detector begins; whoever has a clock can time the stages with it.
using StageListener = std::function<void(std::string_view stage)>;

/// Tells the listener, if there is one.
inline void begin_stage(const StageListener& on_stage, std::string_view stage) {
  if (on_stage) on_stage(stage);
}

}  // namespace stairway::detect
