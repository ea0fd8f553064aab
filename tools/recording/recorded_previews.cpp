// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/recorded_previews.hpp"

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"
#include "ipc/recording/event_log_reader.hpp"

namespace stairway::tools {

std::optional<std::vector<std::int64_t>> recorded_previews(const std::filesystem::path& path,
                                                           const std::string& channel_prefix) {
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return std::nullopt;
  const ipc::Channels channels(channel_prefix);
  std::vector<std::int64_t> utimes_us;
  std::optional<ipc::StairwaysMessage> last;
  while (const auto event = reader->next()) {
    if (event->channel != channels.stairways) continue;
    auto message = ipc::decode<ipc::StairwaysMessage>(event->bytes);
    if (!message) continue;
    // A sweep that ended before a whole turn is not final either, but nothing about it comes behind its answer.
    if (last && !last->is_final && last->sweep == message->sweep) utimes_us.push_back(last->utime_us);
    last = std::move(*message);
  }
  if (!last) return std::nullopt;
  if (!last->is_final) utimes_us.push_back(last->utime_us);
  return utimes_us;
}

}  // namespace stairway::tools
