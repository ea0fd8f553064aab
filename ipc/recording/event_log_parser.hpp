// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ipc/recording/event_log.hpp"

namespace stairway::ipc {

/// What is wrong with a log.
struct LogDamage {
  std::uint64_t places = 0;         ///< bytes between two events that are no event
  std::uint64_t skipped_bytes = 0;  ///< at these places
  std::uint64_t torn_bytes = 0;     ///< after the last whole event: what was being written when power went
  std::uint64_t lost_events = 0;    ///< by the numbers of the events around them

  bool is_any() const { return places > 0 || torn_bytes > 0 || lost_events > 0; }
};

/// Takes the bytes of a log in pieces and gives its events. Pure: it reads no file.
///
/// Damage costs the events it is in: what is no event is passed over up to the next magic number. An event whose
/// successor does not follow at once is given only if the numbers say that one was lost in between; otherwise its own
/// length is wrong. A flipped bit inside a message cannot be seen here; decode() looks at messages.
class EventLogParser {
 public:
  /// Invalidates what next() gave.
  void feed(std::span<const std::uint8_t> bytes);
  /// There are no more bytes.
  void end() { is_ended_ = true; }

  /// The next event, valid until the next feed() or next(); empty when more bytes are needed, or there is none left.
  std::optional<LogEvent> next();

  bool is_ended() const { return is_ended_; }
  const LogDamage& damage() const { return damage_; }
  std::uint64_t events() const { return events_; }

 private:
  enum class Verdict { Whole, Damaged, NeedsMore };

  std::span<const std::uint8_t> left() const { return std::span(buffer_).subspan(position_); }
  Verdict judge(const LogHeader& header) const;
  std::size_t find_header(std::size_t from) const;
  void skip_to(std::size_t offset);
  LogEvent take(const LogHeader& header);
  void finish();

  std::vector<std::uint8_t> buffer_;
  std::size_t position_ = 0;
  bool is_ended_ = false;
  std::uint64_t skipped_ = 0;  // since the last event
  std::optional<std::int64_t> last_number_;
  std::uint64_t events_ = 0;
  LogDamage damage_;
};

}  // namespace stairway::ipc
