// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "tools/sim/mesh.hpp"

namespace stairway::sim {

inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// What a ray met first.
struct Hit {
  float range_m = std::numeric_limits<float>::infinity();  ///< infinite when nothing was met
  std::uint32_t surface = kNoSurface;
};

/// Casts rays at a mesh, which it copies in single precision: about 2 um at 30 m.
///
/// A binary tree of boxes, split by the surface-area heuristic over 16 bins (Wald, IEEE RT 2007). Both sides of a
/// triangle are solid. Casting is const and may be done by many threads. Cost: O(log n) per ray.
class Bvh {
 public:
  explicit Bvh(const Mesh& mesh);

  /// The nearest hit within `max_range_m`. `direction` has length 1.
  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float max_range_m) const;

 private:
  struct Node {
    Eigen::Vector3f low;
    std::uint32_t first;  ///< first child (the second follows it), or first facet of a leaf
    Eigen::Vector3f high;
    std::uint32_t count;  ///< facets of a leaf; 0 for an inner node
  };
  struct Facet {
    Eigen::Vector3f corner, edge1, edge2;
    std::uint32_t surface;
  };
  struct Builder;

  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
};

}  // namespace stairway::sim
