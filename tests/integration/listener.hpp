// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "ipc/lcm_bus.hpp"
#include "ipc/messages.hpp"

namespace stairway::test {

/// A subscriber to everything the daemon sends.
class Listener {
 public:
  Listener();

  /// Takes messages until `is_enough` or the time is up; answers which of them it was.
  bool listen(std::chrono::seconds timeout, const std::function<bool(const Listener&)>& is_enough);

  std::vector<ipc::ScanMessage> scans;
  std::vector<ipc::DiskMessage> disks;
  std::vector<ipc::StairwaysMessage> answers;
  std::vector<ipc::HealthMessage> healths;
  std::vector<ipc::SettingsMessage> settings;

 private:
  template <class Message>
  void keep(const std::string& channel, std::vector<Message>& messages);

  std::unique_ptr<ipc::LcmBus> bus_;
};

}  // namespace stairway::test
