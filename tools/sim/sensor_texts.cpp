// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/sensor_texts.hpp"

#include <fmt/format.h>

#include "drivers/scip/scip_codec.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::sim {

std::string version_lines(std::string_view firmware, std::string_view serial) {
  std::string lines;
  drivers::append_key_value(lines, "VEND", "Hokuyo Automatic Co.,Ltd.");
  drivers::append_key_value(lines, "PROD", "SOKUIKI Sensor TOP-URG UTM-30LX");
  drivers::append_key_value(lines, "FIRM", firmware);
  drivers::append_key_value(lines, "PROT", "SCIP 2.0");
  drivers::append_key_value(lines, "SERI", serial);
  return lines;
}

std::string parameter_lines() {
  std::string lines;
  drivers::append_key_value(lines, "MODL", "UTM-30LX(Hokuyo Automatic Co.,Ltd.)");
  drivers::append_key_value(lines, "DMIN", "23");
  drivers::append_key_value(lines, "DMAX", "60000");
  drivers::append_key_value(lines, "ARES", std::to_string(kStepsPerTurn));
  drivers::append_key_value(lines, "AMIN", "0");
  drivers::append_key_value(lines, "AMAX", std::to_string(kBeams - 1));
  drivers::append_key_value(lines, "AFRT", std::to_string(kFrontBeam));
  drivers::append_key_value(lines, "SCAN", "2400");
  return lines;
}

std::string state_lines(bool is_laser_on, std::uint32_t counter_ms, std::string_view status) {
  std::string lines;
  drivers::append_key_value(lines, "MODL", "UTM-30LX(Hokuyo Automatic Co.,Ltd.)");
  drivers::append_key_value(lines, "LASR", is_laser_on ? "ON" : "OFF");
  drivers::append_key_value(lines, "SCSP", "Initial(2400[rpm])<-Default setting by user");
  drivers::append_key_value(lines, "MESM", "CLASSIC");
  drivers::append_key_value(lines, "SBPS", "USB Full Speed");
  drivers::append_key_value(lines, "TIME", fmt::format("{:06X}", counter_ms));
  drivers::append_key_value(lines, "STAT", status);
  return lines;
}

}  // namespace stairway::sim
