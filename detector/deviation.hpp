// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "detector/stair_model.hpp"
#include "detector/stair_part.hpp"

namespace stairway::detect {

/// Which edges of the parts can be taken for the true ones: it depends on where the sensor looks from.
enum class View {
  FromBelow,  ///< ascending: top edges of risers are seen (eqs 11, 16)
  FromAbove,  ///< descending: front edges of treads are seen (eqs 8, 17)
};

/// How far a measured part lies from where the model puts it; all values >= 0.
struct Deviation {
  double depth_m = 0.0;        ///< delta_d, along s
  double height_m = 0.0;       ///< delta_h, vertical
  double direction_rad = 0.0;  ///< delta_s; 0 for treads, whose direction the paper found unreliable
};

/// Deviation of a part as the riser or tread of step `number` (eqs 5, 8, 11, 13, 16, 17, 19).
Deviation deviation(const StairModel& model, int number, const StairPart& part, View view);

/// Extent of a part along the horizontal unit direction `axis`, from the middles of its edges [m].
Interval part_extent(const StairPart& part, const Eigen::Vector3d& axis);

/// What a part spans along left() of a step, from its nosing on the model's middle line [m].
Interval sides_of(const StairPart& part, const StepFrame& step);

}  // namespace stairway::detect
