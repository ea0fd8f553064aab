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
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/load_settings.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/stairwayd/hardware_source.hpp"
#include "tools/stairwayd/live_settings.hpp"
#include "tools/stairwayd/log.hpp"
#include "tools/stairwayd/pass_log.hpp"
#include "tools/stairwayd/patient_publisher.hpp"
#include "tools/stairwayd/pipeline.hpp"
#include "tools/stairwayd/service_notifier.hpp"
#include "tools/stairwayd/signals.hpp"
#include "tools/stairwayd/simulated_source.hpp"

namespace {

using namespace stairway;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;
constexpr int kBadSettings = 78;  // EX_CONFIG; the unit does not start the daemon again after it
constexpr auto kReportInterval = 1s;

constexpr const char* kFooter =
    "Settings: the defaults, then the file, then *.toml in the folder conf.d beside it in their order, then --set.\n"
    "Without --config the file is /etc/stairwayd/stairwayd.toml if it exists. SIGHUP reads them again.\n\n"
    "Exit codes: 0 ended by SIGTERM, SIGINT or --once; 1 failure; 2 wrong usage; 78 bad settings.\n\n"
    "Without --simulate it runs on the scanner (USB), the disk motor (CAN) and the encoder (GPIO) that the settings\n"
    "name, and waits for those that are missing; stairway doctor says what is wrong with them.\n\n"
    "Example: stairwayd --simulate=straight-flight --set simulate.speed=0 --once";

struct CommandLine {
  std::string config;
  std::vector<std::string> assignments;
  bool is_simulation = false;
  bool is_check = false;
  bool is_once = false;
};

config::SettingsSources settings_sources(const CommandLine& line) {
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
  daemon::log::set_up(settings.log.level);
  const daemon::ServiceNotifier notifier;
  daemon::LiveSettings live(settings);
  daemon::PatientPublisher bus(settings.lcm.url);
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    return bus.publish(channel, bytes);
  };
  daemon::PassLog pass_log;
  std::atomic<bool> is_answered = false;
  const auto on_pass = [&](const daemon::Pass& pass) {
    pass_log.add(pass);
    is_answered = is_answered || pass.is_sent;
    if (line.is_once) daemon::Signals::wake();
  };
  daemon::log::info(fmt::format("stairwayd {} starts", STAIRWAY_VERSION));
  daemon::Pipeline pipeline(settings, std::move(source), publish, on_pass);
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
      case daemon::Wakeup::Timeout:
        next_report = std::max(next_report + kReportInterval, Clock::now());
        notifier.send("STATUS=" + pipeline.report().state);
        if (pipeline.has_progressed()) notifier.send("WATCHDOG=1");
        break;
    }
  }
  notifier.send("STOPPING=1");
  const bool is_ended = pipeline.stop();
  bus.close();
  daemon::log::info("stopped");
  // Nobody wants the answer of the pass under way, and systemd does not wait for it.
  if (!is_ended) std::_Exit(kSuccess);
  return kSuccess;
}

int run(const CommandLine& line) {
  const auto loaded = config::load_settings(settings_sources(line));
  if (!loaded) return fail(kBadSettings, loaded.error().text);
  std::unique_ptr<daemon::MeasurementSource> source;
  try {
    if (line.is_simulation) {
      source = std::make_unique<daemon::SimulatedSource>(loaded->settings, utime_now_us());
    }
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
  try {
    if (!source) {
      source = std::make_unique<daemon::HardwareSource>(loaded->settings, daemon::hardware_ports(loaded->settings),
                                                        daemon::utime_of_monotonic_us);
    }
    return run(line, loaded->settings, signals, std::move(source));
  } catch (const std::exception& error) {
    // Caught so that the source is destroyed, which stops the disk.
    return fail(kFailure, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds stairways with a rotating laser scanner and sends their parameters over LCM.", "stairwayd");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("stairwayd ") + STAIRWAY_VERSION);
  CommandLine line;
  std::string scene;
  std::string log_level;
  app.add_option("--config", line.config, "Settings file")->type_name("FILE");
  app.add_option("--set", line.assignments, "One setting, e.g. detector.voxel_mm=10; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* simulate =
      app.add_option("--simulate", scene, "Run on a simulated robot, in a shipped scene or a scene file")
          ->type_name("[SCENE]")
          ->expected(0, 1);
  app.add_flag("--check-config", line.is_check, "Say whether the settings are in order, and exit");
  app.add_flag("--once", line.is_once, "Exit after the first sweep's answer has been sent");
  app.add_option("--log-level", log_level, "error, warning, info or debug")->type_name("LEVEL");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kWrongUsage;
  }
  line.is_simulation = simulate->count() > 0;
  if (!scene.empty()) line.assignments.push_back("simulate.scene=" + scene);
  if (!log_level.empty()) line.assignments.push_back("log.level=" + log_level);
  return run(line);
}
