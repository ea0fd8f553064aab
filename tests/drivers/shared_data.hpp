// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

namespace stairway::drivers {

/// Contents of a file below STAIRWAY_SHARED_DATA (environment, else the path given to CMake); empty if absent.
inline std::optional<std::string> read_shared_data(const std::string& name) {
  const char* folder = std::getenv("STAIRWAY_SHARED_DATA");
  std::ifstream file(std::filesystem::path(folder ? folder : STAIRWAY_SHARED_DATA) / name, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace stairway::drivers
