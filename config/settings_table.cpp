// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/settings_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "config/section.hpp"

namespace stairway::config {
namespace {

void add_lidar_settings(std::vector<Entry>& table, drivers::ScipOptions& lidar, drivers::UsbOptions& usb,
                        drivers::SyncInputOptions& sync) {
  Section(table, "lidar")
      .text("usb_serial", lidar.serial, "serial number of the wanted unit, as on its label; empty is any")
      .text("usb_port", usb.port, "where it is plugged in, e.g. 1-2.3; empty is anywhere")
      .real("min_angle", lidar.min_angle_rad, kDegree, {-180, 180}, "right end of the scan window, 0 is the front beam")
      .real("max_angle", lidar.max_angle_rad, kDegree, {-180, 180}, "left end of the scan window")
      .whole("cluster", lidar.cluster, 1, 99, "neighbouring beams that share their smallest range")
      .whole("skip_scan", lidar.skip_scan, 0, 9, "mirror turns left out between two scans")
      .on_off("intensities", lidar.intensities, "strengths of the echoes too; not at full field and rate")
      .on_off("force_intensities", lidar.force_intensities, "even where they may crash the scanner")
      .choice("stamp_reference", lidar.stamp_reference, {"rear", "step0"},
              "where the beam points at the stamped instant")
      .real("min_latency", lidar.clock.minimum_latency_ns, kMillisecondOfNanoseconds, {0, 1000},
            "from the stamped instant to the first byte at the host")
      .choice("clock_source", lidar.clock_source, {"passive", "tm"},
              "tm: measure min_latency by the scanner's clock when it is opened, where its answers are fast enough")
      .whole("time_readings", lidar.time_readings, 1, 100, "round trips for that; the shortest counts")
      .real("max_round_trip", lidar.max_round_trip_s, kMillisecondOfSeconds, {0.1, 100},
            "a longer shortest one is not believed")
      .text("sync_chip", sync.chip, "GPIO chip that the scanner's sync pulses are wired to; empty without")
      .text("sync_line", sync.line, "line of that chip, by number or name; empty without")
      .real("sync_offset", lidar.sync_offset_ns, kMillisecondOfNanoseconds, {-25, 25},
            "from the rear-pointing beam to the sync pulse; not documented, the health report tells its error")
      .real("clock_window", lidar.clock.window_s, kSecond, {0.5, 60}, "scans that share one fit of the scanner's clock")
      .real("max_clock_gap", lidar.clock.max_gap_s, kSecond, {0.1, 10}, "a longer gap starts the fit anew")
      .real("max_clock_step", lidar.clock.max_step_ns, kMillisecondOfNanoseconds, {0.1, 1000},
            "a larger jump of the arrivals starts the fit anew");
  Section(table, "lidar.timing")
      .real("drain_silence", lidar.drain_silence_s, kSecond, {0.03, 2}, "silence that ends a drain")
      .real("max_drain", lidar.max_drain_s, kSecond, {0, 10}, "longest drain before the first command")
      .real("command_timeout", lidar.command_timeout_s, kSecond, {0.14, 10}, "wait for a reply")
      .whole("command_attempts", lidar.command_attempts, 1, 10, "sendings of one command")
      .whole("laser_attempts", lidar.laser_attempts, 1, 60, "attempts to switch the laser on after power-up")
      .real("laser_retry", lidar.laser_retry_s, kSecond, {0.1, 10}, "pause between them")
      .real("watchdog_margin", lidar.watchdog_margin_s, kSecond, {0.01, 10},
            "a scan is missing after three scan periods and this")
      .real("self_check", lidar.self_check_s, kSecond, {0.1, 60}, "longest pause for the scanner's own check")
      .whole("restarts_before_reopen", lidar.restarts_before_reopen, 1, 100,
             "failures in a row until the port is opened again")
      .real("min_backoff", lidar.min_backoff_s, kSecond, {0.01, 60},
            "pause before opening it again, doubled by failures")
      .real("max_backoff", lidar.max_backoff_s, kSecond, {0.01, 600}, "longest such pause");
}

void add_disk_settings(std::vector<Entry>& table, drivers::DiskOptions& disk) {
  Section(table, "disk")
      .real("period", disk.period_s, kSecond, {-600, 600}, "one turn; negative is clockwise, seen from above")
      .choice("mode", disk.mode, {"continuous", "single", "idle"},
              "after the start: sweep after sweep, one whole sweep, or at rest with the motor off; commands change it")
      .choice("angle_source", disk.angle_source, {"encoder", "drive"},
              "whose angles place the beams; drive is for a robot without an encoder, and for a drive that keeps its "
              "position "
              "without power")
      .real("drive_zero", disk.drive_zero_rad, kDegree, {-180, 180},
            "the drive's angle where the disk's is 0; with the drive as angle source the cloud is turned by its error")
      .real("idle_after", disk.idle_after_s, kSecond, {0, 86400},
            "how long the disk goes on turning without scans or encoder")
      .real("check_speed", disk.check_speed_rad_s, kDegreePerSecond, {0.1, 500}, "of the self check before it turns")
      .real("check_window", disk.check_window_s, kSecond, {0.1, 60},
            "over which speeds are compared; the encoder should count ten at least")
      .real("settle", disk.settle_s, kSecond, {0, 60}, "a speed is left alone for so long after its ramp")
      .real("check_tolerance", disk.check_tolerance, kPlain, {0.01, 0.9},
            "share by which command, drive and encoder may differ in the self check")
      .real("slip_tolerance", disk.slip_tolerance, kPlain, {0.01, 0.9}, "likewise while it turns")
      .real("standing_speed", disk.standing_speed_rad_s, kDegreePerSecond, {0.01, 50},
            "a disk that should stand moves slower than this")
      .real("retry", disk.retry_s, kSecond, {1, 3600}, "pause between a failed self check and the next one");
}

void add_motor_settings(std::vector<Entry>& table, drivers::MotorOptions& motor) {
  Section(table, "motor")
      .text("interface", motor.interface, "CAN interface, as `ip link` shows it")
      .whole("node_id", motor.node_id, 1, 127, "the drive's CANopen node number")
      .whole("host_node_id", motor.host_node_id, 1, 127, "this computer's, for its heartbeat")
      .real("counts_per_turn", motor.counts_per_turn, kPlain, {1, 1e12},
            "counts of the drive's position (6064) in one turn of the disk, gears included")
      .real("velocity_units_per_turn_per_s", motor.velocity_units_per_turn_per_s, kPlain, {1, 1e12},
            "the drive's speed (60FF, 606C) when the disk does one turn per second")
      .real("acceleration_units_per_turn_per_s2", motor.acceleration_units_per_turn_per_s2, kPlain, {1e-3, 1e12},
            "the drive's ramp (6083, 6084, 6085) that gains one turn per second in a second")
      .on_off("reverse", motor.reverse, "the drive counts up while the disk turns clockwise, seen from above")
      .real("acceleration", motor.acceleration_rad_s2, kDegreePerSecond2, {0.1, 50000}, "of the disk")
      .real("deceleration", motor.deceleration_rad_s2, kDegreePerSecond2, {0.1, 50000}, "of the disk")
      .real("quick_stop_deceleration", motor.quick_stop_deceleration_rad_s2, kDegreePerSecond2, {0.1, 50000},
            "of the disk, when the drive brakes by itself")
      .real("standstill_speed", motor.standstill_speed_rad_s, kDegreePerSecond, {0.01, 50},
            "the disk stands below this")
      .choice("quick_stop_ramp", motor.quick_stop_ramp, {"none", "deceleration", "quick_stop_deceleration"},
              "how the drive brakes in a quick stop (605A)")
      .choice("connection_loss", motor.connection_loss, {"nothing", "fault", "disable_voltage", "quick_stop"},
              "what the drive does when it misses this computer (6007)")
      .on_off("reset_on_start", motor.reset_on_start, "reset the drive's communication before it is set up");
  Section(table, "motor.timing")
      .real("heartbeat", motor.heartbeat_s, kSecond, {0.02, 10}, "period of the drive's; 2.5 of them without is a loss")
      .real("host_heartbeat", motor.host_heartbeat_s, kSecond, {0.1, 10},
            "the drive stops the disk when it misses this computer for so long")
      .real("sync_rate", motor.sync_rate_hz, kHertz, {10, 500}, "how often the drive tells angle and speed")
      .real("sdo_timeout", motor.sdo_timeout_s, kSecond, {0.05, 10}, "wait for an object of the drive")
      .real("state_timeout", motor.state_timeout_s, kSecond, {0.2, 60}, "wait for a step of the drive's states")
      .real("boot_timeout", motor.boot_timeout_s, kSecond, {0.5, 60}, "wait for the drive after its reset")
      .real("reach_timeout", motor.reach_timeout_s, kSecond, {0.1, 600},
            "a wanted speed is reached after its ramp and this")
      .real("stop_timeout", motor.stop_timeout_s, kSecond, {0.1, 60}, "wait for standstill before switching off")
      .whole("max_fault_resets", motor.max_fault_resets, 0, 100, "resets of the drive's faults within the window")
      .real("fault_reset_window", motor.fault_reset_window_s, kSecond, {1, 3600}, "the window")
      .real("min_backoff", motor.min_backoff_s, kSecond, {0.01, 60},
            "pause before the drive is set up again, doubled by failures")
      .real("max_backoff", motor.max_backoff_s, kSecond, {0.01, 600}, "longest such pause");
}

void add_encoder_settings(std::vector<Entry>& table, drivers::EncoderOptions& encoder) {
  Section(table, "encoder")
      .text("chip", encoder.chip, "name, label or path of the GPIO chip")
      .text("line_a", encoder.line_a, "offset on the chip, or name of the line")
      .text("line_b", encoder.line_b, "likewise")
      .text("line_index", encoder.line_index, "likewise; empty: none, the position at the start counts as angle 0")
      .whole("counts_per_turn", encoder.counts_per_turn, 4, 1000000,
             "edges of A and B together in one turn of the disk, a multiple of 4")
      .on_off("reverse", encoder.reverse, "A leads B while the disk turns counter-clockwise, seen from above")
      .choice("bias", encoder.bias, {"none", "pull_up", "pull_down"}, "of the lines")
      .whole("index_tolerance", encoder.index_tolerance, 0, 1000, "counts by which the index may come aside")
      .real("harmonic", encoder.harmonic_rad, kMilliradian, {0, 100},
            "an eccentric disk's angles are wrong by this * sin(angle + phase)")
      .real("harmonic_phase", encoder.harmonic_phase_rad, kDegree, {-180, 180}, "the phase")
      .choice("access", encoder.access, {"auto", "libgpiod", "kernel"},
              "how the lines are read; kernel has the longer queue and tells what it lost")
      .whole("event_buffer", encoder.event_buffer, 16, 1024, "edges that the kernel keeps for us (kernel)")
      .whole("debounce_us", encoder.debounce_us, 0, 100000, "shorter pulses are dropped (kernel)")
      .real("min_backoff", encoder.min_backoff_s, kSecond, {0.01, 60},
            "pause before the lines are asked for again, doubled by failures")
      .real("max_backoff", encoder.max_backoff_s, kSecond, {0.01, 600}, "longest such pause");
}

void add_mount_settings(std::vector<Entry>& table, scan::MountOptions& mount) {
  Section(table, "mount")
      .real("scan_plane_pitch", mount.scan_plane_pitch_rad, kDegree, {-89, 89},
            "front beam above the disk; -60 is the inverted mount that looks down stairs")
      .real("scan_plane_roll", mount.scan_plane_roll_rad, kDegree, {-180, 180},
            "turn about the front beam, left side up")
      .real("scan_plane_yaw", mount.scan_plane_yaw_rad, kDegree, {-180, 180}, "front beam left of the encoder index")
      .real("lever_arm_x", mount.lever_arm_x_m, kMillimetre, {-1000, 1000},
            "scanner's origin on the disk, from its axis")
      .real("lever_arm_y", mount.lever_arm_y_m, kMillimetre, {-1000, 1000}, "likewise")
      .real("lever_arm_z", mount.lever_arm_z_m, kMillimetre, {-1000, 1000}, "likewise")
      .real("disk_x", mount.disk_x_m, kMillimetre, {-10000, 10000}, "disk on the robot, forward of base")
      .real("disk_y", mount.disk_y_m, kMillimetre, {-10000, 10000}, "disk on the robot, left of base")
      .real("disk_z", mount.disk_z_m, kMillimetre, {-10000, 10000}, "disk above the floor");
}

void add_sweep_settings(std::vector<Entry>& table, scan::SweepOptions& sweep) {
  Section(table, "sweep")
      .real("min_range", sweep.min_range_m, kMetre, {0, 100}, "nearer returns are dropped")
      .real("max_range", sweep.max_range_m, kMetre, {0.1, 100}, "farther returns are dropped")
      .real("max_duration", sweep.max_duration_s, kSecond, {0.1, 600}, "a sweep is cut after this")
      .whole("max_points", sweep.max_points, 1000, 20000000, "and when it holds this many points")
      .whole("max_waiting_scans", sweep.max_waiting_scans, 1, 10000, "scans held back until their disk angle is known")
      .real("max_angle_gap", sweep.angle.max_gap_s, kSecond, {0.001, 10}, "gap between disk angles that may be bridged")
      .real("max_angle_extrapolation", sweep.angle.max_extrapolation_s, kSecond, {0, 1},
            "how far past the newest disk angle it is still told")
      .whole("max_angle_samples", sweep.angle.max_samples, 2, 10000000, "disk angles kept");
}

void add_preview_settings(std::vector<Entry>& table, PreviewOptions& preview) {
  Section(table, "preview")
      .real("every", preview.every_s, kSecond, {0, 600},
            "sweep time between answers to a part of the sweep, where they show a stairway; 0: whole sweeps only");
}

void add_input_settings(std::vector<Entry>& table, InputOptions& input) {
  Section(table, "input")
      .vector("gravity", input.gravity, "downwards in the frame of a cloud file, e.g. from its IMU; [] is along -z")
      .real("roll", input.roll_rad, kDegree, {-180, 180}, "of the sensor about x, left side up; unused with gravity")
      .real("pitch", input.pitch_rad, kDegree, {-90, 90}, "of the sensor about y, front down; unused with gravity")
      .choice("level", input.level, {"none", "floor"}, "floor: turn and lift the cloud until its floor is z = 0")
      .vector("sensor_m", input.sensor,
              "where the sensor stood in the frame of the file; [] asks the file, then the mount")
      .on_off("merged", input.merged, "the cloud was seen from several places: no line of sight is known");
}

void add_simulation_settings(std::vector<Entry>& table, SimulationOptions& simulate) {
  Section(table, "simulate")
      .text("scene", simulate.scene, "name of a shipped scene or path of a scene file")
      .real("speed", simulate.speed, kPlain, {0, 1000}, "simulated seconds per second; 0 is as fast as possible")
      .whole("seed", simulate.seed, 0, 2147483647, "of the noise");
}

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string show_real(double value) {
  return fmt::format("{:.6g}", value + 0.0);  // turns -0 into 0
}

// As few digits as give the same value when they are read again. Some values have no such digits in the file's unit;
// theirs come as near as a double can.
std::string show_exact_real(const RealField& field) {
  const double in_file = *field.value / field.unit.in_struct + 0.0;
  for (const int digits : {6, 9, 12, 15, 16}) {
    const std::string text = fmt::format("{:.{}g}", in_file, digits);
    if (field.unit.to_struct(std::strtod(text.c_str(), nullptr)) == *field.value) return text;
  }
  return fmt::format("{:.17g}", in_file);
}

std::string show_exact_value(const Entry& entry) {
  const auto* real = std::get_if<RealField>(&entry.field);
  return real != nullptr ? show_exact_real(*real) : show_value(entry);
}

std::string show_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    out += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return out;
}

/// Calls `write_section(name)` and `write_entry(entry, name without section)` down the table.
template <class WriteSection, class WriteEntry>
void write_sections(const std::vector<Entry>& table, WriteSection write_section, WriteEntry write_entry) {
  std::string section;
  for (const Entry& entry : table) {
    const std::size_t dot = entry.key.rfind('.');
    const std::string own = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (own != section) write_section(own);
    section = own;
    write_entry(entry, dot == std::string::npos ? entry.key : entry.key.substr(dot + 1));
  }
}

void add_record_settings(std::vector<Entry>& table, ipc::RecordOptions& record) {
  Section(table, "record")
      .choice("mode", record.mode, {"off", "continuous", "snapshot"},
              "record all messages, or keep the last sweeps for a request (SIGUSR2)")
      .text("folder", record.folder, "where recordings go")
      .on_off("raw", record.raw, "the bytes to and from the scanner too")
      .whole("max_file_mb", record.max_file_mb, 1, 100000, "size at which a new file is begun, in MB")
      .real("max_file", record.max_file_s, kSecond, {1, 100000}, "age at which a new file is begun")
      .whole("max_total_mb", record.max_total_mb, 1, 1000000, "the oldest files go to keep all below this, in MB")
      .whole("min_free_mb", record.min_free_mb, 0, 1000000, "recording pauses while the disk has less left, in MB")
      .whole("snapshot_sweeps", record.snapshot_sweeps, 1, 1000, "sweeps in a snapshot")
      .whole("snapshot_memory_mb", record.snapshot_memory_mb, 1, 100000, "most memory for them, in MB");
}

void add_replay_settings(std::vector<Entry>& table, ReplayOptions& replay) {
  Section(table, "replay")
      .real("speed", replay.speed, kPlain, {0, 1000}, "recorded seconds per second; 0 is as fast as possible");
}

void add_cloud_settings(std::vector<Entry>& table, ipc::CloudOptions& cloud) {
  Section(table, "cloud")
      .on_off("send", cloud.send, "the points of every sweep, in slices on STAIRWAY_CLOUD; never recorded")
      .whole("slice_bytes", cloud.slice_bytes, 1000, 60000, "size of a slice; small ones live longer on a radio link")
      .real("rate", cloud.rate_mb_s, kMegabytePerSecond, {0.1, 1000}, "how fast the slices of a cloud go out");
}

void add_command_settings(std::vector<Entry>& table, CommandOptions& command) {
  Section(table, "command")
      .on_off("listen", command.listen, "obey what comes on STAIRWAY_COMMAND")
      .real("max_age", command.max_age_s, kSecond, {0.1, 86400},
            "an older command is refused: it comes from a recording, or the clocks differ");
}

void add_source_settings(std::vector<Entry>& table, SourceOptions& source) {
  Section(table, "source")
      .choice("kind", source.kind, {"hardware", "simulate", "lcm"},
              "where measurements come from: this robot's devices, a simulated robot, or another process over LCM")
      .text("lcm_url", source.lcm_url, "where that process sends to; empty is lcm.url")
      .text("lcm_channel_prefix", source.lcm_channel_prefix, "of its channels; empty is lcm.channel_prefix");
}

}  // namespace

