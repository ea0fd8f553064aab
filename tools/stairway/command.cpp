// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/interrupts.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
using ipc::CommandAckMessage;
using ipc::CommandAction;
using ipc::CommandResult;

constexpr auto kRepeat = 500ms;  // a message may be lost
constexpr auto kWait = 100ms;
constexpr double kRadianPerDegree = std::numbers::pi / 180.0;
constexpr const char* kActions[] = {"start", "stop", "single", "speed"};  // as CommandAction

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  std::string action;
  std::optional<double> speed_deg_s;
  double timeout_s = 5.0;
};

ipc::CommandMessage command_of(const Arguments& arguments) {
  std::random_device random;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  ipc::CommandMessage command;
  command.utime_us = std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
  command.id = static_cast<std::int64_t>((std::uint64_t{random()} << 31) ^ random());
  const auto place = std::ranges::find(kActions, arguments.action) - std::begin(kActions);
  command.action = static_cast<CommandAction>(place);
  command.speed_rad_s = arguments.speed_deg_s.value_or(0.0) * kRadianPerDegree;
  return command;
}

/// Sends until an answer comes. That of a daemon which has no disk is kept while another one may answer.
std::optional<CommandAckMessage> ask(ipc::Bus& bus, const ipc::Channels& channels, const ipc::CommandMessage& command,
                                     double timeout_s) {
  std::optional<CommandAckMessage> answer;
  const auto is_settled = [&] { return answer && answer->result != CommandResult::WrongSource; };
  const auto take = [&](const ipc::BusMessage& message) {
    auto ack = ipc::decode<CommandAckMessage>(message.bytes);
    if (ack && ack->id == command.id && !is_settled()) answer = std::move(*ack);
  };
  if (const auto subscribed = bus.subscribe(channels.command_ack, take); !subscribed) {
    report_error(subscribed.error().text);
    return std::nullopt;
  }
  const ipc::Bytes bytes = ipc::encode(command);
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
  for (auto next = Clock::now(); !is_settled() && Clock::now() < end && !is_interrupted();) {
    if (Clock::now() >= next) {
      next += kRepeat;
      if (const auto sent = bus.publish(channels.command, bytes); !sent) report_error(sent.error().text);
    }
    if (const auto handled = bus.handle(kWait); !handled) {
      report_error(handled.error().text);
      break;
    }
  }
  return answer;
}

const char* describe(CommandResult result) {
  switch (result) {
    case CommandResult::Accepted:
      return "accepted";
    case CommandResult::BadValue:
      return "bad-value";
    case CommandResult::WrongSource:
      return "wrong-source";
    case CommandResult::TooOld:
      break;
  }
  return "too-old";
}

void print_answer(const CommandAckMessage& answer, Format format) {
  if (format == Format::Text) return print(fmt::format("{}: {}\n", describe(answer.result), answer.text));
  constexpr const char* kModes[] = {"continuous", "single", "idle"};  // as DiskMode
  const nlohmann::ordered_json object{{"result", describe(answer.result)},
                                      {"text", answer.text},
                                      {"mode", kModes[static_cast<int>(answer.mode)]},
                                      {"speed_deg_s", answer.speed_rad_s / kRadianPerDegree}};
  print_json_line(object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int run(const Arguments& arguments) {
  if ((arguments.action == "speed") != arguments.speed_deg_s.has_value()) {
    report_error("speed takes a number in deg/s, the others none");
    return kExitUsage;
  }
  const auto loaded = load_settings(arguments.settings);
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
  const ipc::Channels channels(loaded->settings.lcm.channel_prefix);
  const auto answer = ask(**bus, channels, command_of(arguments), arguments.timeout_s);
  if (!answer) {
    report_error(
        fmt::format("no answer within {:g} s: does stairwayd run, with command.listen, and are lcm.url and "
                    "lcm.channel_prefix the same?",
                    arguments.timeout_s));
    return kExitFailed;
  }
  print_answer(*answer, arguments.format);
  return answer->result == CommandResult::Accepted ? kExitDone : kExitFailed;
}

}  // namespace

Action declare_command(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("ACTION", arguments->action, "start, stop, single or speed")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"start", "stop", "single", "speed"}).description(""));
  command.add_option("DEG_S", arguments->speed_deg_s, "of the disk, negative clockwise seen from above")->type_name("");
  command.add_option("--timeout", arguments->timeout_s, "wait at most so long for the answer [s]")
      ->type_name("S")
      ->check(CLI::Range(0.1, 3600.0).description(""));
  add_format_option(command, arguments->format);
  add_settings_options(command, arguments->settings);
  command.footer(
      "Tells a running stairwayd over LCM what its disk shall do, and prints its answer. start: sweep after sweep.\n"
      "stop: the disk stops, the motor is off, nothing is measured. single: sweeps until one of a whole turn is\n"
      "complete, then as stop; at most two turns. speed: of the disk, at once or when it turns again.\n"
      "Examples:\n"
      "  stairway command single\n"
      "  stairway command speed 20\n"
      "  stairway command speed -- -20\n"
      "Exit codes: 0 accepted; 1 refused, or no answer; 2 wrong usage or settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
