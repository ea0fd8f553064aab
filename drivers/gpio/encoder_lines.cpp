// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpio/encoder_lines.hpp"

#include "drivers/gpio/kernel_edge_port.hpp"
#include "drivers/gpio/libgpiod_edge_port.hpp"

namespace stairway::drivers {

tl::expected<std::unique_ptr<EdgePort>, std::string> open_encoder_lines(const EncoderOptions& options) {
  const auto lines = find_gpio_lines(options);
  if (!lines) return tl::unexpected(lines.error());
  const bool is_kernel =
      options.access == GpioAccess::Kernel || (options.access == GpioAccess::Auto && has_kernel_lines(*lines));
  return is_kernel ? open_kernel_lines(*lines, options) : open_libgpiod_lines(*lines, options);
}

}  // namespace stairway::drivers
