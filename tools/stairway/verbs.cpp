// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {

std::span<const Verb> verbs() {
  static constexpr Verb kVerbs[] = {
      {"detect", "find the stairways in clouds, recordings and simulated scenes", declare_detect},
      {"monitor", "show what stairwayd reports, live", declare_monitor},
      {"command", "tell a running stairwayd to start, stop, make one sweep or change its speed", declare_command},
      {"simulate", "write the cloud that the robot would assemble in a scene", declare_simulate},
      {"record", "record what stairwayd sends", declare_record},
      {"replay", "send a recording again, in its time", declare_replay},
      {"evaluate", "repeat the experiments of the paper on simulated stairs", declare_evaluate},
      {"info", "describe clouds and recordings", declare_info},
      {"convert", "turn recordings and clouds into PCD, PLY, CSV or JSON", declare_convert},
      {"doctor", "look for what is wrong with the devices and the set-up, and say what to do", declare_doctor},
      {"config", "show, check or compare settings", declare_config},
  };
  return kVerbs;
}

}  // namespace stairway::tools
