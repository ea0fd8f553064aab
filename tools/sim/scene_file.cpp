// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "tools/sim/angles.hpp"
#include "tools/sim/random_scenes.hpp"
#include "tools/sim/shipped_scenes.hpp"

namespace stairway::sim {
namespace {

constexpr std::size_t kLongestFile = 1 << 20;

[[noreturn]] void fail(const std::string& source, const toml::source_region& where, const std::string& what) {
  throw SceneFileError{fmt::format("{}:{}: {}", source, where.begin.line, what)};
}

// Takes known keys out of a table and then finds those that nobody knew.
class TableReader {
 public:
  TableReader(const toml::node& node, const std::string& source, std::string name)
      : table_{*node.as_table()}, source_{source}, name_{std::move(name)} {}

  void read(const char* key, double& value, double unit = 1.0) {
    const toml::node* node = take(key);
    if (node != nullptr) value = unit * number(*node, key);
  }
  void read(const char* key, int& value) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    const auto number = node->value_exact<std::int64_t>();
    if (!number || *number < 0 || *number > 1000000) fail(key, *node, "must be a whole number from 0 to 1000000");
    value = static_cast<int>(*number);
  }
  void read(const char* key, std::vector<double>& values) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    if (!node->is_array()) fail(key, *node, "must be a list of numbers");
    values.clear();
    for (const toml::node& element : *node->as_array()) values.push_back(number(element, key));
  }
  template <int N>
  void read(const char* key, Eigen::Matrix<double, N, 1>& value) {
    std::vector<double> numbers;
    read(key, numbers);
    if (!has(key)) return;
    if (numbers.size() != N) fail(key, *table_.get(key), fmt::format("must be a list of {} numbers", N));
    value = Eigen::Map<Eigen::Matrix<double, N, 1>>{numbers.data()};
  }
  std::optional<std::string> read_word(const char* key, const std::vector<std::string_view>& allowed) {
    const toml::node* node = take(key);
    if (node == nullptr) return std::nullopt;
    const auto word = node->value_exact<std::string>();
    if (!word || std::find(allowed.begin(), allowed.end(), *word) == allowed.end()) {
      fail(key, *node, fmt::format("must be one of \"{}\"", fmt::join(allowed, "\", \"")));
    }
    return word;
  }
  bool has(const char* key) const { return table_.contains(key); }

  void refuse_unknown_keys() const {
    for (const auto& [key, node] : table_) {
      if (known_.contains(key.str())) continue;
      fail(std::string{key.str()}, node, fmt::format("is no key here; known are {}", fmt::join(known_, ", ")));
    }
  }
  [[noreturn]] void fail(const std::string& key, const toml::node& node, const std::string& what) const {
    sim::fail(source_, node.source(), fmt::format("{}{}{} {}", name_, name_.empty() ? "" : ".", key, what));
  }
  [[noreturn]] void fail(const std::string& what) const {
    sim::fail(source_, table_.source(), fmt::format("{}: {}", name_, what));
  }

 private:
  const toml::node* take(const char* key) {
    known_.insert(key);
    return table_.get(key);
  }
  double number(const toml::node& node, const char* key) const {
    const auto number = node.value<double>();
    if (!node.is_number() || !number || !std::isfinite(*number)) fail(key, node, "must be a number");
    return *number;
  }

  const toml::table& table_;
  const std::string& source_;
  std::string name_;
  std::set<std::string, std::less<>> known_;
};

Room read_room(TableReader reader) {
  Room room;
  Eigen::Vector2d x{room.low.x(), room.high.x()};
  Eigen::Vector2d y{room.low.y(), room.high.y()};
  reader.read("x_m", x);
  reader.read("y_m", y);
  reader.read("height_m", room.height_m);
  reader.refuse_unknown_keys();
  room.low = {x[0], y[0]};
  room.high = {x[1], y[1]};
  return room;
}

void read_place(TableReader& reader, StairSpec& spec) {
  const bool is_polar = reader.has("distance_m") || reader.has("bearing_deg");
  if (is_polar && reader.has("position_m")) reader.fail("give either position_m or distance_m and bearing_deg");
  double distance = 2.0;
  double bearing = 0.0;
  reader.read("distance_m", distance);
  reader.read("bearing_deg", bearing, kDegree);
  reader.read("position_m", spec.position);
  if (is_polar) spec.position = distance * unit(bearing);
  // Without a heading the flight leads straight away from the robot: up, or down.
  const Eigen::Vector2d ascent = spec.descending ? Eigen::Vector2d{-spec.position} : spec.position;
  spec.heading_rad = std::atan2(ascent.y(), ascent.x());
  reader.read("heading_deg", spec.heading_rad, kDegree);
}

