// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/encoder/encoder_options.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"

namespace stairway::drivers {

/// Opens the encoder's lines by the way that `options.access` says, or tells why not and what to do.
tl::expected<std::unique_ptr<EdgePort>, std::string> open_encoder_lines(const EncoderOptions& options);

}  // namespace stairway::drivers
