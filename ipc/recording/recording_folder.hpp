// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stairway::ipc {

/// The recordings in a folder. Their names begin with a number that grows from file to file, so their order does not
/// depend on the clock of a robot that may think it is 1970. Other files are left alone.
class RecordingFolder {
 public:
  explicit RecordingFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// For a new file, e.g. "stairway-000012-20260731T141500Z.lcm".
  /// @param kind  "stairway" or "snapshot".
  std::filesystem::path next_name(std::string_view kind, std::int64_t utime_us) const;

  /// Removes the oldest recordings until `room_bytes` more would still be within `max_bytes`. What cannot be removed
  /// stays. @return how many went.
  int make_room(std::uint64_t room_bytes, std::uint64_t max_bytes) const;

  /// Makes the folder if needed; empty, or why not, for a person.
  std::string make() const;
  /// What unprivileged programs may still write there [bytes]; the largest number if that cannot be told.
  std::uint64_t free_bytes() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  struct File {
    std::int64_t number = 0;
    std::filesystem::path path;
    std::uint64_t bytes = 0;
  };
  std::vector<File> list() const;  // oldest first

  std::filesystem::path path_;
};

}  // namespace stairway::ipc
