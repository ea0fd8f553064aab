// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <utility>

#include "drivers/can/socket_can_port.hpp"
#include "drivers/gpio/encoder_lines.hpp"
#include "drivers/host_clock.hpp"
#include "drivers/usb/usb_scanner_opener.hpp"
#include "tools/doctor/examination.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/verbs.hpp"

namespace stairway::tools {
namespace {

struct Arguments {
  SettingsArguments settings;
  Format format = Format::Text;
  bool is_probing = false;
};

doctor::Check judge_settings(const std::vector<std::string>& files,
                             const tl::expected<config::LoadedSettings, config::SettingsError>& loaded) {
  constexpr const char* kName = "settings";
  if (!loaded) {
    return doctor::failure(kName, loaded.error().text, "mend it; what follows is looked at with the defaults");
  }
  if (files.empty()) return doctor::ok(kName, "in order: no file, the defaults");
  return doctor::ok(kName, fmt::format("in order: {}", fmt::join(files, ", ")));
}

bool has_encoder(const config::Settings& settings) {
  return settings.disk.angle_source == drivers::AngleSource::Encoder;
}

doctor::Robot robot_of(const config::Settings& settings) {
  doctor::Robot robot{.scanner = {.serial = settings.lidar.serial, .port = settings.usb.port},
                      .lidar = settings.lidar,
                      .can_interface = settings.motor.interface,
                      .drive_node = settings.motor.node_id,
                      .encoder = {},
                      .disk_speed_rad_s = settings.disk.speed_rad_s(),
                      .lcm = settings.lcm};
  if (has_encoder(settings)) robot.encoder = settings.encoder;
  return robot;
}

doctor::Ports ports_of(const config::Settings& settings) {
  const drivers::SocketCanOptions can{.interface = settings.motor.interface,
                                      .node_id = settings.motor.node_id,
                                      .host_node_id = settings.motor.host_node_id,
                                      .hears_everybody = true};
  doctor::Ports ports;
  ports.scanner = drivers::usb_scanner_opener(settings.usb, settings.lidar.serial);
  ports.can = [can] { return drivers::open_socket_can(can); };
  if (has_encoder(settings)) ports.encoder = [&settings] { return drivers::open_encoder_lines(settings.encoder); };
  ports.now = drivers::monotonic_now_ns;
  return ports;
}

int run(const Arguments& arguments) {
  const SettingsArguments sources = as_the_daemon(arguments.settings);
  const auto loaded = load_settings(sources);
  const config::Settings settings = loaded ? loaded->settings : config::Settings{};
  std::vector<doctor::Check> checks{judge_settings(sources.files, loaded)};
  StatusLine status;
  status.show("looking at everything, this takes some seconds ...");
  auto more = doctor::examine(doctor::Machine(), robot_of(settings), ports_of(settings), {}, arguments.is_probing);
  std::move(more.begin(), more.end(), std::back_inserter(checks));
  status.clear();
  if (arguments.format == Format::Json) {
    print_json_line(doctor::to_json(checks));
  } else {
    print(doctor::to_text(checks));
  }
  return doctor::exit_code(checks);
}

}  // namespace

Action declare_doctor(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_flag("--probe", arguments->is_probing,
                   "ask the scanner even while stairwayd is running, and send the drive a question instead of only "
                   "listening");
  add_settings_options(command, arguments->settings);
  add_format_option(command, arguments->format);
  command.footer(
      "Looks at settings, installation, LCM, scanner, CAN and encoder, and says what to do. Without --config the\n"
      "settings are those of stairwayd. While stairwayd is running its devices are left to it.\n"
      "Examples:\n"
      "  stairway doctor\n"
      "  stairway doctor --config robot.toml --probe\n"
      "  stairway doctor --format json | jq '.checks[] | select(.state != \"ok\")'\n"
      "Exit codes: 0 all is well; 1 there are warnings; 2 there are failures, or wrong usage.");
  return [arguments] { return run(*arguments); };
}

}  // namespace stairway::tools
