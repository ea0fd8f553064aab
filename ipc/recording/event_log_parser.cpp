// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/event_log_parser.hpp"

#include <algorithm>
#include <array>

namespace stairway::ipc {
namespace {

constexpr std::array<std::uint8_t, 4> kMagicBytes{0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kShortestEvent = kLogHeaderBytes + 1;
constexpr std::size_t kLookAhead = 1 << 20;       // how far a successor is looked for
constexpr std::uint64_t kLongestGap = 1'000'000;  // events; beyond it the numbers began anew

bool is_name(std::span<const std::uint8_t> bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte >= 0x20 && byte < 0x7f; });
}

// A part of the magic number at the very end counts, too.
bool begins_with_magic(std::span<const std::uint8_t> bytes) {
  const std::size_t size = std::min(bytes.size(), kMagicBytes.size());
  return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), kMagicBytes.begin());
}

// How many events are missing between these two numbers, which may be any in a damaged file.
std::uint64_t events_between(std::int64_t before, std::int64_t after) {
  if (after <= before) return 0;
  const std::uint64_t gap = static_cast<std::uint64_t>(after) - static_cast<std::uint64_t>(before) - 1;
  return gap < kLongestGap ? gap : 0;
}

}  // namespace

void EventLogParser::feed(std::span<const std::uint8_t> bytes) {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(position_));
  position_ = 0;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

std::optional<LogEvent> EventLogParser::next() {
  while (left().size() >= kLogHeaderBytes) {
    const auto header = read_log_header(left());
    const Verdict verdict = header ? judge(*header) : Verdict::Damaged;
    if (verdict == Verdict::Whole) return take(*header);
    if (verdict == Verdict::NeedsMore) return std::nullopt;
    skip_to(find_header(1));
  }
  if (is_ended_) finish();
  return std::nullopt;
}

EventLogParser::Verdict EventLogParser::judge(const LogHeader& header) const {
  const auto bytes = left();
  const std::size_t size = header.event_bytes();
  if (bytes.size() < size) return is_ended_ ? Verdict::Damaged : Verdict::NeedsMore;
  if (!is_name(bytes.subspan(kLogHeaderBytes, header.channel_bytes))) return Verdict::Damaged;
  const bool is_followed = begins_with_magic(bytes.subspan(size));
  if (is_followed && (is_ended_ || bytes.size() >= size + kMagicBytes.size())) return Verdict::Whole;
  if (is_followed) return Verdict::NeedsMore;

  const std::size_t successor = find_header(1);
  if (const auto found = read_log_header(bytes.subspan(successor))) {
    const bool has_room_between = successor >= size + kShortestEvent;
    return has_room_between && found->number > header.number + 1 ? Verdict::Whole : Verdict::Damaged;
  }
  return is_ended_ || bytes.size() >= size + kLookAhead ? Verdict::Whole : Verdict::NeedsMore;
}

// Where the next head begins, from this offset into left() on. Without one: where a head could begin that is not all
// there yet, or the end.
std::size_t EventLogParser::find_header(std::size_t from) const {
  const auto bytes = left();
  auto place = bytes.begin() + static_cast<std::ptrdiff_t>(from);
  while (true) {
    place = std::search(place, bytes.end(), kMagicBytes.begin(), kMagicBytes.end());
    const auto offset = static_cast<std::size_t>(place - bytes.begin());
    const std::size_t rest = bytes.size() - offset;
    if (rest >= kLogHeaderBytes && !read_log_header(bytes.subspan(offset))) {
      ++place;
      continue;
    }
    if (rest > 0 || is_ended_) return offset;
    return std::max(from, bytes.size() - std::min(bytes.size(), kMagicBytes.size() - 1));
  }
}

void EventLogParser::skip_to(std::size_t offset) {
  skipped_ += offset;
  position_ += offset;
}

LogEvent EventLogParser::take(const LogHeader& header) {
  const auto bytes = left();
  const auto name = bytes.subspan(kLogHeaderBytes, header.channel_bytes);
  LogEvent event{header.number,
                 header.utime_us,
                 {reinterpret_cast<const char*>(name.data()), name.size()},
                 bytes.subspan(kLogHeaderBytes + header.channel_bytes, header.message_bytes)};
  position_ += header.event_bytes();
  ++events_;
  if (skipped_ > 0) {
    ++damage_.places;
    damage_.skipped_bytes += skipped_;
    skipped_ = 0;
  }
  damage_.lost_events += last_number_ ? events_between(*last_number_, header.number) : 0;
  last_number_ = header.number;
  return event;
}

void EventLogParser::finish() {
  damage_.torn_bytes += skipped_ + left().size();
  skipped_ = 0;
  position_ = buffer_.size();
}

}  // namespace stairway::ipc
