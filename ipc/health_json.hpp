// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "ipc/messages.hpp"

namespace stairway::ipc {

/// The daemon's state as a JSON object on one line, without a line end. Keys as in health_t, what belongs together in
/// objects: `devices`, `clock`, `stages`, `last`. Units as in health_t; what there is none of yet is null.
std::string health_json(const HealthMessage& health);

}  // namespace stairway::ipc
