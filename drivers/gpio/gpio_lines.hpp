// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/encoder/encoder_options.hpp"
#include "drivers/gpio/file_descriptor.hpp"
#include "drivers/ports/edge_port.hpp"

namespace stairway::drivers {

/// The name under which the lines are taken; other programs see it.
inline constexpr const char* kConsumer = "stairwayd";

/// The encoder's lines, found on their chip: A, B and, where there is one, the index.
struct GpioLines {
  FileDescriptor chip;
  std::filesystem::path path;          ///< of the chip's device
  std::vector<std::uint32_t> offsets;  ///< of A, B, index, in this order; two or three
};

/// Finds chip and lines by what the options call them. Everything that can be wrong is said for a person: no such chip
/// (naming those there are), no permission (naming the udev rule), no such line, a line that another program has.
/// @param devices  where the chips' devices are.
tl::expected<GpioLines, std::string> find_gpio_lines(const EncoderOptions& options,
                                                     const std::filesystem::path& devices = "/dev");

/// What the request for lines failed with, for a person; names the program that has one of them.
std::string refusal_text(const GpioLines& lines, int error);

}  // namespace stairway::drivers
