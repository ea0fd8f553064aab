// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "ipc/messages.hpp"
#include "scan_assembly/sweep_assembler.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// Takes commands, turns them into orders for the source, and answers them; keeps what the disk is there for.
///
/// A command that was answered already is answered again in the same words, and not obeyed again: an acknowledgement
/// may have been lost.
class CommandDesk {
 public:
  /// @pre  settings.problem() is empty.
  explicit CommandDesk(const config::Settings& settings);

  /// A command to obey soon; from any thread. Of more than 16 that wait, the oldest is dropped: its sender asks again.
  /// @return Whether none was dropped.
  bool receive(ipc::CommandMessage command);

  /// Obeys what waits, and gives the answers; from the source's thread.
  /// @param now_utime_us  microseconds since the epoch.
  std::vector<ipc::CommandAckMessage> obey(MeasurementSource& source, std::int64_t now_utime_us);

  /// Ends a single sweep when `sweep` covers a whole turn and did not begin before the command, unless the disk stood
  /// then; from the source's thread.
  void note_sweep(const scan::Sweep& sweep, MeasurementSource& source);

  drivers::DiskMode mode() const { return mode_; }

 private:
  ipc::CommandAckMessage answer(const ipc::CommandMessage& command, MeasurementSource& source,
                                std::int64_t now_utime_us);
  std::string age_problem(const ipc::CommandMessage& command, std::int64_t now_utime_us) const;
  std::string value_problem(const ipc::CommandMessage& command) const;
  std::string carry_out(const ipc::CommandMessage& command, MeasurementSource& source);
  std::string describe() const;

  const double max_age_s_;
  const double max_sweep_s_;
  const drivers::MotorOptions motor_;
  std::atomic<drivers::DiskMode> mode_;
  double speed_rad_s_;
  std::uint64_t next_sweep_ = 0;    // the first that is not known to have ended
  std::uint64_t single_sweep_ = 0;  // the first that counts
  std::deque<ipc::CommandAckMessage> answers_;

  std::mutex mutex_;
  std::deque<ipc::CommandMessage> waiting_;
};

}  // namespace stairway::daemon