std::vector<Entry> settings_table(Settings& settings) {
  std::vector<Entry> table;
  Section(table, "").text("profile", settings.profile, "set of defaults below this file: lidar or depth-camera");
  Section(table, "log")
      .choice("level", settings.log.level, {"error", "warning", "info", "debug"}, "how much is said on stderr");
  Section(table, "lcm")
      .text("url", settings.lcm.url, "LCM provider; ttl=0 keeps messages on this host")
      .text("channel_prefix", settings.lcm.channel_prefix, "in front of every channel name")
      .on_off("scans", settings.lcm.scans, "send every scan and every disk angle, some 300 kB a second")
      .on_off("raw", settings.lcm.raw, "send the bytes between this computer and the scanner too");
  add_cloud_settings(table, settings.cloud);
  add_command_settings(table, settings.command);
  add_lidar_settings(table, settings.lidar, settings.usb, settings.sync_input);
  add_disk_settings(table, settings.disk);
  add_motor_settings(table, settings.motor);
  add_encoder_settings(table, settings.encoder);
  add_mount_settings(table, settings.mount);
  add_sweep_settings(table, settings.sweep);
  add_detector_settings(table, settings.detector);
  add_preview_settings(table, settings.preview);
  add_input_settings(table, settings.input);
  add_simulation_settings(table, settings.simulate);
  add_record_settings(table, settings.record);
  add_replay_settings(table, settings.replay);
  add_source_settings(table, settings.source);
  return table;
}

