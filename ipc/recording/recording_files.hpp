// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ipc/recording/event_log_writer.hpp"
#include "ipc/recording/record_options.hpp"
#include "ipc/recording/recording_folder.hpp"

namespace stairway::ipc {

/// Spreads events over files and keeps them within the options' limits. Used by one thread; time is an argument.
///
/// Every file begins with the newest settings message, so each explains itself. When the disk is full or anything else
/// fails, the file is closed with a whole event at its end, events are lost until a new one can be begun, and that is
/// tried every 5 s.
class RecordingFiles {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param kind  the beginning of the files' names, "stairway" or "snapshot".
  RecordingFiles(const RecordOptions& options, std::string kind);

  /// The message with which every later file begins; it is not written by this.
  void set_preamble(StoredEvent settings) { preamble_ = std::move(settings); }

  /// False if the event is lost.
  bool write(const LogEvent& event, Time now);
  /// Hands what was written to the system, and once a second to the disk. Call it several times a second.
  void keep_up(Time now);
  /// Ends the file that is open, on the disk. The next event begins a new one.
  void end_file();

  /// Empty while all goes well; else one line for a person.
  const std::string& trouble() const { return trouble_; }
  /// The newest file; empty before the first.
  const std::filesystem::path& path() const { return path_; }
  std::uint64_t bytes() const { return ended_bytes_ + (file_ ? file_->bytes() : 0); }
  std::uint64_t events() const { return ended_events_ + (file_ ? static_cast<std::uint64_t>(file_->events()) : 0); }
  /// Those that write() answered false for, and those that were to be flushed when the disk failed.
  std::uint64_t lost_events() const { return attempts_ - events(); }

 private:
  bool begin_file(const LogEvent& event, Time now);
  bool is_full(const LogEvent& event, Time now) const;
  bool has_space();
  bool note(const tl::expected<void, LogError>& done, Time now);
  void pause(std::string trouble, Time now);
  void close_file();

  const RecordOptions options_;
  const std::string kind_;
  const RecordingFolder folder_;
  std::optional<StoredEvent> preamble_;
  std::optional<EventLogWriter> file_;
  std::filesystem::path path_;
  Time begun_;
  Time next_sync_;
  Time next_attempt_{};
  std::uint64_t ended_bytes_ = 0;
  std::uint64_t ended_events_ = 0;
  std::uint64_t attempts_ = 0;
  std::string trouble_;
};

}  // namespace stairway::ipc
