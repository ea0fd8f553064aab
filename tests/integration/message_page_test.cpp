// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "drivers/canopen/motor_events.hpp"
#include "drivers/disk/disk_events.hpp"
#include "drivers/encoder/encoder_events.hpp"
#include "drivers/scip/scip_events.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/reason_code.hpp"

namespace stairway::daemon {
namespace {

/// The row of docs/messages.md that begins with this code.
std::string row_of(const std::string& code) {
  std::ifstream page(STAIRWAY_SOURCE_DIR "/docs/messages.md");
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| `" + code + "` |")) return line;
  }
  return {};
}

template <class Trouble>
void expect_codes(Device device, std::size_t number) {
  const std::string row = row_of(reason_code(to_string(device)));
  for (std::size_t i = 0; i < number; ++i) {
    const std::string code = "`" + reason_code(to_string(static_cast<Trouble>(i))) + "`";
    EXPECT_NE(row.find(code), std::string::npos) << to_string(device) << ": " << code;
  }
}

TEST(MessagePage, lists_every_code_of_every_device) {
  expect_codes<drivers::ScipTrouble>(Device::Scanner, drivers::kScipTroubles);
  expect_codes<drivers::MotorTrouble>(Device::Motor, drivers::kMotorTroubles);
  expect_codes<drivers::EncoderTrouble>(Device::Encoder, drivers::kEncoderTroubles);
  expect_codes<drivers::DiskTrouble>(Device::Disk, drivers::kDiskTroubles);
}

}  // namespace
}  // namespace stairway::daemon
