// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stairway::test {

/// A running stairwayd, or another program; killed when it goes out of scope.
class DaemonProcess {
 public:
  /// @param environment  assignments added to this process's environment.
  explicit DaemonProcess(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {},
                         const std::string& program = STAIRWAYD);
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  void signal(int number) const;
  pid_t id() const { return pid_; }
  /// Its exit code; empty when it still runs after `timeout`, -1 when a signal ended it.
  std::optional<int> wait(std::chrono::milliseconds timeout);
  bool is_running() { return !wait(std::chrono::milliseconds(0)); }
  /// What it has written so far, on both streams.
  std::string output() const;
  /// Waits until it has written `text`.
  bool has_said(const std::string& text, std::chrono::milliseconds timeout) const;

 private:
  std::filesystem::path output_file_;
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

}  // namespace stairway::test
