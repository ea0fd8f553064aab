// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "ipc/bus.hpp"

struct _lcm_t;  // lcm.h stays out of the headers

namespace stairway::ipc {

/// LCM over any of its providers: `udpm://` multicast, `file://` event logs, `memq://` within the process.
class LcmBus final : public Bus {
 public:
  /// Opens `url`. The usual reason for a failure of udpm is a host without a multicast route; the error says how to add
  /// one. Trying again later is sensible: networks come up late.
  static tl::expected<std::unique_ptr<LcmBus>, BusError> open(const std::string& url);

  ~LcmBus() override;
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  tl::expected<void, BusError> publish(const std::string& channel, std::span<const std::uint8_t> bytes) override;

  /// On udpm the first call tests the network and may take up to 10 s if multicast is blocked.
  tl::expected<void, BusError> subscribe(const std::string& pattern, MessageHandler handler) override;

  tl::expected<bool, BusError> handle(std::chrono::milliseconds timeout) override;

 private:
  LcmBus(_lcm_t* lcm, std::string url);

  _lcm_t* lcm_;
  std::string url_;
  std::vector<std::unique_ptr<MessageHandler>> handlers_;  // LCM keeps their addresses
};

}  // namespace stairway::ipc
