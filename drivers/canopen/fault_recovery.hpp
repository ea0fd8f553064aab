// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "drivers/canopen/cia402.hpp"
#include "drivers/canopen/motor_options.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// Decides when a drive's fault may be reset: at most `max_fault_resets` times per window, and only while the drive is
/// under remote control and its fault reaction is over.
class FaultRecovery {
 public:
  struct Decision {
    bool is_reset_due = false;          ///< reset it now; it counts
    std::optional<std::string> hurdle;  ///< for a person, once per fault: why not
  };

  explicit FaultRecovery(const MotorOptions& options);

  /// A new fault.
  void begin();
  Decision decide(std::uint16_t statusword, HostStamp now_ns);

 private:
  HostStamp allowed_ns() const;
  Decision refuse(bool& is_told, std::string hurdle);

  std::size_t most_;
  HostStamp window_ns_;
  std::deque<HostStamp> resets_ns_;
  bool is_local_told_ = false;
  bool is_limit_told_ = false;
};

}  // namespace stairway::drivers