StairSpec read_stairs(TableReader reader) {
  StairSpec spec;
  reader.read("steps", spec.steps);
  reader.read("height_m", spec.height_m);
  reader.read("depth_m", spec.depth_m);
  reader.read("width_m", spec.width_m);
  reader.read("tread_thickness_m", spec.tread_thickness_m);
  reader.read("overhang_m", spec.overhang_m);
  reader.read("landing_m", spec.landing_m);
  reader.read("level_m", spec.level_m);
  reader.read("turn_per_step_deg", spec.turn_per_step_rad, kDegree);
  reader.read("height_offsets_m", spec.height_offsets_m);
  reader.read("depth_offsets_m", spec.depth_offsets_m);
  spec.open_risers = reader.read_word("risers", {"closed", "open"}) == "open";
  spec.descending = reader.read_word("direction", {"ascending", "descending"}) == "descending";
  const std::string railing = reader.read_word("railing", {"none", "left", "right", "both"}).value_or("none");
  spec.railing_left = railing == "left" || railing == "both";
  spec.railing_right = railing == "right" || railing == "both";
  read_place(reader, spec);
  reader.refuse_unknown_keys();
  if (const std::string problem = spec.problem(); !problem.empty()) reader.fail(problem);
  return spec;
}

Furniture read_furniture(TableReader reader) {
  std::vector<std::string_view> kinds;
  for (std::size_t i = 0; i < kFurnitureKinds; ++i) kinds.push_back(to_string(static_cast<FurnitureKind>(i)));
  const auto kind = reader.read_word("kind", kinds);
  if (!kind) reader.fail(fmt::format("needs a kind, one of \"{}\"", fmt::join(kinds, "\", \"")));
  Furniture piece;
  piece.kind = *furniture_kind(*kind);
  piece.size = usual_size(piece.kind);
  if (!reader.has("position_m")) reader.fail("needs position_m = [x, y]");
  reader.read("position_m", piece.position);
  reader.read("yaw_deg", piece.yaw_rad, kDegree);
  reader.read("size_m", piece.size);
  reader.read("level_m", piece.level_m);
  reader.refuse_unknown_keys();
  return piece;
}

template <typename Read>
void read_list(const toml::table& root, const char* key, const std::string& source, Read read) {
  const toml::node* node = root.get(key);
  if (node == nullptr) return;
  if (!node->is_array_of_tables()) sim::fail(source, node->source(), fmt::format("write [[{}]] for each", key));
  std::size_t index = 0;
  for (const toml::node& element : *node->as_array()) {
    read(TableReader{element, source, fmt::format("{}[{}]", key, index++)});
  }
}

}  // namespace

SceneSpec parse_scene(std::string_view text, const std::string& source) {
  SceneSpec spec;
  spec.name = source;
  try {
    const toml::table root = toml::parse(text);
    for (const auto& [key, node] : root) {
      if (key != "room" && key != "stairs" && key != "furniture") {
        fail(source, node.source(), fmt::format("{} is no key here; known are room, stairs, furniture", key.str()));
      }
    }
    if (const toml::node* node = root.get("room")) {
      if (!node->is_table()) fail(source, node->source(), "write [room]");
      spec.room = read_room(TableReader{*node, source, "room"});
    }
    read_list(root, "stairs", source, [&](TableReader reader) { spec.stairs.push_back(read_stairs(reader)); });
    read_list(root, "furniture", source, [&](TableReader reader) { spec.furniture.push_back(read_furniture(reader)); });
  } catch (const toml::parse_error& error) {
    fail(source, error.source(), std::string{error.description()});
  }
  if (const std::string problem = spec.problem(); !problem.empty()) throw SceneFileError{source + ": " + problem};
  return spec;
}

SceneSpec load_scene(const std::string& name) {
  if (auto scene = random_scene(name)) return std::move(*scene);
  for (const auto& scene : shipped_scenes()) {
    if (scene.name == name) return parse_scene(scene.text, name);
  }
  if (!name.ends_with(".toml")) {
    throw SceneFileError{fmt::format("no scene is called \"{}\"; there are {}, {}:SEED, or a file *.toml", name,
                                     fmt::join(shipped_scene_names(), ", "),
                                     fmt::join(random_scene_kinds(), ":SEED, "))};
  }
  std::ifstream file{name, std::ios::binary};
  if (!file) throw SceneFileError{fmt::format("{}: cannot be opened; is the path right and readable?", name)};
  std::string text(kLongestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw SceneFileError{fmt::format("{}: cannot be read", name)};
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLongestFile) throw SceneFileError{fmt::format("{}: is longer than {} bytes", name, kLongestFile)};
  return parse_scene(text, name);
}

std::vector<std::string> shipped_scene_names() {
  std::vector<std::string> names;
  for (const auto& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

}  // namespace stairway::sim
