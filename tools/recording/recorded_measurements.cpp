// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/recorded_measurements.hpp"

#include <fmt/format.h>

#include <utility>

#include "ipc/message_codec.hpp"

namespace stairway::tools {
namespace {

constexpr std::string_view kScanName = ipc::kScanChannelName;

std::string_view prefix_of(std::string_view channel) { return channel.substr(0, channel.size() - kScanName.size()); }

// Old recordings and those of others may lack the angles; a few scans tell, since angles come with each.
constexpr int kScansToTell = 200;

}  // namespace

tl::expected<RecordingFacts, ipc::LogError> examine_recording(const std::filesystem::path& path) {
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  RecordingFacts facts;
  std::optional<ipc::Channels> channels;
  int scans = 0;
  std::vector<ipc::StoredEvent> before;
  const auto note = [&](std::string_view channel, std::span<const std::uint8_t> bytes) {
    if (channel == channels->scan) ++scans;
    if (channel == channels->angles) facts.has_angles = true;
    if (channel != channels->settings || facts.settings) return;
    if (auto settings = ipc::decode<ipc::SettingsMessage>(bytes)) facts.settings = std::move(*settings);
  };
  while (const auto event = reader->next()) {
    if (!channels && event->channel.ends_with(kScanName) && ipc::decode<ipc::ScanMessage>(event->bytes)) {
      facts.has_scans = true;
      facts.channel_prefix = prefix_of(event->channel);
      channels.emplace(facts.channel_prefix);
      for (const ipc::StoredEvent& earlier : before) note(earlier.channel, earlier.bytes);
      before.clear();
    }
    if (channels) {
      note(event->channel, event->bytes);
    } else if (event->channel.ends_with(ipc::kSettingsChannelName) ||
               event->channel.ends_with(ipc::kAnglesChannelName)) {
      if (before.size() == 2 * kScansToTell) before.pop_back();
      before.push_back({event->utime_us, std::string(event->channel), {event->bytes.begin(), event->bytes.end()}});
    }
    if (facts.settings && (facts.has_angles || scans >= kScansToTell)) break;
  }
  if (facts.has_scans) return facts;
  const char* why = reader->events() == 0 ? "it holds no LCM event" : "no channel of it ends in SCAN and bears scan_t";
  return tl::unexpected(ipc::LogError{fmt::format("{}: not a recording of stairwayd: {}", path.string(), why)});
}

tl::expected<RecordedMeasurements, ipc::LogError> RecordedMeasurements::open(const std::filesystem::path& path,
                                                                             const RecordingFacts& facts) {
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  return RecordedMeasurements(std::move(*reader), facts);
}

RecordedMeasurements::RecordedMeasurements(ipc::EventLogReader reader, const RecordingFacts& facts)
    : reader_(std::move(reader)), stream_(ipc::Channels(facts.channel_prefix), facts.has_angles) {}

std::optional<RecordedMeasurements::Entry> RecordedMeasurements::next() {
  while (true) {
    if (auto measurement = stream_.next()) return Entry{std::move(*measurement), last_utime_us_};
    if (const auto event = reader_.next()) {
      last_utime_us_ = event->utime_us;
      stream_.take(event->channel, event->bytes);
      continue;
    }
    stream_.end();
    if (auto measurement = stream_.next()) return Entry{std::move(*measurement), last_utime_us_};
    return std::nullopt;
  }
}

std::string describe_flaws(const RecordedMeasurements& recording) {
  std::string text = describe(recording.damage());
  if (recording.undecodable_messages() > 0)
    text += fmt::format("{}{} messages cannot be decoded", text.empty() ? "" : "; ", recording.undecodable_messages());
  return text;
}

}  // namespace stairway::tools
