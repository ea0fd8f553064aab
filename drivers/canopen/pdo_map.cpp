// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/pdo_map.hpp"

namespace stairway::drivers {

std::vector<ObjectWrite> mapping_writes(const PdoMap& map) {
  constexpr std::uint32_t kOff = 1U << 31;
  const auto mapping = static_cast<std::uint16_t>(map.communication + 0x200);
  std::vector<ObjectWrite> writes{
      {{map.communication, 1}, {map.identifier | kOff, 4}},
      {{map.communication, 2}, {map.transmission_type, 1}},
      {{mapping, 0}, {0, 1}},
  };
  for (const MappedObject& entry : map.objects) {
    const auto sub = static_cast<std::uint8_t>(writes.size() - 2);
    const std::uint32_t value = static_cast<std::uint32_t>(entry.object.index) << 16 |
                                static_cast<std::uint32_t>(entry.object.sub) << 8 | entry.bits;
    writes.push_back({{mapping, sub}, {value, 4}});
  }
  writes.push_back({{mapping, 0}, {static_cast<std::uint32_t>(map.objects.size()), 1}});
  writes.push_back({{map.communication, 1}, {map.identifier, 4}});
  return writes;
}

}  // namespace stairway::drivers
