// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tests/integration/daemon_process.hpp"
#include "tests/virtual_bench/rig.hpp"

namespace stairway::bench {

/// What all scenarios share: the hardware, and the robot behind it.
class Machine {
 public:
  /// The only one; made by the first call. Throws std::runtime_error outside of a machine made by in-machine.
  static Machine& get();

  Rig& rig() { return rig_; }
  /// Gives the robot an order, as fake_robot --help lists them; its answer.
  std::string order(const std::string& text) const;

 private:
  Machine();

  Rig rig_;
  std::unique_ptr<test::DaemonProcess> robot_;
};

}  // namespace stairway::bench
