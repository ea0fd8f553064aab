// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/command_line.hpp"

#include <CLI/CLI.hpp>
#include <memory>

namespace stairway::daemon {
namespace {

constexpr const char* kFooter =
    "Settings: the defaults, then the file, then *.toml in the folder conf.d beside it in their order, then --set.\n"
    "Without --config the file is /etc/stairwayd/stairwayd.toml if it exists. SIGHUP reads them again.\n\n"
    "A recording is replayed with its own mount, sweep, detector and previews, or with --config's; --set changes\n"
    "either. The daemon ends with it. SIGUSR2 writes a snapshot of the last sweeps (record.mode = \"snapshot\").\n\n"
    "The source hardware is the scanner (USB), the disk motor (CAN) and the encoder (GPIO) that the settings name; it\n"
    "waits for those that are missing, and stairway doctor says what is wrong with them. The source lcm takes the\n"
    "scans and disk angles of another process, of `stairway replay` or of lcm-logplayer (source.lcm_url).\n\n"
    "Exit codes: 0 ended by SIGTERM, SIGINT, --once or the end of a recording; 1 failure; 2 wrong usage; 78 bad\n"
    "settings.\n\n"
    "Examples:\n"
    "  stairwayd --simulate=straight-flight --set simulate.speed=0 --once\n"
    "  stairwayd --source lcm --set source.lcm_channel_prefix=FRONT_\n"
    "  stairwayd --replay stairway-000012.lcm --set replay.speed=0 --set detector.voxel_mm=20";

// Texts that become settings.
struct Shorthands {
  std::string source;
  std::string scene;
  std::string log_level;
};

}  // namespace

void declare_options(CLI::App& app, CommandLine& line) {
  const auto shorthands = std::make_shared<Shorthands>();
  app.name("stairwayd");
  app.description("Finds stairways with a rotating laser scanner and sends their parameters over LCM.");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("stairwayd ") + STAIRWAY_VERSION);
  app.add_option("--config", line.config, "Settings file")->type_name("FILE");
  app.add_option("--set", line.assignments, "One setting, e.g. detector.voxel_mm=10; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* source = app.add_option("--source", shorthands->source, "Where measurements come from (source.kind)")
                            ->type_name("hardware|simulate|lcm")
                            ->check(CLI::IsMember({"hardware", "simulate", "lcm"}).description(""));
  CLI::Option* simulate =
      app.add_option("--simulate", shorthands->scene, "Run on a simulated robot, in a shipped scene or a scene file")
          ->type_name("[SCENE]")
          ->expected(0, 1)
          ->excludes(source);
  app.add_option("--replay", line.replay, "Play a recording instead, as fast as replay.speed says")
      ->type_name("FILE")
      ->excludes(simulate)
      ->excludes(source);
  app.add_flag("--check-config", line.is_check, "Say whether the settings are in order, and exit");
  app.add_flag("--once", line.is_once, "Exit after the first sweep's answer has been sent");
  app.add_option("--log-level", shorthands->log_level, "error, warning, info or debug")->type_name("LEVEL");
  app.callback([shorthands, simulate, &line] {
    if (simulate->count() > 0) shorthands->source = "simulate";
    if (!shorthands->source.empty()) line.assignments.push_back("source.kind=" + shorthands->source);
    if (!shorthands->scene.empty()) line.assignments.push_back("simulate.scene=" + shorthands->scene);
    if (!shorthands->log_level.empty()) line.assignments.push_back("log.level=" + shorthands->log_level);
  });
}

}  // namespace stairway::daemon
