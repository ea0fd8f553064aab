// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "drivers/scip/scip_events.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// What an event of the scanner means for the pipeline; empty when nothing.
std::optional<SourceEvent> to_source_event(drivers::ScipEvent event);

}  // namespace stairway::daemon
