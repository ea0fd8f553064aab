// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "detector/stairway_detector.hpp"
#include "drivers/canopen/motor_options.hpp"
#include "drivers/disk/disk_options.hpp"
#include "drivers/encoder/encoder_options.hpp"
#include "drivers/scip/scip_options.hpp"
#include "drivers/scip/sync_input.hpp"
#include "drivers/usb/usb_options.hpp"
#include "ipc/channels.hpp"
#include "ipc/cloud_options.hpp"
#include "ipc/recording/record_options.hpp"
#include "scan_assembly/frames.hpp"
#include "scan_assembly/sweep_assembler.hpp"

namespace stairway::config {

/// How a cloud that was read from a file is turned before detection.
enum class Levelling {
  None,   ///< only by the angles or the gravity given
  Floor,  ///< then onto the largest nearly horizontal plane below the sensor, which becomes z = 0
};

struct InputOptions {
  std::optional<Eigen::Vector3d> gravity;  ///< downwards in the file's frame, of any length; replaces roll and pitch
  double roll_rad = 0.0;                   ///< of the sensor about x, left side up [rad], in [-pi, pi]
  double pitch_rad = 0.0;                  ///< of the sensor about y, front down [rad], in [-pi/2, pi/2]
  Levelling level = Levelling::None;
  std::optional<Eigen::Vector3d> sensor;  ///< where it stood, in the file's frame [m]; replaces what the file says
  bool merged = false;                    ///< the cloud was seen from several places, so no line of sight is known

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

struct SimulationOptions {
  std::string scene = "straight-flight";  ///< name of a shipped scene or path of a scene file
  double speed = 1.0;                     ///< simulated seconds per second; 0 is as fast as possible
  int seed = 1;                           ///< of the noise

  std::string problem() const;
};

/// Answers while the disk still turns.
struct PreviewOptions {
  double every_s = 1.5;  ///< of a sweep's own time between two of them [s], 0..600; 0: none
};

/// Where the daemon's measurements come from.
enum class SourceKind {
  Hardware,  ///< scanner, motor and encoder of this robot
  Simulate,  ///< a simulated robot
  Lcm,       ///< another process, by its scans and disk angles on LCM
};

struct SourceOptions {
  SourceKind kind = SourceKind::Hardware;
  std::string lcm_url;             ///< of the other process; empty is that of `lcm`
  std::string lcm_channel_prefix;  ///< likewise

  /// Where the other process sends to, when `own` is where this one does.
  ipc::BusOptions bus(const ipc::BusOptions& own) const;
};

struct CommandOptions {
  bool listen = true;       ///< obey what comes on STAIRWAY_COMMAND
  double max_age_s = 10.0;  ///< an older command is refused [s], 0.1..86400
};

struct ReplayOptions {
  double speed = 1.0;  ///< recorded seconds per second; 0 is as fast as possible
};

enum class LogLevel { Error, Warning, Info, Debug };

struct LogOptions {
  LogLevel level = LogLevel::Info;
};

/// Every setting of the programs, made of the Options of their parts; the defaults suit the UTM-30LX on its disk.
/// The keys of the settings file, with units and ranges, are in settings_table.hpp.
struct Settings {
  std::string profile = "lidar";  ///< name of the set of defaults that was laid under the file
  LogOptions log;
  ipc::BusOptions lcm;
  drivers::ScipOptions lidar;
  drivers::UsbOptions usb;               ///< keys in the section of the lidar
  drivers::SyncInputOptions sync_input;  ///< likewise
  drivers::DiskOptions disk;
  drivers::MotorOptions motor;
  drivers::EncoderOptions encoder;
  scan::MountOptions mount;
  scan::SweepOptions sweep;
  detect::DetectorOptions detector;
  PreviewOptions preview;
  InputOptions input;
  SimulationOptions simulate;
  ipc::RecordOptions record;
  ReplayOptions replay;
  SourceOptions source;
  CommandOptions command;
  ipc::CloudOptions cloud;

  /// First problem of any part, beginning with the section it is in; empty when usable.
  std::string problem() const;
};

}  // namespace stairway::config
