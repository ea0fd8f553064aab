// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/recording_summary.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"

namespace stairway::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLongestLoss = 100'000;  // scans; beyond it the scanner's stream began anew

bool is_named(std::string_view channel, std::string_view name) { return channel.ends_with(name); }

/// Goes through the events once.
class Summariser {
 public:
  void add(const ipc::LogEvent& event) {
    if (summary.events++ == 0) summary.begin_utime_us = event.utime_us;
    last_utime_us_ = std::max(last_utime_us_.value_or(event.utime_us), event.utime_us);
    ChannelSummary& channel = summary.channels[std::string(event.channel)];
    Span& span = spans_[std::string(event.channel)];
    if (channel.messages++ == 0) span = {event.utime_us, event.utime_us};
    channel.longest_gap_s = std::max(channel.longest_gap_s, 1e-6 * static_cast<double>(event.utime_us - span.last_us));
    span.last_us = event.utime_us;
    channel.bytes += event.bytes.size();
    look_into(event, channel);
  }

  RecordingSummary finish() {
    summary.duration_s = last_utime_us_ ? 1e-6 * static_cast<double>(*last_utime_us_ - summary.begin_utime_us) : 0.0;
    for (auto& [name, channel] : summary.channels) {
      const double span_s = 1e-6 * static_cast<double>(spans_[name].last_us - spans_[name].first_us);
      if (span_s > 0.0) channel.rate_hz = static_cast<double>(channel.messages - 1) / span_s;
    }
    summary.stairways = tracks_.size();
    return std::move(summary);
  }

  RecordingSummary summary;

 private:
  struct Span {
    std::int64_t first_us = 0, last_us = 0;
  };

  template <class Message, class Look>
  void decoded(const ipc::LogEvent& event, ChannelSummary& channel, Look look) {
    const auto message = ipc::decode<Message>(event.bytes);
    message ? look(*message) : static_cast<void>(++channel.undecodable);
  }

  void look_into(const ipc::LogEvent& event, ChannelSummary& channel) {
    if (is_named(event.channel, ipc::kScanChannelName))
      decoded<ipc::ScanMessage>(event, channel, [&](const auto& message) { look(message); });
    if (is_named(event.channel, ipc::kAnglesChannelName))
      decoded<ipc::AnglesMessage>(event, channel, [&](const auto& message) { look(message); });
    if (is_named(event.channel, ipc::kSettingsChannelName))
      decoded<ipc::SettingsMessage>(event, channel, [&](const auto& message) { look(message); });
    if (is_named(event.channel, "STAIRWAYS"))
      decoded<ipc::StairwaysMessage>(event, channel, [&](const auto& message) { look(message); });
  }

  void look(const ipc::ScanMessage& message) {
    const std::uint64_t sequence = message.scan.sequence;
    const bool is_loss = last_sequence_ && sequence > *last_sequence_ && sequence - *last_sequence_ <= kLongestLoss;
    if (is_loss) summary.lost_scans += sequence - *last_sequence_ - 1;
    last_sequence_ = sequence;
  }
  void look(const ipc::AnglesMessage& message) {
    for (const drivers::AngleSample& sample : message.samples) {
      const bool is_known = sample.valid && std::isfinite(sample.angle_rad);
      if (is_known && last_angle_rad_)
        summary.turns += std::abs(sample.angle_rad - *last_angle_rad_) / (2.0 * std::numbers::pi);
      last_angle_rad_ = is_known ? std::optional(sample.angle_rad) : std::nullopt;
    }
  }
  void look(const ipc::SettingsMessage& message) {
    if (summary.versions.empty() || summary.versions.back() != message.version)
      summary.versions.push_back(message.version);
    if (last_settings_ && *last_settings_ != message.toml) ++summary.settings_changes;
    last_settings_ = message.toml;
  }
  void look(const ipc::StairwaysMessage& message) {
    ++(message.is_final ? summary.answers : summary.previews);
    tracks_.insert(message.track_ids.begin(), message.track_ids.end());
  }

