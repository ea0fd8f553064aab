// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "detector/step_view.hpp"

namespace stairway::detect {

/// A front and its direction, as in StepMeasurement.
struct FrontMeasurement {
  Estimate place;
  std::optional<Estimate> turn;
  bool has_riser = true;
  bool is_bar = false;  ///< both as in StepMeasurement
};

/// The riser of a step, or the front face of an open tread; nothing when too few points, too little of the sides or too
/// many points behind speak for it.
std::optional<FrontMeasurement> measure_front(const StepView& view);

/// u of the lip along the nosing, or of the front where it has none; nothing where the spot is wider than lips are.
std::optional<Estimate> measure_lip(const StepView& view);

}  // namespace stairway::detect
