// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/load_settings.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "config/nearest_key.hpp"
#include "config/profiles.hpp"
#include "config/settings_table.hpp"

namespace stairway::config {
namespace {

constexpr std::string_view kDefaultProfile = "lidar";
constexpr const char* kUsualFile = "/etc/stairwayd/stairwayd.toml";
constexpr std::size_t kMaxFileBytes = 1 << 20;

/// One source of settings: its contents and how to name a place in it.
struct Layer {
  toml::table table;
  std::string name;
  bool has_lines = true;

  std::string origin(const toml::node& node) const {
    return has_lines ? fmt::format("{}:{}", name, node.source().begin.line) : name;
  }
  std::string place(const toml::source_position& position) const {
    return has_lines ? fmt::format("{}:{}:{}", name, position.line, position.column) : name;
  }
};

tl::unexpected<SettingsError> refusal(std::string text) { return tl::unexpected(SettingsError{std::move(text)}); }

tl::expected<Layer, SettingsError> parse_layer(std::string_view text, std::string name) {
  try {
    return Layer{toml::parse(text), std::move(name)};
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    return refusal(fmt::format("{}:{}:{}: {}", name, at.line, at.column, error.description()));
  }
}

tl::expected<Layer, SettingsError> read_file(const std::filesystem::path& path) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) return refusal(fmt::format("{}: cannot read the settings: {}", path.string(), failure.message()));
  if (size > kMaxFileBytes) return refusal(fmt::format("{}: {} bytes are no settings file", path.string(), size));
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file && size > 0) {
    return refusal(fmt::format("{}: cannot read the settings: {}", path.string(), std::strerror(errno)));
  }
  return parse_layer(text.str(), path.string());
}

const Entry* find_entry(const std::vector<Entry>& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

bool is_section(const std::vector<Entry>& table, const std::string& key) {
  return std::any_of(table.begin(), table.end(), [&](const Entry& entry) { return entry.key.starts_with(key + "."); });
}

std::string unknown_key(const std::vector<Entry>& table, const std::string& key) {
  if (is_section(table, key)) return fmt::format("'{}' is a section and takes no value of its own", key);
  const std::string nearest = nearest_key(key, table);
  return nearest.empty() ? fmt::format("unknown key '{}'", key)
                         : fmt::format("unknown key '{}'; did you mean '{}'?", key, nearest);
}

// put() sets the value if it is of the right kind and within its range.

bool put(const RealField& field, const toml::node& node) {
  const auto value = node.value<double>();
  if (!node.is_number() || !value || !(*value >= field.min && *value <= field.max)) return false;
  *field.value = field.unit.to_struct(*value);
  return true;
}

bool put(const WholeField& field, const toml::node& node) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < field.min || *value > field.max) return false;
  *field.value = static_cast<int>(*value);
  return true;
}

bool put(const SwitchField& field, const toml::node& node) {
  const auto value = node.value_exact<bool>();
  if (!value) return false;
  *field.value = *value;
  return true;
}

bool put(const TextField& field, const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value) return false;
  *field.value = *value;
  return true;
}

bool put(const ChoiceField& field, const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  const auto found = value ? std::find(field.names.begin(), field.names.end(), *value) : field.names.end();
  if (found == field.names.end()) return false;
  field.set(static_cast<std::size_t>(found - field.names.begin()));
  return true;
}

bool put(const VectorField& field, const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || (!array->empty() && array->size() != 3)) return false;
  if (array->empty()) {
    field.value->reset();
    return true;
  }
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node* element = array->get(i);
    if (!element->is_number()) return false;
    vector[static_cast<Eigen::Index>(i)] = element->value_or(std::numeric_limits<double>::quiet_NaN());
  }
  if (!vector.allFinite()) return false;
  *field.value = vector;
  return true;
}

/// The node as its author wrote it, shortened.
std::string written(const toml::node& node) {
  if (node.is_table()) return "a section";
  std::ostringstream text;
  node.visit([&](const auto& typed) { text << typed; });
  constexpr std::size_t kShown = 60;
  return text.str().size() > kShown ? text.str().substr(0, kShown) + "..." : text.str();
}

/// Puts the values of one layer where the table says; `section` ends in a dot unless it is the top one.
tl::expected<void, SettingsError> apply(const Layer& layer, const toml::table& values, const std::string& section,
                                        const std::vector<Entry>& table, LoadedSettings& loaded) {
  for (const auto& [name, node] : values) {
    const std::string key = section + std::string(name.str());
    const Entry* entry = find_entry(table, key);
    if (entry == nullptr && node.is_table() && is_section(table, key)) {
      if (auto applied = apply(layer, *node.as_table(), key + ".", table, loaded); !applied) return applied;
      continue;
    }
    if (entry == nullptr) {
      return refusal(fmt::format("{}: {}", layer.place(name.source().begin), unknown_key(table, key)));
    }
    if (!std::visit([&](const auto& field) { return put(field, node); }, entry->field)) {
      return refusal(fmt::format("{}: {}: expected {}, found {}", layer.place(node.source().begin), key,
                                 describe_range(*entry), written(node)));
    }
    loaded.origins[key] = layer.origin(node);
  }
  return {};
}

