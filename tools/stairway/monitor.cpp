// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "ipc/lcm_bus.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/daemon_news.hpp"
#include "tools/stairway/interrupts.hpp"
#include "tools/stairway/live_view.hpp"
#include "tools/stairway/source.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kFirstPause = 500ms;  // between attempts to open the bus, doubled each time
constexpr auto kLongestPause = 8000ms;
constexpr auto kWait = 200ms;

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  bool first = false;
  bool lines = false;
  std::optional<double> timeout_s;
  std::string truth;
};

/// Who is told what is heard.
struct Hearer {
  std::function<void(const ipc::BusMessage&)> take;
  std::function<void(const std::string&)> tell;  ///< why nothing is heard
  std::function<bool()> has_enough;              ///< asked some times a second
};

tl::expected<std::unique_ptr<ipc::LcmBus>, ipc::BusError> listen(const ipc::BusOptions& options, const Hearer& hearer) {
  auto bus = ipc::LcmBus::open(options.url);
  if (!bus) return bus;
  const ipc::Channels channels(options.channel_prefix);
  for (const std::string& channel : {channels.stairways, channels.health}) {
    const auto subscribed = (*bus)->subscribe(channel, hearer.take);
    if (!subscribed) return tl::unexpected(subscribed.error());
  }
  return bus;
}

/// Listens until there is a reason to stop. A network that is not there yet is waited for.
class Listener {
 public:
  Listener(const ipc::BusOptions& options, std::optional<double> timeout_s, Hearer hearer)
      : options_(options), timeout_s_(timeout_s), hearer_(std::move(hearer)), start_(Clock::now()) {}

  void run() {
    while (!is_over()) {
      auto bus = listen(options_, hearer_);
      if (bus) {
        told_.clear();
        pause_ = kFirstPause;
        if (!receive(**bus)) return;
      } else {
        tell(bus.error().text + "; trying again");
        pause();
      }
    }
  }

 private:
  bool is_over() const {
    if (is_interrupted() || hearer_.has_enough()) return true;
    return timeout_s_ && std::chrono::duration<double>(Clock::now() - start_).count() >= *timeout_s_;
  }

  /// Answers whether to open the bus again.
  bool receive(ipc::Bus& bus) {
    while (!is_over()) {
      const auto handled = bus.handle(kWait);
      if (handled) continue;
      if (handled.error().fault == ipc::BusFault::Ended) return false;
      tell(handled.error().text);
      pause();
      return true;
    }
    return false;
  }

  void tell(const std::string& text) {
    if (text != told_) hearer_.tell(text);
    told_ = text;
  }

  void pause() {
    const auto end = Clock::now() + pause_;
    pause_ = std::min(2 * pause_, kLongestPause);
    while (Clock::now() < end && !is_over()) std::this_thread::sleep_for(50ms);
  }

  const ipc::BusOptions& options_;
  std::optional<double> timeout_s_;
  Hearer hearer_;
  Clock::time_point start_;
  std::string told_;
  std::chrono::milliseconds pause_ = kFirstPause;
};

int fail(const std::string& what, const ipc::BusOptions& bus) {
  report_error(
      fmt::format("{} from {}; is stairwayd running, with the same lcm.url and lcm.channel_prefix?", what, bus.url));
  return kExitFailed;
}

/// Shows the state on the whole terminal.
int watch(const ipc::BusOptions& bus, std::optional<double> timeout_s) {
  bool is_left = false, has_answer = false;
  {
    LiveView view(ipc::Channels(bus.channel_prefix), bus.url);
    const auto has_enough = [&] {
      view.refresh();
      is_left = is_left || view.is_left();
      return is_left;
    };
    Listener(bus, timeout_s,
             {[&](const ipc::BusMessage& message) { view.take(message); },
              [&](const std::string& trouble) { view.tell(trouble); }, has_enough})
        .run();
    has_answer = view.has_answer();
  }
  return is_left || is_interrupted() || has_answer ? kExitDone : fail("no answer", bus);
}

int run(const Arguments& arguments) {
  const auto loaded = load_settings(as_the_daemon(arguments.settings));
  if (!loaded) {
    report_error(loaded.error().text);
    return kExitUsage;
  }
  std::optional<std::vector<detect::Stairway>> truth;
  if (!arguments.truth.empty()) {
    auto scene = open_scene(arguments.truth);
    if (!scene) {
      report_error(scene.error().text);
      return kExitFailed;
    }
    truth = std::move(scene->truths);
  }
  catch_interrupts();
  const ipc::BusOptions& bus = loaded->settings.lcm;
  const bool wants_lines = arguments.lines || arguments.first || truth || arguments.format == Format::Json;
  if (!wants_lines && FullScreen::is_possible()) return watch(bus, arguments.timeout_s);
  DaemonNews news(ipc::Channels(bus.channel_prefix), arguments.format, std::move(truth));
  Listener(
      bus, arguments.timeout_s,
      {[&](const ipc::BusMessage& message) { news.take(message); }, [](const std::string& text) { report_error(text); },
       [&] { return arguments.first && news.has_stairway(); }})
      .run();
  news.report_damage();
  if (is_interrupted()) return kExitDone;
  if (arguments.first ? news.has_stairway() : news.has_answer()) return kExitDone;
  return fail(news.has_answer() ? "no stairway" : "nothing", bus);
}

}  // namespace

Action declare_monitor(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_flag("--first", arguments->first, "end after the first message with at least one stairway");
  command.add_flag("--lines", arguments->lines, "print line after line also on a terminal");
  command
      .add_option("--timeout", arguments->timeout_s,
                  "end after this time [s], with exit code 1 if no answer came, with --first: none with a stairway")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  command.add_option("--truth", arguments->truth, "print what is true in a simulated scene, and the differences")
      ->type_name("sim:SCENE");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "On a terminal the daemon's state fills the screen, kept up to date until q or Ctrl-C. Elsewhere, and with "
      "--lines,\n"
      "--first or --truth, stairways are printed as they come, and the state goes to stderr when it changes. JSON has "
      "a\n"
      "line for every message of health (once a second) and of stairways, with its channel.\n"
      "Examples:\n"
      "  stairway monitor\n"
      "  stairway monitor --first --timeout 120 --truth sim:straight-flight\n"
      "  stairway monitor --format json --config /etc/stairwayd/stairwayd.toml | jq 'select(.stairways)'\n"
      "  stairway monitor --format json | jq --unbuffered -r '.reasons[]?'\n"
      "Exit codes: 0 done, also by Ctrl-C; 1 nothing came; 2 wrong usage or settings.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
