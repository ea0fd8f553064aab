// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "detector/stair_model.hpp"
#include "detector/stair_part.hpp"

namespace stairway::detect {

/// The spirals that two parts of neighbouring steps suggest, both of the same kind.
///
/// delta phi is the angle between the directions of the two parts, and d their distance along the bisector of those.
/// Two risers give two spirals, with h from their top or from their bottom edges; two treads two, with d from their
/// front or from their back edges; two edges one.
/// @return spirals whose step 0 is the lower part's and whose turn is none of nothing; limits are the caller's to
/// check. Method: Westfechtel et al. 2018, section "Graph Initialization", spiral stairways; its "angle between n1 and
/// n2" along which d is measured is read as their bisector.
std::vector<StairModel> suggested_spirals(const StairPart& lower, const StairPart& upper);

}  // namespace stairway::detect