/// Turns "a.b=value" into the table that a file with this line would give.
tl::expected<Layer, SettingsError> parse_assignment(const std::string& assignment, const std::vector<Entry>& table) {
  const std::string name = fmt::format("--set {}", assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    return refusal(fmt::format("{}: expected KEY=VALUE, e.g. detector.voxel_mm=10", name));
  }
  const std::string key = assignment.substr(0, equals);
  const std::string value = assignment.substr(equals + 1);
  const Entry* entry = find_entry(table, key);
  if (entry == nullptr) return refusal(fmt::format("{}: {}", name, unknown_key(table, key)));

  const bool takes_text =
      std::holds_alternative<TextField>(entry->field) || std::holds_alternative<ChoiceField>(entry->field);
  Layer layer{{}, name, false};
  if (takes_text && !value.starts_with('"') && !value.starts_with('\'')) {
    layer.table.insert(key, value);
    return layer;
  }
  auto parsed = parse_layer("value = " + value, name);
  if (!parsed || parsed->table.size() != 1) {
    return refusal(fmt::format("{}: expected {}, found {}", name, describe_range(*entry), value));
  }
  layer.table.insert(key, std::move(*parsed->table.get("value")));
  return layer;
}

tl::expected<Layer, SettingsError> find_profile(const std::string& name, const std::string& origin) {
  for (const auto& [shipped, text] : shipped_profiles()) {
    if (shipped == name) return parse_layer(text, fmt::format("profile {}", name));
  }
  return refusal(
      fmt::format("{}: unknown profile '{}'; there are: {}", origin, name, fmt::join(profile_names(), ", ")));
}

/// The strongest layer's say on the profile, and where it stands.
std::pair<std::string, std::string> chosen_profile(const std::vector<Layer>& layers) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const toml::node* node = layer->table.get("profile");
    if (node != nullptr && node->is_string()) return {node->value_or(std::string()), layer->origin(*node)};
  }
  return {std::string(kDefaultProfile), "default"};
}

}  // namespace

std::vector<std::filesystem::path> usual_files(const std::filesystem::path& file) {
  const std::filesystem::path first = file.empty() ? kUsualFile : file;
  std::error_code ignored;
  if (file.empty() && !std::filesystem::exists(first, ignored)) return {};
  std::vector<std::filesystem::path> files{first};
  for (const auto& entry : std::filesystem::directory_iterator(first.parent_path() / "conf.d", ignored)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin() + 1, files.end());
  return files;
}

tl::expected<LoadedSettings, SettingsError> load_settings(const SettingsSources& sources) {
  LoadedSettings loaded;
  const std::vector<Entry> table = settings_table(loaded.settings);
  std::vector<Layer> layers;
  for (const std::filesystem::path& path : sources.files) {
    auto layer = read_file(path);
    if (!layer) return tl::unexpected(layer.error());
    layers.push_back(std::move(*layer));
  }
  for (const std::string& assignment : sources.assignments) {
    auto layer = parse_assignment(assignment, table);
    if (!layer) return tl::unexpected(layer.error());
    layers.push_back(std::move(*layer));
  }
  const auto [profile_name, profile_origin] = chosen_profile(layers);
  auto profile = find_profile(profile_name, profile_origin);
  if (!profile) return tl::unexpected(profile.error());
  profile->has_lines = false;
  layers.insert(layers.begin(), std::move(*profile));

  for (const Layer& layer : layers) {
    if (auto applied = apply(layer, layer.table, "", table, loaded); !applied) return tl::unexpected(applied.error());
  }
  if (const std::string problem = loaded.settings.problem(); !problem.empty()) {
    return refusal(fmt::format("the settings do not fit together: {}", problem));
  }
  return loaded;
}

std::vector<ShownSetting> show_settings(const LoadedSettings& loaded) {
  Settings copy = loaded.settings;
  std::vector<ShownSetting> shown;
  for (const Entry& entry : settings_table(copy)) {
    const auto origin = loaded.origins.find(entry.key);
    shown.push_back({entry.key, show_value(entry), describe_range(entry), entry.doc,
                     origin == loaded.origins.end() ? "default" : origin->second});
  }
  return shown;
}

std::vector<std::string_view> profile_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, text] : shipped_profiles()) names.push_back(name);
  return names;
}

}  // namespace stairway::config
