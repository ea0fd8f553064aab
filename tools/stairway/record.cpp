// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "ipc/lcm_bus.hpp"
#include "ipc/recording/recorder.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/interrupts.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kPause = 1000ms;  // between attempts to open the bus
constexpr auto kWait = 100ms;

struct Arguments {
  SettingsArguments settings;
  std::string folder = ".";
  std::optional<int> max_file_mb, max_total_mb, snapshot_sweeps;
  std::optional<double> max_file_s;
  std::optional<double> duration_s;
  bool raw = false;
};

volatile std::sig_atomic_t is_snapshot_wanted = 0;

/// The settings' record section, with what the command line says.
ipc::RecordOptions record_options(const Arguments& arguments, ipc::RecordOptions options) {
  options.folder = arguments.folder;
  options.mode = arguments.snapshot_sweeps ? ipc::RecordMode::Snapshot : ipc::RecordMode::Continuous;
  options.raw = options.raw || arguments.raw;
  options.max_file_mb = arguments.max_file_mb.value_or(options.max_file_mb);
  options.max_file_s = arguments.max_file_s.value_or(options.max_file_s);
  options.max_total_mb = arguments.max_total_mb.value_or(options.max_total_mb);
  options.snapshot_sweeps = arguments.snapshot_sweeps.value_or(options.snapshot_sweeps);
  return options;
}

class Recording {
 public:
  Recording(const Arguments& arguments, const ipc::RecordOptions& options, const ipc::BusOptions& bus)
      : arguments_(arguments), bus_(bus), recorder_(options, ipc::Channels(bus.channel_prefix)), start_(Clock::now()) {}

  int run() {
    while (!is_over() && !has_ended_) {
      auto bus = listen();
      if (bus) {
        receive(**bus);
      } else {
        tell(bus.error().text + "; trying again");
        for (const auto end = Clock::now() + kPause; Clock::now() < end && !is_over();)
          std::this_thread::sleep_for(kWait);
      }
    }
    recorder_.request_snapshot();
    recorder_.close();
    return answer();
  }

 private:
  tl::expected<std::unique_ptr<ipc::LcmBus>, ipc::BusError> listen() {
    auto bus = ipc::LcmBus::open(bus_.url);
    if (!bus) return bus;
    const auto subscribed = (*bus)->subscribe(bus_.channel_prefix + ".*", [this](const ipc::BusMessage& message) {
      recorder_.add(message.channel, message.bytes, message.arrival_utime_us);
    });
    if (!subscribed) return tl::unexpected(subscribed.error());
    return bus;
  }

  void receive(ipc::Bus& bus) {
    while (!is_over()) {
      if (const auto handled = bus.handle(kWait); !handled) {
        has_ended_ = handled.error().fault == ipc::BusFault::Ended;
        if (!has_ended_) tell(handled.error().text);
        return;
      }
      if (is_snapshot_wanted) {
        is_snapshot_wanted = 0;
        recorder_.request_snapshot();
      }
      show();
    }
  }

  bool is_over() const {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    return is_interrupted() || (arguments_.duration_s && elapsed_s >= *arguments_.duration_s);
  }

  void show() {
    const ipc::RecorderStatus status = recorder_.status();
    if (!status.trouble.empty()) tell("not recording: " + status.trouble);
    status_.show(text(status));
  }

  std::string text(const ipc::RecorderStatus& status) const {
    std::string text =
        arguments_.snapshot_sweeps
            ? fmt::format("{} messages kept, {} snapshots written", status.events, status.snapshots)
            : fmt::format("{} messages, {:.1f} MB", status.events, 1e-6 * static_cast<double>(status.bytes));
    if (!status.file.empty()) text += ", " + status.file.string();
    if (status.lost_events > 0) text += fmt::format(", {} messages lost", status.lost_events);
    return text;
  }

  void tell(const std::string& what) {
    if (what == told_) return;
    status_.clear();
    report_error(what);
    told_ = what;
  }

  int answer() {
    status_.clear();
    const ipc::RecorderStatus status = recorder_.status();
    print(text(status) + '\n');
    if (!status.trouble.empty()) tell(status.trouble);
    if (status.bytes > 0 && status.lost_events == 0 && status.trouble.empty()) return kExitDone;
    if (status.bytes == 0)
      report_error(fmt::format("nothing from {}; is stairwayd running, with the same lcm.url and lcm.channel_prefix?",
                               bus_.url));
    return kExitFailed;
  }

  const Arguments& arguments_;
  const ipc::BusOptions bus_;
  ipc::Recorder recorder_;
  const Clock::time_point start_;
  bool has_ended_ = false;
  std::string told_;
  StatusLine status_;
};

int run(const Arguments& arguments) {
  const auto loaded = load_settings(as_the_daemon(arguments.settings));
  const std::string problem =
      loaded ? record_options(arguments, loaded->settings.record).problem() : loaded.error().text;
  if (!problem.empty()) {
    report_error(problem);
    return kExitUsage;
  }
  catch_interrupts();
  std::signal(SIGUSR2, [](int) { is_snapshot_wanted = 1; });
  return Recording(arguments, record_options(arguments, loaded->settings.record), loaded->settings.lcm).run();
}

}  // namespace

Action declare_record(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("--folder", arguments->folder, "where the files go; the current folder if not given")
      ->type_name("FOLDER");
  command.add_option("--max-file-mb", arguments->max_file_mb, "begin a new file at this size")
      ->type_name("MB")
      ->check(CLI::Range(1, 100000).description(""));
  command.add_option("--max-file-s", arguments->max_file_s, "begin a new file at this age [s]")
      ->type_name("S")
      ->check(CLI::PositiveNumber.description(""));
  command
      .add_option("--max-total-mb", arguments->max_total_mb, "remove the oldest recordings of the folder above this")
      ->type_name("MB")
      ->check(CLI::Range(1, 1000000).description(""));
  command
      .add_option("--snapshot", arguments->snapshot_sweeps,
                  "keep the last N sweeps in memory and write them on SIGUSR2 and at the end")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""));
  command.add_flag("--raw", arguments->raw, "the bytes of the devices too, if they are sent");
  command.add_option("--duration", arguments->duration_s, "end after this time [s]")
      ->type_name("S")
      ->check(CLI::PositiveNumber.description(""));
  add_settings_options(command, arguments->settings);
  command.footer(
      "Records every channel whose name begins with lcm.channel_prefix, until Ctrl-C. The files are plain LCM logs;\n"
      "limits that are not given are those of the record settings. A recording made by the daemon itself\n"
      "(record.mode) misses nothing; this one may, where the network loses messages.\n"
      "Examples:\n"
      "  stairway record --folder /tmp --duration 120\n"
      "  stairway record --max-file-mb 100 --max-total-mb 1000\n"
      "  stairway record --snapshot 3 & ... kill -USR2 %1\n"
      "Exit codes: 0 done, also by Ctrl-C; 1 nothing came, or messages could not be written; 2 wrong usage or\n"
      "settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
