// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/withheld_channels.hpp"

namespace stairway::daemon {

std::set<std::string> withheld_channels(const config::Settings& settings) {
  const ipc::Channels channels(settings.lcm.channel_prefix);
  std::set<std::string> withheld;
  const bool is_heard = settings.source.kind == config::SourceKind::Lcm;
  if (is_heard) withheld.insert(channels.disk);
  if (is_heard || !settings.lcm.scans) withheld.insert({channels.scan, channels.angles});
  if (!settings.lcm.raw) withheld.insert(channels.raw);
  return withheld;
}

}  // namespace stairway::daemon
