// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/depth_camera.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::sim {

/// What somebody with a depth camera on the helmet walks up to.
enum class HelmetSubject { Ascending, Descending, Nothing };

struct HelmetScene {
  SceneSpec scene;
  CameraPose pose;     ///< where the camera is
  CameraPose assumed;  ///< where its gravity sensor has it: roll and pitch off by one degree (1 sigma)
};

/// A view in the manner of the Monash set (Tang 2012), which shows stairs from the helmet of a walking person.
///
/// The camera is 1.60 to 1.80 m above the floor, looks 22 to 40 degrees down (32 to 48 at an edge) and up to 12 degrees
/// beside the way. Flights have 5 to 12 steps of 130 to 190 mm by 250 to 340 mm, 0.9 to 2.5 m wide, askew by up to 25
/// degrees; their nearest nosing is 0.7 to 1.8 m away going up and 0.4 to 1.0 m going down. Rooms are corridors, halls
/// or open places 12 m wide; floors may be paved with slabs that stand up by 5 to 12 mm. Without stairs there are
/// walls, furniture, kerbs, ramps and platforms instead. A picture of stairs shows the middles of four nosings at least
/// (nosings_in_view). The same seed gives the same scene on every machine.
HelmetScene random_helmet_scene(std::uint64_t seed, HelmetSubject subject);

/// For each nosing of a stairway whether its middle lies in the picture of a Kinect at `pose` and within 4.2 m along
/// its optical axis; what may hide it is not asked.
std::vector<bool> nosings_in_view(const detect::Stairway& stairway, const CameraPose& pose);

}  // namespace stairway::sim