  std::map<std::string, Span> spans_;
  std::optional<std::int64_t> last_utime_us_;
  std::optional<std::uint64_t> last_sequence_;
  std::optional<double> last_angle_rad_;
  std::optional<std::string> last_settings_;
  std::set<std::int64_t> tracks_;
};

std::string utc(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm time{};
  if (::gmtime_r(&seconds, &time) == nullptr) return std::to_string(utime_us);
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", time);
}

}  // namespace

tl::expected<RecordingSummary, ipc::LogError> summarise_recording(const std::filesystem::path& path) {
  auto reader = ipc::EventLogReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  Summariser summariser;
  while (const auto event = reader->next()) summariser.add(*event);
  if (reader->events() == 0)
    return tl::unexpected(ipc::LogError{fmt::format("{}: it holds no LCM event", path.string())});
  summariser.summary.file_bytes = reader->file_bytes();
  summariser.summary.damage = reader->damage();
  return summariser.finish();
}

std::string recording_text(const std::string& name, const RecordingSummary& summary) {
  std::string text =
      fmt::format("{}: {:.1f} s, {} messages, {:.1f} MB, begun {}\n", name, summary.duration_s, summary.events,
                  1e-6 * static_cast<double>(summary.file_bytes), utc(summary.begin_utime_us));
  text += fmt::format("  {:<24} {:>9} {:>10} {:>10} {:>11}\n", "channel", "messages", "rate [Hz]", "size [MB]",
                      "longest gap");
  for (const auto& [channel, counts] : summary.channels) {
    text += fmt::format("  {:<24} {:>9} {:>10.2f} {:>10.2f} {:>9.2f} s\n", channel, counts.messages, counts.rate_hz,
                        1e-6 * static_cast<double>(counts.bytes), counts.longest_gap_s);
    if (counts.undecodable > 0) text += fmt::format("  {:>34} cannot be decoded\n", counts.undecodable);
  }
  text += fmt::format("  {:.2f} turns of the disk, {} answers and {} previews, {} stairways\n", summary.turns,
                      summary.answers, summary.previews, summary.stairways);
  if (summary.lost_scans > 0) text += fmt::format("  {} scans were lost\n", summary.lost_scans);
  text += summary.versions.empty() ? "  it does not tell its settings\n"
                                   : fmt::format("  made by stairwayd {}\n", fmt::join(summary.versions, ", then "));
  if (summary.settings_changes > 0)
    text += fmt::format("  the settings changed {} times; a replay uses the first\n", summary.settings_changes);
  if (summary.damage.is_any()) text += fmt::format("  damaged: {}\n", describe(summary.damage));
  return text;
}

std::string recording_json(const std::string& name, const RecordingSummary& summary) {
  Json channels = Json::object();
  for (const auto& [channel, counts] : summary.channels) {
    channels[channel] = {{"messages", counts.messages},
                         {"rate", counts.rate_hz},
                         {"bytes", counts.bytes},
                         {"longest_gap", counts.longest_gap_s},
                         {"undecodable", counts.undecodable}};
  }
  const ipc::LogDamage& damage = summary.damage;
  const Json object{{"source", name},
                    {"bytes", summary.file_bytes},
                    {"messages", summary.events},
                    {"begin_utime", summary.begin_utime_us},
                    {"duration", summary.duration_s},
                    {"channels", std::move(channels)},
                    {"turns", summary.turns},
                    {"answers", summary.answers},
                    {"previews", summary.previews},
                    {"stairways", summary.stairways},
                    {"lost_scans", summary.lost_scans},
                    {"versions", summary.versions},
                    {"settings_changes", summary.settings_changes},
                    {"damage",
                     {{"places", damage.places},
                      {"skipped_bytes", damage.skipped_bytes},
                      {"lost_events", damage.lost_events},
                      {"torn_bytes", damage.torn_bytes}}}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stairway::tools
