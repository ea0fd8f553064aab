// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "tools/sim/stair_spec.hpp"

namespace stairway::evaluation {

struct PaperStairway {
  std::string_view name;  ///< as in the paper's Fig 1
  sim::StairSpec flight;
};

/// Stand-ins for the paper's three straight stairways, of which it gives no measures: I has almost no risers, here
/// boards on stringers; II has risers and, here, overhanging treads; III has plain closed risers. Heights and depths
/// are those of public buildings. Without railings, which the paper's models lack too.
std::array<PaperStairway, 3> paper_stairways();

}  // namespace stairway::evaluation
