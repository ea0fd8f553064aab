// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tools/sim/mesh.hpp"

namespace stairway::sim {

/// An STL file that cannot be read or written. The text names the file, the place (line or byte), what is wrong and
/// what was expected.
class StlFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Larger files are refused [bytes].
inline constexpr std::size_t kMaxStlBytes = std::size_t{256} << 20;

/// Reads an STL file, the triangles that CAD programs export; the contents decide between ASCII and binary, not the
/// name: an ASCII file begins with "solid" and holds no zero byte.
///
/// STL knows neither units nor frames: numbers are taken as metres in whatever frame the caller expects. Normals and
/// attributes in the file are ignored, the corners tell more exactly; an ASCII file may hold several solids. Triangles
/// without area are left out. Every other triangle becomes a surface of its own, in the order of the file.
///
/// Throws StlFileError when the file cannot be opened, ends too early, holds more or less than it states, has a number
/// that is not finite, or holds no triangle with an area. Cost: O(n).
Mesh read_stl(const std::filesystem::path& path);

/// The same for a file in memory. What is thrown then names no file.
Mesh decode_stl(std::string_view bytes);

/// Binary STL: single precision, 50 bytes per triangle, normals to the side from which the corners turn left. Surfaces
/// are lost.
std::string encode_stl(const Mesh& mesh);

/// Writes encode_stl(). Throws StlFileError.
void write_stl(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace stairway::sim
