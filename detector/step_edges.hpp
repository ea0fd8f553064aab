// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "detector/step_view.hpp"

namespace stairway::detect {

/// The line of sight that leaves a front at its top, where half the spot does. Without a sensor the highest points of
/// the front have to do.
/// @param front_u  where the front was measured [m].
std::optional<NosingSight> nosing_over_front(const StepView& view, double front_u);

/// A nosing seen from behind, and its direction.
struct EdgeMeasurement {
  NosingSight nosing;
  std::optional<Estimate> turn;
};

/// The line of sight that leaves a tread at its nosing and ends on what lies below. @pre view.stands_behind_nosing()
std::optional<EdgeMeasurement> nosing_over_tread(const StepView& view);

/// An end of a face.
struct EndMeasurement {
  Estimate place;               ///< v at which lines of sight leave the face
  std::optional<double> limit;  ///< v of the first line of sight that passes freely beyond it: the end lies before
};

/// The end of a front, or of a tread seen from behind, near `end_v`; what stands in the way of the face (a post, a
/// bystander) says nothing about its end.
std::optional<EndMeasurement> end_of_front(const StepView& view, double end_v);
std::optional<EndMeasurement> end_of_tread(const StepView& view, double end_v);

}  // namespace stairway::detect
