// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/motor_setup.hpp"

#include <cmath>

#include "drivers/canopen/canopen_frames.hpp"

namespace stairway::drivers {
namespace {

constexpr std::uint32_t kNoRemoteRequests = 1U << 30;
constexpr std::uint32_t kProfileVelocity = 3;
constexpr std::uint32_t kToPreOperational = 0;

std::uint32_t milliseconds(double seconds) { return static_cast<std::uint32_t>(std::lround(seconds * 1e3)); }

}  // namespace

std::vector<PdoMap> motor_pdo_maps(std::uint8_t node) {
  using namespace objects;
  return {
      {0x1400, static_cast<std::uint32_t>(cob::kRpdo1 + node), 255, {{kControlword, 16}, {kTargetVelocity, 32}}},
      {0x1800, (cob::kTpdo1 + node) | kNoRemoteRequests, 1, {{kStatusword, 16}, {kActualVelocity, 32}}},
      {0x1801, (cob::kTpdo2 + node) | kNoRemoteRequests, 1, {{kActualPosition, 32}}},
  };
}

std::vector<SetupStep> motor_setup(const MotorOptions& options) {
  using namespace objects;
  const MotorUnits units(options);
  const auto node = static_cast<std::uint8_t>(options.node_id);
  const std::uint32_t host_watch =
      static_cast<std::uint32_t>(options.host_node_id) << 16 | milliseconds(options.host_heartbeat_s);
  const auto ramp = [&](double rad_s2) { return ObjectValue{units.acceleration_units(rad_s2), 4}; };

  std::vector<SetupStep> steps{
      {kDeviceType, {}},
      {kDeviceName, {}, "it has no name"},
      {kVendor, {}},
      {kProduct, {}, "its product is not known"},
      {kRevision, {}, "its revision is not known"},
      {kSerial, {}, "its serial number is not known"},
      {kSupportedModes, {}, "its modes are not known"},
      {kHeartbeatPeriod, ObjectValue{milliseconds(options.heartbeat_s), 2}},
      {kHostHeartbeat, ObjectValue{host_watch, 4}, "the disk goes on turning when this program dies"},
      {kCommunicationError, ObjectValue{kToPreOperational, 1}, "it does what it likes when this program dies"},
      {kConnectionLoss, ObjectValue{static_cast<std::uint32_t>(options.connection_loss), 2},
       "it brakes as it likes when this program dies"},
      {kQuickStopOption, ObjectValue{static_cast<std::uint32_t>(options.quick_stop_ramp), 2},
       "it does a quick stop as it likes"},
      {kMode, ObjectValue{kProfileVelocity, 1}},
      {kModeDisplay, {}},
      {kTargetVelocity, ObjectValue{0, 4}},
      {kAcceleration, ramp(options.acceleration_rad_s2)},
      {kDeceleration, ramp(options.deceleration_rad_s2)},
      {kQuickStopDeceleration, ramp(options.quick_stop_deceleration_rad_s2), "it does a quick stop as it likes"},
  };
  for (const PdoMap& map : motor_pdo_maps(node)) {
    for (const ObjectWrite& write : mapping_writes(map)) steps.push_back({write.object, write.value});
  }
  return steps;
}

}  // namespace stairway::drivers
