// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/paper_stairways.hpp"

namespace stairway::evaluation {

std::array<PaperStairway, 3> paper_stairways() {
  sim::StairSpec open{.steps = 10, .height_m = 0.175, .depth_m = 0.28, .width_m = 1.2, .open_risers = true};
  sim::StairSpec overhanging{.steps = 10, .height_m = 0.165, .depth_m = 0.30, .width_m = 1.5};
  overhanging.overhang_m = 0.03;
  const sim::StairSpec closed{.steps = 10, .height_m = 0.16, .depth_m = 0.31, .width_m = 1.4};
  return {{{"I", open}, {"II", overhanging}, {"III", closed}}};
}

}  // namespace stairway::evaluation
