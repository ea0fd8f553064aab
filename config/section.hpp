// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <utility>

#include "config/settings_table.hpp"

namespace stairway::config {

inline constexpr Unit kPlain{"", 1.0};
inline constexpr Unit kMillimetre{"mm", 1e-3};
inline constexpr Unit kMetre{"m", 1.0};
inline constexpr Unit kDegree{"deg", std::numbers::pi / 180.0};
inline constexpr Unit kMilliradian{"mrad", 1e-3};
inline constexpr Unit kSecond{"s", 1.0};
inline constexpr Unit kMegabytePerSecond{"mb_s", 1.0};
inline constexpr Unit kHertz{"hz", 1.0};
inline constexpr Unit kDegreePerSecond{"deg_s", std::numbers::pi / 180.0};
inline constexpr Unit kDegreePerSecond2{"deg_s2", std::numbers::pi / 180.0};
inline constexpr Unit kMillisecondOfSeconds{"ms", 1e-3};
inline constexpr Unit kMillisecondOfNanoseconds{"ms", 1e6};

struct Range {
  double min;
  double max;
};

/// Adds the keys of one section to a table.
class Section {
 public:
  /// @param name  the section's; empty for keys above the first section.
  Section(std::vector<Entry>& table, std::string name)
      : table_(table), prefix_(name.empty() ? "" : std::move(name) + ".") {}

  Section& real(const std::string& name, double& value, Unit unit, Range range, std::string doc) {
    std::string key = name;
    if (!unit.name.empty()) key.append("_").append(unit.name);
    return add(key, std::move(doc), RealField{&value, unit, range.min, range.max});
  }
  Section& whole(const std::string& name, int& value, int min, int max, std::string doc) {
    return add(name, std::move(doc), WholeField{&value, min, max});
  }
  Section& on_off(const std::string& name, bool& value, std::string doc) {
    return add(name, std::move(doc), SwitchField{&value});
  }
  Section& text(const std::string& name, std::string& value, std::string doc) {
    return add(name, std::move(doc), TextField{&value});
  }
  Section& vector(const std::string& name, std::optional<Eigen::Vector3d>& value, std::string doc) {
    return add(name, std::move(doc), VectorField{&value});
  }
  /// @param names  of the enumerators, in their order from 0.
  template <class Enum>
  Section& choice(const std::string& name, Enum& value, std::vector<std::string> names, std::string doc) {
    Enum* place = &value;
    return add(name, std::move(doc),
               ChoiceField{std::move(names), [place] { return static_cast<std::size_t>(*place); },
                           [place](std::size_t index) { *place = static_cast<Enum>(index); }});
  }

 private:
  template <class Field>
  Section& add(const std::string& name, std::string doc, Field field) {
    table_.push_back({prefix_ + name, std::move(doc), std::move(field)});
    return *this;
  }

  std::vector<Entry>& table_;
  std::string prefix_;
};

void add_detector_settings(std::vector<Entry>& table, detect::DetectorOptions& detector);

}  // namespace stairway::config