std::string show_value(const Entry& entry) {
  return std::visit(Overloaded{
                        [](const RealField& field) { return show_real(*field.value / field.unit.in_struct); },
                        [](const WholeField& field) { return std::to_string(*field.value); },
                        [](const SwitchField& field) { return std::string(*field.value ? "true" : "false"); },
                        [](const TextField& field) { return show_text(*field.value); },
                        [](const ChoiceField& field) { return show_text(field.names.at(field.get())); },
                        [](const VectorField& field) {
                          if (!field.value->has_value()) return std::string("[]");
                          const Eigen::Vector3d& v = **field.value;
                          return fmt::format("[{}, {}, {}]", show_real(v.x()), show_real(v.y()), show_real(v.z()));
                        },
                    },
                    entry.field);
}

std::string describe_range(const Entry& entry) {
  return std::visit(Overloaded{
                        [](const RealField& field) {
                          return fmt::format("{}..{}{}{}", show_real(field.min), show_real(field.max),
                                             field.unit.name.empty() ? "" : " ", field.unit.name);
                        },
                        [](const WholeField& field) { return fmt::format("{}..{}", field.min, field.max); },
                        [](const SwitchField&) { return std::string("true or false"); },
                        [](const TextField&) { return std::string("text"); },
                        [](const ChoiceField& field) { return joined(field.names); },
                        [](const VectorField&) { return std::string("[x, y, z] or []"); },
                    },
                    entry.field);
}

bool changes_live(std::string_view key) { return key.starts_with("detector.") || key.starts_with("log."); }

std::string default_file_text() {
  Settings defaults;
  std::string out =
      "# SPDX-FileCopyrightText: The stairwayd authors\n# SPDX-License-Identifier: Apache-2.0\n"
      "#\n# Settings of stairwayd and stairway. Every key is listed with its default; remove the # in front of what "
      "you\n"
      "# change. `stairway config` shows what is in effect and where each value comes from.\n\n";
  write_sections(
      settings_table(defaults), [&](const std::string& section) { out += fmt::format("\n[{}]\n", section); },
      [&](const Entry& entry, const std::string& name) {
        out += fmt::format("# {} ({})\n#{} = {}\n", entry.doc, describe_range(entry), name, show_value(entry));
      });
  return out;
}

std::string to_toml(const Settings& settings) {
  Settings copy = settings;
  std::string out;
  write_sections(
      settings_table(copy), [&](const std::string& section) { out += fmt::format("\n[{}]\n", section); },
      [&](const Entry& entry, const std::string& name) {
        out += fmt::format("{} = {}\n", name, show_exact_value(entry));
      });
  return out;
}

}  // namespace stairway::config
