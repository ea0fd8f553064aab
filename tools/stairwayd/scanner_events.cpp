// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/scanner_events.hpp"

#include <fmt/format.h>

#include <utility>

namespace stairway::daemon {
namespace {

using Event = std::optional<SourceEvent>;

struct Translation {
  Event operator()(drivers::LaserScan& scan) const { return std::move(scan); }
  Event operator()(const drivers::ScipDeviceInfo& device) const {
    const drivers::VersionInfo& version = device.version;
    return SourceState{
        false, fmt::format("scanner {}, serial {}, firmware {}", version.product, version.serial, version.firmware)};
  }
  Event operator()(const drivers::ScipTroubleEvent& trouble) const {
    return SourceTrouble{fmt::format("scanner: {}", to_string(trouble.trouble)), trouble.detail};
  }
  Event operator()(const drivers::ScipStateEvent& event) const {
    return SourceState{event.state == drivers::ScipState::Streaming, fmt::format("scanner {}", to_string(event.state))};
  }
  Event operator()(const drivers::ScipReopenEvent&) const { return std::nullopt; }
};

}  // namespace

std::optional<SourceEvent> to_source_event(drivers::ScipEvent event) { return std::visit(Translation{}, event); }

}  // namespace stairway::daemon
