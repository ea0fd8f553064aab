// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "detector/step_view.hpp"

namespace stairway::detect {

/// The height of the tread's surface or underside within `range` of z [m]; nothing when too few points, too little of
/// the sides or too many points at other heights speak for it.
std::optional<Estimate> measure_level(const StepView& view, const Interval& range);

/// Whether the surface at z = `level_m` goes on before the nosing, where a tread has nothing but air.
bool goes_on_before(const StepView& view, double level_m);

/// v at which the surface or underside at z = `level_m` of a spiral's step ends towards the axis. Beyond it lines of
/// sight meet other steps of the spiral, so where the step's own points thin out has to do. @pre the model is a spiral.
std::optional<Estimate> inner_end(const StepView& view, double level_m);

}  // namespace stairway::detect
