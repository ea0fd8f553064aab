// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/settings.hpp"

namespace stairway::config {

/// A unit of the settings file: the ending of its keys and what one of it is in the struct.
struct Unit {
  std::string_view name;  ///< "" for a plain number
  double in_struct = 1.0;

  /// A thousandth is no binary number: 700 mm are 700 / 1000 m, to the last bit the 0.7 of a struct.
  double to_struct(double in_file) const {
    const double inverse = std::round(1.0 / in_struct);
    return in_struct < 1.0 && 1.0 / inverse == in_struct ? in_file / inverse : in_file * in_struct;
  }
};

struct RealField {
  double* value;
  Unit unit;
  double min;  ///< in the file's unit, like `max`; both allowed
  double max;
};
struct WholeField {
  int* value;
  int min;
  int max;
};
struct SwitchField {
  bool* value;
};
struct TextField {
  std::string* value;
};
struct ChoiceField {
  std::vector<std::string> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};
struct VectorField {
  std::optional<Eigen::Vector3d>* value;  ///< shown as [] while empty
};

/// One key of the settings file and the place in a Settings that it sets.
struct Entry {
  std::string key;  ///< with its sections, e.g. "detector.normals.radius_mm"
  std::string doc;  ///< one line, without unit and range
  std::variant<RealField, WholeField, SwitchField, TextField, ChoiceField, VectorField> field;
};

/// Every key there is, section by section in the order of the default file. Whatever reads, checks, shows or documents
/// settings goes through this table.
/// @param settings  must outlive the result.
std::vector<Entry> settings_table(Settings& settings);

/// The value as TOML, reals in the file's unit with six significant digits.
std::string show_value(const Entry& entry);

/// The values an entry takes, for a person, e.g. "1..100 mm" or "greedy, thorough or optimizing".
std::string describe_range(const Entry& entry);

/// Whether a running daemon takes a new value of this key at SIGHUP; the others need a restart.
bool changes_live(std::string_view key);

/// The text of config/stairwayd.toml: every key, commented out with its default.
std::string default_file_text();

/// A settings file that sets every key to what it is in `settings`; reals with as many digits as they need to be the
/// same when the file is read.
std::string to_toml(const Settings& settings);

}  // namespace stairway::config
