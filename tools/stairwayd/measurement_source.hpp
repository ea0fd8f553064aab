// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drivers/scip/clock_mapping.hpp"
#include "drivers/types.hpp"

namespace stairway::daemon {

/// A part of the machine that has a state of its own.
enum class Device : std::uint8_t {
  Scanner,
  Motor,    ///< the disk's drive and its bus
  Encoder,  ///< the disk's
  Disk,     ///< what command, drive and encoder say about it together
};
inline constexpr std::array kDevices{Device::Scanner, Device::Motor, Device::Encoder, Device::Disk};
const char* to_string(Device device);

enum class Condition : std::uint8_t {
  Good,      ///< does what it is for
  Starting,  ///< not yet, and nothing is wrong so far
  Failed,    ///< the text says why
};

/// How a device is doing, told when it changes.
struct SourceState {
  Device device = Device::Scanner;
  Condition condition = Condition::Starting;
  std::string text;                 ///< one line for a person, e.g. "streaming"; without the device's name
  drivers::HostStamp stamp_ns = 0;  ///< since when
  std::string reason;               ///< unless good: what is wrong or awaited in a few words, one of a few texts
};

/// Something went wrong; counted by name, and for the device if it is one's.
struct SourceTrouble {
  std::optional<Device> device;
  std::string name;    ///< one of a few, e.g. "scanner: corrupt message"
  std::string detail;  ///< for a person: what came, what was asked
};

/// A device gave data.
struct SourceSign {
  Device device = Device::Scanner;
  std::size_t count = 1;  ///< scans, replies of the drive, or angles
};

/// One line for a person, e.g. which device was found.
struct SourceNote {
  std::string text;
};

/// Bytes that went between this computer and a device.
struct RawBytes {
  Device device = Device::Scanner;
  bool is_sent = false;             ///< by this computer; else received
  drivers::HostStamp stamp_ns = 0;  ///< the first byte came, or the last was sent
  std::string bytes;
};

/// What a source tells. Angle samples come in the order of their stamps, and scans likewise.
using SourceEvent = std::variant<drivers::LaserScan, std::vector<drivers::AngleSample>, SourceState, SourceTrouble,
                                 SourceSign, SourceNote, RawBytes, drivers::ClockQuality>;

/// What the disk shall do.
struct DiskOrder {
  bool is_turning = true;    ///< false: it stops, the motor is switched off, and nothing is measured
  double speed_rad_s = 0.0;  ///< when it turns, positive counter-clockwise seen from above [rad/s], not 0
};

/// Where measurements come from: devices, the simulation, a recording. Used by one thread.
///
/// Lost devices are the source's own affair: it tries again without end and says so by their states.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;

  /// Waits at most `timeout` of real time for something to happen and gives what happened, in order; often nothing.
  virtual std::vector<SourceEvent> read(std::chrono::milliseconds timeout) = 0;

  /// From the next read() on. Until the first order the disk does what the settings say.
  /// @return For a person: why there is no disk to give orders to; empty when it obeys.
  virtual std::string order(const DiskOrder& order) = 0;

  /// Stops the motor, then scanning; waits for the disk to stand, at most about 9 s. Nothing is read afterwards.
  /// Stopping twice is stopping once.
  virtual void stop() = 0;

  /// The instant of a stamp in microseconds since the epoch.
  virtual std::int64_t utime_us(drivers::HostStamp stamp_ns) const = 0;

  /// Whether its time is its own, so that it may be kept waiting while the detector is busy. Devices do not wait: of
  /// their sweeps the detector gets the newest.
  virtual bool waits_for_detector() const { return false; }

  /// How far sweeps under way had got when the run that is played previewed them, in microseconds since the epoch, in
  /// order; empty where the settings say when.
  virtual std::optional<std::vector<std::int64_t>> previews() const { return std::nullopt; }

  /// Whether nothing will come any more.
  virtual bool has_ended() const { return false; }
};

}  // namespace stairway::daemon
