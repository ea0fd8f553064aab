// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "drivers/canopen/object.hpp"
#include "drivers/canopen/pdo_map.hpp"

namespace stairway::sim {

/// The object dictionary of the simulated drive: values, and who may write them. Process data maps are changed as CiA
/// 301 says: switched off, without entries, in that order, and never to more than 64 bits.
class FakeDriveObjects {
 public:
  FakeDriveObjects(std::uint8_t node, std::string name, std::uint32_t serial);

  /// Communication objects as after power-up.
  void reset_communication();
  void reset_all();

  /// What an SDO read gives, or an abort code.
  tl::expected<std::string, std::uint32_t> read(drivers::ObjectAddress object) const;
  /// What an SDO write does; an abort code when it is refused.
  tl::expected<void, std::uint32_t> write(drivers::ObjectAddress object, const std::string& bytes);

  /// 0 for objects that are not there.
  std::uint32_t get(drivers::ObjectAddress object) const;
  /// The drive's own writing, to any object that is there.
  void set(drivers::ObjectAddress object, std::uint32_t value);
  std::uint8_t size(drivers::ObjectAddress object) const;

  /// The map with this communication index as it stands; empty when it is switched off.
  std::optional<drivers::PdoMap> pdo(std::uint16_t communication) const;

 private:
  enum class Access : std::uint8_t { Read, Write, Mapped };  // Mapped: may be written, and put into a PDO
  struct Object {
    drivers::ObjectValue value;
    Access access = Access::Read;
  };

  void add(drivers::ObjectAddress object, drivers::ObjectValue value, Access access);
  std::uint32_t refusal(drivers::ObjectAddress object, std::uint32_t value) const;
  std::uint32_t mapping_refusal(drivers::ObjectAddress object, std::uint32_t value) const;

  std::uint8_t node_;
  std::string name_;
  std::uint32_t serial_;
  std::map<drivers::ObjectAddress, Object> objects_;
};

}  // namespace stairway::sim
