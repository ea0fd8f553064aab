// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <thread>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/interrupts.hpp"
#include "tools/stairway/keyboard.hpp"
#include "tools/stairway/playback_schedule.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kWait = 100ms;  // how long a signal may go unseen

struct Arguments {
  SettingsArguments settings;
  std::string file;
  std::string channels = ".*";
  double rate = 1.0;
  double from_s = 0.0;
  bool loop = false;
  bool paused = false;
};

/// Sends the messages of a file again, each at its time.
class Player {
 public:
  Player(const Arguments& arguments, ipc::Bus& bus) : arguments_(arguments), bus_(bus), wanted_(arguments.channels) {}

  /// One way through the file; answers the error, if there is one.
  std::optional<std::string> play() {
    auto reader = ipc::EventLogReader::open(arguments_.file);
    if (!reader) return reader.error().text;
    PlaybackSchedule schedule(arguments_.rate);
    if (arguments_.paused && sent_ == 0) schedule.pause(Clock::now());
    std::optional<std::int64_t> begin_utime_us;
    while (const auto event = reader->next()) {
      if (!begin_utime_us) begin_utime_us = event->utime_us;
      const double age_s = 1e-6 * static_cast<double>(event->utime_us - *begin_utime_us);
      // What a listener needs to understand the rest is not skipped.
      const bool is_early = age_s < arguments_.from_s && !event->channel.ends_with(ipc::kSettingsChannelName);
      if (is_early || !std::regex_match(event->channel.begin(), event->channel.end(), wanted_)) continue;
      schedule.next(event->utime_us, Clock::now());
      wait_until_due(schedule, age_s);
      if (is_over()) break;
      if (const auto sent = bus_.publish(std::string(event->channel), event->bytes); !sent) return sent.error().text;
      ++sent_;
    }
    status_.clear();
    if (const std::string damage = describe(reader->damage()); !damage.empty())
      report_error(fmt::format("{}: {}", arguments_.file, damage));
    return std::nullopt;
  }

  bool is_over() const { return is_quit_ || is_interrupted(); }
  std::uint64_t sent() const { return sent_; }
  bool is_stuck() const { return is_stuck_; }

 private:
  void wait_until_due(PlaybackSchedule& schedule, double age_s) {
    for (auto now = Clock::now(); !schedule.is_due(now) && !is_over(); now = Clock::now()) {
      status_.show(fmt::format("{}: {:.1f} s{}  (space: pause and go on, s: one message, q: quit)", arguments_.file,
                               age_s, schedule.is_paused() ? ", paused" : ""));
      const auto wait = std::min<Clock::duration>(schedule.left(now), kWait);
      const auto key = keyboard_.wait(std::chrono::ceil<std::chrono::milliseconds>(wait));
      if (key) obey(*key, schedule);
      if (schedule.is_paused() && keyboard_.is_closed()) is_quit_ = is_stuck_ = true;
    }
  }

  void obey(char key, PlaybackSchedule& schedule) {
    const auto now = Clock::now();
    if (key == ' ' || key == '\n') schedule.is_paused() ? schedule.resume(now) : schedule.pause(now);
    if (key == 's') schedule.step();
    if (key == 'q') is_quit_ = true;
  }

  const Arguments& arguments_;
  ipc::Bus& bus_;
  const std::regex wanted_;
  Keyboard keyboard_;
  StatusLine status_;
  std::uint64_t sent_ = 0;
  bool is_quit_ = false;
  bool is_stuck_ = false;
};

int run(const Arguments& arguments) {
  const auto loaded = load_settings(as_the_daemon(arguments.settings));
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  const auto bus = ipc::LcmBus::open(loaded->settings.lcm.url);
  if (!bus) {
    report_error(bus.error().text);
    return kExitFailed;
  }
  catch_interrupts();
  Player player(arguments, **bus);
  do {
    const std::uint64_t before = player.sent();
    if (const auto failure = player.play()) {
      report_error(*failure);
      return kExitFailed;
    }
    if (player.sent() == before) break;
  } while (arguments.loop && !player.is_over());
  if (player.is_stuck()) {
    report_error("paused, and no key can come from standard input");
    return kExitUsage;
  }
  print(fmt::format("{} messages sent\n", player.sent()));
  if (player.sent() > 0 || player.is_over()) return kExitDone;
  report_error(fmt::format("{}: it holds no message that was asked for", arguments.file));
  return kExitFailed;
}

std::string regex_problem(const std::string& pattern) {
  try {
    const std::regex parsed(pattern);
    return {};
  } catch (const std::regex_error& error) {
    return fmt::format("{} is no regular expression: {}", pattern, error.what());
  }
}

}  // namespace

Action declare_replay(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("FILE", arguments->file, "recording, or any LCM log")->required()->type_name("");
  command.add_option("--rate", arguments->rate, "recorded seconds per second; 0 is as fast as possible")
      ->type_name("R")
      ->check(CLI::Range(0.0, 1000.0).description(""));
  command.add_option("--from", arguments->from_s, "leave out the messages before this time from the beginning [s]")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber.description(""));
  command.add_option("--channels", arguments->channels, "only those whose whole name matches this regular expression")
      ->type_name("REGEX")
      ->check(regex_problem);
  command.add_flag("--loop", arguments->loop, "begin again at the end");
  command.add_flag("--paused", arguments->paused, "wait for the space key before the first message");
  add_settings_options(command, arguments->settings);
  command.footer(
      "Sends the messages again on LCM as they were recorded (lcm.url), so that subscribers see the robot of then. On\n"
      "a terminal, space pauses and goes on, s sends one message, q quits. To look for stairways once more use\n"
      "stairwayd --replay FILE or stairway detect FILE.\n"
      "Examples:\n"
      "  stairway replay stairway-000012.lcm --rate 4 --loop\n"
      "  stairway replay stairway-000012.lcm --channels 'STAIRWAY_(SCAN|ANGLES)' --from 30\n"
      "Exit codes: 0 done, also by q or Ctrl-C; 1 the file could not be read, or nothing sent; 2 wrong usage or\n"
      "settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
