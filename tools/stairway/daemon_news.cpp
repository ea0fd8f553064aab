// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/daemon_news.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "ipc/health_json.hpp"
#include "ipc/stairway_json.hpp"
#include "ipc/stairway_text.hpp"
#include "tools/stairway/truth_table.hpp"

namespace stairway::tools {
namespace {

using Json = nlohmann::ordered_json;

// The table of `stairway detect`, without its heading about a file and its points.
std::string table(const detect::Detection& detection) {
  const std::string text = ipc::detection_text("", 0, {}, detection);
  return text.substr(text.find('\n') + 1);
}

void print_of(const std::string& channel, const std::string& object) {
  print_json_line(fmt::format("{{\"channel\":{},{}", Json(channel).dump(), object.substr(1)));
}

std::string heading(const ipc::StairwaysMessage& message) {
  const std::size_t count = message.detection.stairways.size();
  return fmt::format("{} sweep {}{}: {} stairway{}\n", local_time(message.utime_us), message.sweep,
                     message.is_final ? "" : " (preview)", count == 0 ? "no" : std::to_string(count),
                     count == 1 ? "" : "s");
}

}  // namespace

std::string local_time(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm time{};
  if (::localtime_r(&seconds, &time) == nullptr) return std::to_string(utime_us);
  return fmt::format("{:%H:%M:%S}", time);
}

std::string answer_json(const ipc::StairwaysMessage& message) {
  Json detection = Json::parse(ipc::detection_json("", 0, {}, message.detection));
  for (std::size_t i = 0; i < detection["stairways"].size(); ++i)
    detection["stairways"][i]["track_id"] = i < message.track_ids.size() ? message.track_ids[i] : 0;
  const Json object{{"utime", message.utime_us},
                    {"sweep_start_utime", message.sweep_start_utime_us},
                    {"sweep", message.sweep},
                    {"is_final", message.is_final},
                    {"stairways", std::move(detection["stairways"])},
                    {"rejected", std::move(detection["rejected"])}};
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string health_text(const ipc::HealthMessage& health) {
  constexpr int kBar = 20;
  constexpr double kOldData_s = 2.0;
  const double progress = std::isfinite(health.sweep_progress) ? std::clamp(health.sweep_progress, 0.0, 1.0) : 0.0;
  const int done = static_cast<int>(std::lround(progress * kBar));
  std::string text = fmt::format("{}: sweep {} [{:#<{}}{:.<{}}] {:3.0f} %  {} points  scans {:.1f} Hz  disk {:.0f} Hz",
                                 health.state, health.sweep, "", done, "", kBar - done, 100.0 * progress, health.points,
                                 health.scan_rate_hz, health.disk_rate_hz);
  for (const ipc::DeviceHealth& device : health.devices) {
    if (device.data_age_s > kOldData_s) text += fmt::format("  {} silent for {:.0f} s", device.name, device.data_age_s);
  }
  if (health.clock.period_ms > 0.0) {
    text += fmt::format("  clock {:.2f} ms late {:.1f} ms", health.clock.period_ms, health.clock.delay_ms);
    if (health.clock.resets > 0) text += fmt::format(" set {} times", health.clock.resets);
  }
  for (const auto& [reason, count] : health.drops)
    if (count > 0) text += fmt::format("  {} {}", reason, count);
  return text;
}

DaemonNews::DaemonNews(ipc::Channels channels, Format format, std::optional<std::vector<detect::Stairway>> truth)
    : channels_(std::move(channels)), format_(format), truth_(std::move(truth)) {}

void DaemonNews::take(const ipc::BusMessage& message) {
  if (message.channel == channels_.stairways) {
    const auto decoded = ipc::decode<ipc::StairwaysMessage>(message.bytes);
    decoded ? take_answer(*decoded) : count_damage(message.channel, decoded.error());
  } else if (message.channel == channels_.health) {
    const auto decoded = ipc::decode<ipc::HealthMessage>(message.bytes);
    decoded ? take_health(*decoded) : count_damage(message.channel, decoded.error());
  }
}

void DaemonNews::take_answer(const ipc::StairwaysMessage& message) {
  ++answers_;
  if (!message.detection.stairways.empty()) ++stairways_;
  if (format_ == Format::Json) return print_of(channels_.stairways, answer_json(message));
  if (!is_news(message)) return;
  status_.clear();
  print(heading(message) + table(message.detection));
  if (truth_) print(truth_text(*truth_, message.detection.stairways));
  flush_output();
}

bool DaemonNews::is_news(const ipc::StairwaysMessage& message) {
  if (message.is_final) told_tracks_.clear();
  const std::size_t told = told_tracks_.size();
  told_tracks_.insert(message.track_ids.begin(), message.track_ids.end());
  return message.is_final || message.detection.stairways.empty() || told_tracks_.size() > told;
}

void DaemonNews::take_health(const ipc::HealthMessage& message) {
  if (format_ == Format::Json) return print_of(channels_.health, ipc::health_json(message));
  if (status_.is_visible()) {
    status_.show(health_text(message));
  } else if (!health_ || health_->state != message.state || health_->sweep != message.sweep) {
    tell(health_text(message));
  }
  health_ = message;
}

void DaemonNews::count_damage(std::string_view channel, ipc::MessageFault fault) {
  ++damaged_;
  if (std::find(told_faults_.begin(), told_faults_.end(), fault) != told_faults_.end()) return;
  told_faults_.push_back(fault);
  tell(fmt::format("a message on {} cannot be decoded: {}", channel, to_string(fault)));
}

void DaemonNews::report_damage() {
  if (damaged_ > 0) tell(fmt::format("{} messages could not be decoded", damaged_));
}

void DaemonNews::tell(const std::string& event) {
  status_.clear();
  report_error(event);
}

}  // namespace stairway::tools
