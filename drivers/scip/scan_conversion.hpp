// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/scip/clock_mapping.hpp"
#include "drivers/scip/scip_options.hpp"
#include "drivers/scip/scip_replies.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// What a raw value means for a sensor with the given range limits: 1 NoReturn, 2 and 4 TooNear, 3 Disturbed, any other
/// value below DMIN Invalid, above DMAX NoReturn.
BeamStatus classify_range(std::uint32_t range_mm, const SensorParameters& sensor);

/// The one place where SCIP's millimetres and steps become metres and radians.
///
/// @param device_stamp_ms  the unwrapped counter.
/// @param time             where the device stamp stands in host time, and the time from scan to scan.
/// A group of `cluster` steps stands for its middle.
LaserScan to_laser_scan(const RawScan& raw, const ScanRequest& request, const SensorParameters& sensor,
                        std::int64_t device_stamp_ms, const ScanTime& time, StampReference reference);

}  // namespace stairway::drivers
