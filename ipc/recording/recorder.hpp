// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "ipc/channels.hpp"
#include "ipc/recording/record_options.hpp"
#include "ipc/recording/recording_files.hpp"
#include "ipc/recording/snapshot_ring.hpp"

namespace stairway::ipc {

/// How a recording is doing.
struct RecorderStatus {
  std::uint64_t events = 0;       ///< written, or in snapshot mode kept
  std::uint64_t lost_events = 0;  ///< because the disk was full or slow
  std::uint64_t bytes = 0;        ///< written
  std::uint64_t snapshots = 0;    ///< written
  std::filesystem::path file;     ///< the newest
  std::string trouble;            ///< why nothing is written now, for a person; else empty
};

/// Records messages without keeping anybody waiting: they go into a queue that a thread of its own writes to the disk.
///
/// What does not fit into the queue (32 MB, minutes of an idle disk's scans) pushes out the oldest, which is counted.
/// The newest 0.1 s may be lost when the process is killed, the last second at a power loss.
class Recorder {
 public:
  /// Starts at once; files appear with the first message.
  /// @pre  options.problem() is empty and the mode is not Off.
  Recorder(const RecordOptions& options, const Channels& channels);
  /// Writes what is in the queue.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Takes a message; never waits for the disk. May be called by any thread. Messages on Channels::raw are left out
  /// unless the options ask for them.
  /// @param utime_us  when it was received or sent.
  void add(std::string_view channel, std::span<const std::uint8_t> bytes, std::int64_t utime_us);

  /// Writes what is kept of the last sweeps to a file of its own; only in snapshot mode, where it answers true.
  bool request_snapshot();

  RecorderStatus status() const;
  /// Writes what is in the queue and ends the file; later messages are ignored.
  void close();

 private:
  void run(std::stop_token stop);
  void write(StoredEvent event);
  void write_snapshot();
  void publish_status();

  const RecordOptions options_;
  const Channels channels_;
  RecordingFiles files_;
  SnapshotRing ring_;

  mutable std::mutex mutex_;
  std::condition_variable_any wakeup_;
  std::deque<StoredEvent> queue_;
  std::size_t queued_bytes_ = 0;
  bool is_snapshot_wanted_ = false;
  bool is_closed_ = false;
  std::uint64_t overflown_events_ = 0;
  RecorderStatus status_;

  std::jthread writer_;
};

}  // namespace stairway::ipc
