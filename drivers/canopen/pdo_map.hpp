// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/canopen/object.hpp"

namespace stairway::drivers {

/// An object inside a process data frame.
struct MappedObject {
  ObjectAddress object;
  std::uint8_t bits = 32;

  bool operator==(const MappedObject&) const = default;
};

/// What a drive is to send or take as process data.
struct PdoMap {
  std::uint16_t communication = 0x1400;  ///< index of its communication parameters; its mapping is 0x200 above
  std::uint32_t identifier = 0x200;      ///< with bit 30 where remote requests are not answered
  std::uint8_t transmission_type = 255;  ///< 1..240: at every n-th SYNC; 255: on its own
  std::vector<MappedObject> objects;     ///< at most 64 bits together
};

struct ObjectWrite {
  ObjectAddress object;
  ObjectValue value;

  bool operator==(const ObjectWrite&) const = default;
};

/// The writes that set `map` in, in the order that CiA 301 asks for: off, type, no entries, entries, their number, on.
std::vector<ObjectWrite> mapping_writes(const PdoMap& map);

}  // namespace stairway::drivers
