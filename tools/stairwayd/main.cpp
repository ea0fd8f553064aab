// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/load_settings.hpp"
#include "config/settings_table.hpp"
#include "ipc/message_codec.hpp"
#include "ipc/recording/recorder.hpp"
#include "tools/recording/recorded_measurements.hpp"
#include "tools/recording/recorded_previews.hpp"
#include "tools/recording/recorded_settings.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/stairwayd/bus_listener.hpp"
#include "tools/stairwayd/command_line.hpp"
#include "tools/stairwayd/hardware_source.hpp"
#include "tools/stairwayd/lcm_source.hpp"
#include "tools/stairwayd/live_settings.hpp"
#include "tools/stairwayd/log.hpp"
#include "tools/stairwayd/pass_log.hpp"
#include "tools/stairwayd/patient_publisher.hpp"
#include "tools/stairwayd/pipeline.hpp"
#include "tools/stairwayd/replay_source.hpp"
#include "tools/stairwayd/service_notifier.hpp"
#include "tools/stairwayd/signals.hpp"
#include "tools/stairwayd/simulated_source.hpp"
#include "tools/stairwayd/status_text.hpp"
#include "tools/stairwayd/withheld_channels.hpp"

namespace {

using namespace stairway;
using daemon::CommandLine;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;
constexpr int kBadSettings = 78;  // EX_CONFIG; the unit does not start the daemon again after it
constexpr auto kReportInterval = 1s;

config::SettingsSources settings_sources(const CommandLine& line) {
  // What this machine is set to does not concern a recording.
  if (!line.replay.empty() && line.config.empty()) return {{}, line.assignments};
  return {config::usual_files(line.config), line.assignments};
}

int fail(int exit_code, const std::string& text) {
  std::fputs(fmt::format("stairwayd: {}\n", text).c_str(), stderr);
  return exit_code;
}

std::int64_t utime_now_us() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
}

std::unique_ptr<ipc::Recorder> make_recorder(const config::Settings& settings) {
  if (settings.record.mode == ipc::RecordMode::Off) return nullptr;
  daemon::log::info(fmt::format("recordings go to {}", settings.record.folder));
  const ipc::Channels channels(settings.lcm.channel_prefix);
  auto recorder = std::make_unique<ipc::Recorder>(settings.record, channels);
  // Measurements begin before the pipeline tells the settings.
  const std::int64_t now_us = utime_now_us();
  recorder->add(channels.settings, encode(ipc::SettingsMessage{now_us, STAIRWAY_VERSION, config::to_toml(settings)}),
                now_us);
  return recorder;
}

void take_snapshot(ipc::Recorder* recorder) {
  if (recorder != nullptr && recorder->request_snapshot()) return daemon::log::info("writing a snapshot");
  daemon::log::warning("there is no snapshot to write; it takes record.mode = \"snapshot\"");
}

void note_recording(const ipc::Recorder* recorder, daemon::Pipeline& pipeline) {
  if (recorder == nullptr) return;
  const ipc::RecorderStatus status = recorder->status();
  if (!status.trouble.empty()) daemon::log::repeated_warning("recording", "not recording: " + status.trouble);
  pipeline.note_recording(status);
}

/// Null where nobody can send a command.
std::unique_ptr<daemon::BusListener> listen_for_commands(const config::Settings& settings, daemon::Pipeline& pipeline) {
  const std::string& url = settings.lcm.url;
  const bool is_network = url.starts_with("udpm://") || url.starts_with("tcpq://");
  if (!settings.command.listen || !is_network) return nullptr;
  const std::vector channels{ipc::Channels(settings.lcm.channel_prefix).command};
  return std::make_unique<daemon::BusListener>(url, channels, [&pipeline](const ipc::BusMessage& message) {
    auto command = ipc::decode<ipc::CommandMessage>(message.bytes);
    if (command) return pipeline.command(*command);
    daemon::log::repeated_warning("damaged command", fmt::format("a message on {} is no command: {}", message.channel,
                                                                 to_string(command.error())));
  });
}

void reload(const CommandLine& line, daemon::LiveSettings& live, daemon::Pipeline& pipeline) {
  const auto loaded = config::load_settings(settings_sources(line));
  if (!loaded) return daemon::log::error(fmt::format("settings kept: {}", loaded.error().text));
  for (const std::string& key : live.adopt(loaded->settings))
    daemon::log::warning(fmt::format("{} changes only with a restart", key));
  pipeline.set_detector_options(live.settings().detector);
  daemon::log::set_level(live.settings().log.level);
  daemon::log::info("settings read again");
}

