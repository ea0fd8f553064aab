// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace stairway::sim {

struct ShippedScene {
  std::string_view name;  ///< of the file, without ending
  std::string_view text;  ///< TOML
};

/// The files in tools/sim/scenes, sorted by name; compiled in, so that a simulation needs no installed files.
std::span<const ShippedScene> shipped_scenes();

}  // namespace stairway::sim
