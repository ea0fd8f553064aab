// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/recording_folder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <limits>
#include <optional>
#include <system_error>

namespace stairway::ipc {
namespace {

constexpr std::string_view kKinds[] = {"stairway-", "snapshot-"};

std::optional<std::int64_t> number_of(const std::string& name) {
  if (!name.ends_with(".lcm")) return std::nullopt;
  for (const std::string_view kind : kKinds) {
    if (!name.starts_with(kind)) continue;
    std::int64_t number = 0;
    const char* first = name.data() + kind.size();
    const auto [end, code] = std::from_chars(first, name.data() + name.size(), number);
    if (code == std::errc() && *end == '-') return number;
  }
  return std::nullopt;
}

}  // namespace

std::vector<RecordingFolder::File> RecordingFolder::list() const {
  std::vector<File> files;
  std::error_code code;
  for (std::filesystem::directory_iterator i(path_, code), end; !code && i != end; i.increment(code)) {
    const auto number = number_of(i->path().filename().string());
    std::error_code no_size;
    const std::uint64_t bytes = number ? i->file_size(no_size) : 0;
    if (number && !no_size) files.push_back({*number, i->path(), bytes});
  }
  std::ranges::sort(files, {}, &File::number);
  return files;
}

std::filesystem::path RecordingFolder::next_name(std::string_view kind, std::int64_t utime_us) const {
  const std::vector<File> files = list();
  const std::int64_t number = files.empty() ? 1 : files.back().number + 1;
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm time{};
  ::gmtime_r(&seconds, &time);
  return path_ / fmt::format("{}-{:06}-{:%Y%m%dT%H%M%SZ}.lcm", kind, number, time);
}

int RecordingFolder::make_room(std::uint64_t room_bytes, std::uint64_t max_bytes) const {
  const std::vector<File> files = list();
  std::uint64_t total = room_bytes;
  for (const File& file : files) total += file.bytes;
  int removed = 0;
  for (const File& file : files) {
    if (total <= max_bytes) break;
    std::error_code code;
    if (!std::filesystem::remove(file.path, code)) continue;
    total -= file.bytes;
    ++removed;
  }
  return removed;
}

std::string RecordingFolder::make() const {
  std::error_code code;
  std::filesystem::create_directories(path_, code);
  return code ? fmt::format("{}: cannot be made: {}", path_.string(), code.message()) : "";
}

std::uint64_t RecordingFolder::free_bytes() const {
  std::error_code code;
  const auto space = std::filesystem::space(path_, code);
  return code ? std::numeric_limits<std::uint64_t>::max() : space.available;
}

}  // namespace stairway::ipc