int run(const CommandLine& line, const config::Settings& settings, const daemon::Signals& signals,
        std::unique_ptr<daemon::MeasurementSource> source) {
  const daemon::ServiceNotifier notifier;
  daemon::LiveSettings live(settings);
  daemon::PatientPublisher bus(settings.lcm.url);
  const auto recorder = make_recorder(settings);
  const std::set<std::string> withheld = daemon::withheld_channels(settings);
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    if (recorder) recorder->add(channel, bytes, utime_now_us());
    return withheld.contains(channel) || bus.publish(channel, bytes);
  };
  daemon::PassLog pass_log;
  std::atomic<bool> is_answered = false;
  const auto on_pass = [&](const daemon::Pass& pass) {
    pass_log.add(pass);
    is_answered = is_answered || (pass.is_sent && !pass.is_preview);
    if (line.is_once) daemon::Signals::wake();
  };
  daemon::log::info(fmt::format("stairwayd {} starts", STAIRWAY_VERSION));
  daemon::Pipeline pipeline(settings, std::move(source), publish, on_pass);
  const auto command_listener = listen_for_commands(settings, pipeline);
  // Ready means that messages go out; a boot should not wait for a scanner.
  notifier.send("READY=1");

  Clock::time_point next_report = Clock::now();
  for (bool is_running = true; is_running;) {
    switch (signals.wait_until(next_report)) {
      case daemon::Wakeup::Stop:
        is_running = false;
        break;
      case daemon::Wakeup::Reload:
        reload(line, live, pipeline);
        break;
      case daemon::Wakeup::Called:
        is_running = !(line.is_once && is_answered);
        break;
      case daemon::Wakeup::Snapshot:
        take_snapshot(recorder.get());
        break;
      case daemon::Wakeup::Timeout:
        is_running = !pipeline.has_ended();
        note_recording(recorder.get(), pipeline);
        pipeline.note_bus(bus.trouble());
        next_report = std::max(next_report + kReportInterval, Clock::now());
        notifier.send("STATUS=" + daemon::status_text(pipeline.report()));
        if (pipeline.has_progressed()) notifier.send("WATCHDOG=1");
        break;
    }
  }
  notifier.send("STOPPING=1");
  const bool is_ended = pipeline.stop();
  if (recorder) recorder->close();
  bus.close();
  daemon::log::info("stopped");
  // Nobody wants the answer of the pass under way, and systemd does not wait for it.
  if (!is_ended) std::_Exit(kSuccess);
  return kSuccess;
}

/// Puts the recording's settings in front of those of the command line.
tl::expected<tools::RecordingFacts, ipc::LogError> prepare_replay(CommandLine& line) {
  auto facts = tools::examine_recording(line.replay);
  if (!facts || !line.config.empty()) return facts;
  if (!facts->settings) {
    std::fputs(
        fmt::format("stairwayd: {}: it does not tell its settings; the defaults are used\n", line.replay).c_str(),
        stderr);
    return facts;
  }
  const tools::RecordedSettings recorded = tools::recorded_settings(facts->settings->toml);
  for (const std::string& key : recorded.unknown_keys)
    std::fputs(fmt::format("stairwayd: {}: this version has no setting {}\n", line.replay, key).c_str(), stderr);
  line.assignments.insert(line.assignments.begin(), recorded.assignments.begin(), recorded.assignments.end());
  return facts;
}

/// Those of the run, unless the settings want others than it did.
std::optional<std::vector<std::int64_t>> previews_of(const tools::RecordingFacts& facts, const std::string& path,
                                                     const config::Settings& settings) {
  const std::string toml = facts.settings ? facts.settings->toml : "";
  const auto recorded = config::load_settings({{}, tools::recorded_settings(toml).assignments});
  if (!recorded || recorded->settings.preview.every_s != settings.preview.every_s) return std::nullopt;
  return tools::recorded_previews(path, facts.channel_prefix);
}

/// Of the kinds that need no check of their own.
std::unique_ptr<daemon::MeasurementSource> make_source(const config::Settings& settings) {
  if (settings.source.kind == config::SourceKind::Lcm)
    return std::make_unique<daemon::LcmSource>(settings.source.bus(settings.lcm));
  if (const std::string warning = drivers::speed_warning(settings.motor, settings.disk.speed_rad_s()); !warning.empty())
    daemon::log::warning("disk motor: " + warning);
  return std::make_unique<daemon::HardwareSource>(settings, daemon::hardware_ports(settings),
                                                  daemon::utime_of_monotonic_us);
}

int run(CommandLine line) {
  std::optional<tools::RecordingFacts> recording;
  if (!line.replay.empty()) {
    auto facts = prepare_replay(line);
    if (!facts) return fail(kFailure, facts.error().text);
    recording = std::move(*facts);
    // Whatever else the settings name is not asked.
    line.assignments.push_back("source.kind=hardware");
  }
  const auto loaded = config::load_settings(settings_sources(line));
  if (!loaded) return fail(kBadSettings, loaded.error().text);
  const config::Settings& settings = loaded->settings;
  std::unique_ptr<daemon::MeasurementSource> source;
  if (recording) {
    auto replay = daemon::ReplaySource::open(line.replay, *recording, settings.replay.speed,
                                             previews_of(*recording, line.replay, settings));
    if (!replay) return fail(kFailure, replay.error().text);
    source = std::move(*replay);
  }
  try {
    if (settings.source.kind == config::SourceKind::Simulate)
      source = std::make_unique<daemon::SimulatedSource>(settings, utime_now_us());
  } catch (const sim::SceneFileError& error) {
    return fail(kBadSettings, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(kBadSettings, error.what());
  }
  if (line.is_check) {
    std::puts("the settings are in order");
    return kSuccess;
  }
  // Before the hardware: a port may start a thread, and a signal that reaches it would end the process at once.
  const daemon::Signals signals;
  daemon::log::set_up(settings.log.level);
  try {
    if (!source) source = make_source(settings);
    return run(line, settings, signals, std::move(source));
  } catch (const std::exception& error) {
    // Caught so that the source is destroyed, which stops the disk.
    return fail(kFailure, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app;
  daemon::CommandLine line;
  daemon::declare_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kWrongUsage;
  }
  return run(std::move(line));
}
