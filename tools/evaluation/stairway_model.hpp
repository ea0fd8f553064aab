// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "tools/sim/mesh.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::evaluation {

/// Reads the STL model of a stairway that stands alone, in the frame of sim::flight_model(): it goes up along x from
/// its first nosing at x = 0, y is to the left and 0 in the middle, z is up from the floor at its foot [m].
///
/// Throws sim::StlFileError when the file cannot be read, and std::runtime_error that names it when the model does not
/// fit into the hall of the experiment (10 m to every side, 4.5 m high), begins more than 0.5 m before its first nosing
/// or 0.25 m below the floor, or has more triangles than can be joined in a reasonable time (20,000).
sim::Mesh read_stairway_model(const std::filesystem::path& path);

/// What would be read from a file of this flight: sim::flight_model() in single precision, as STL holds it.
sim::Mesh stairway_model(const sim::StairSpec& flight);

}  // namespace stairway::evaluation
