// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/depth_set.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

namespace stairway::evaluation {
namespace {

constexpr std::size_t kMostFrames = 100000;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts{""};
  for (const char c : line) {
    if (c == ',') {
      parts.emplace_back();
    } else if (c != '\r' && c != ' ') {
      parts.back() += c;
    }
  }
  return parts;
}

FrameLabel label_of(const std::string& word) {
  if (word == "ascending") return FrameLabel::Ascending;
  if (word == "descending") return FrameLabel::Descending;
  if (word == "none") return FrameLabel::None;
  throw std::runtime_error(fmt::format("\"{}\" must be ascending, descending or none", word));
}

double number_of(const std::string& word) {
  std::size_t used = 0;
  double number = NAN;
  try {
    number = std::stod(word, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != word.size() || !std::isfinite(number)) {
    throw std::runtime_error(fmt::format("\"{}\" must be a number", word));
  }
  return number;
}

LabelledFrame frame_of(const std::vector<std::string>& parts, const std::filesystem::path& folder) {
  if (parts.size() != 2 && parts.size() != 5) throw std::runtime_error("must have 2 fields, or 5 with gravity");
  if (parts[0].empty()) throw std::runtime_error("has no file");
  LabelledFrame frame{.cloud = folder / parts[0], .label = label_of(parts[1]), .gravity = {}};
  if (parts.size() == 2 || (parts[2].empty() && parts[3].empty() && parts[4].empty())) return frame;
  frame.gravity = Eigen::Vector3d{number_of(parts[2]), number_of(parts[3]), number_of(parts[4])};
  if (!(frame.gravity->norm() > 1e-9)) throw std::runtime_error("gravity must not be 0");
  return frame;
}

bool is_head(const std::vector<std::string>& parts) {
  const std::vector<std::string> full{"file", "stairs", "gx", "gy", "gz"};
  return parts == full || parts == std::vector<std::string>(full.begin(), full.begin() + 2);
}

}  // namespace

std::vector<LabelledFrame> read_labels(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "labels.csv";
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error(fmt::format("{}: cannot be opened; every frame needs a line there", path.string()));
  std::vector<LabelledFrame> frames;
  std::string line;
  bool has_head = false;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::vector<std::string> parts = fields(line);
    if (parts == std::vector<std::string>{""} || line.starts_with('#')) continue;
    try {
      if (!has_head && !is_head(parts)) throw std::runtime_error("the first line must be file,stairs[,gx,gy,gz]");
      if (has_head) frames.push_back(frame_of(parts, folder));
      has_head = true;
      if (frames.size() > kMostFrames) throw std::runtime_error("is one too many");
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", path.string(), number, error.what()));
    }
  }
  if (frames.empty()) throw std::runtime_error(fmt::format("{}: names no frame", path.string()));
  return frames;
}

}  // namespace stairway::evaluation
