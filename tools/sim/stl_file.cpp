// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stl_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "ipc/cloud/text_lines.hpp"

namespace stairway::sim {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFirstTriangle = kHeaderBytes + sizeof(std::uint32_t);
constexpr std::size_t kNormalBytes = 3 * sizeof(float);
constexpr std::size_t kTriangleBytes = 4 * kNormalBytes + sizeof(std::uint16_t);

using Corners = std::array<Eigen::Vector3d, 3>;

/// The words of a text, and the lines they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : lines_(text) {}

  /// The next word; empty at the end of the text.
  std::string_view next() {
    for (;;) {
      if (const std::string_view word = ipc::cloud::take_word(line_); !word.empty()) return word;
      const auto line = lines_.next();
      if (!line) return {};
      line_ = *line;
    }
  }

  void skip_line() { line_ = {}; }

  void expect(std::string_view wanted) {
    if (const std::string_view word = next(); word != wanted) refuse(fmt::format("'{}'", wanted), word);
  }

  double number() {
    const std::string_view word = next();
    double value = 0.0;
    if (ipc::cloud::parse_number(word, value) != std::errc{} || !std::isfinite(value)) refuse("a finite number", word);
    return value;
  }

  Eigen::Vector3d vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

  [[noreturn]] void refuse(std::string_view wanted, std::string_view word) const {
    const std::string found = word.empty() ? "the end of the file" : ipc::cloud::quoted(word);
    throw StlFileError(fmt::format("line {}: expected {}, found {}", lines_.line_number(), wanted, found));
  }

 private:
  ipc::cloud::TextLines lines_;
  std::string_view line_;
};

Mesh decode_ascii(std::string_view text) {
  Mesh mesh;
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word != "solid") words.refuse("'solid'", word);
    words.skip_line();
    for (word = words.next(); word == "facet"; word = words.next()) {
      // Normals of triangles without area are often no numbers.
      words.expect("normal");
      for (int i = 0; i < 3; ++i) words.next();
      words.expect("outer");
      words.expect("loop");
      Corners corners;
      for (Eigen::Vector3d& corner : corners) {
        words.expect("vertex");
        corner = words.vector();
      }
      words.expect("endloop");
      words.expect("endfacet");
      mesh.add_polygon(corners);
    }
    if (word != "endsolid") words.refuse("'facet' or 'endsolid'", word);
    words.skip_line();
  }
  return mesh;
}

Mesh decode_binary(std::string_view bytes) {
  if (bytes.size() < kFirstTriangle) {
    throw StlFileError(fmt::format("byte {}: the file ends within the header of {} bytes; neither ASCII nor binary STL",
                                   bytes.size(), kFirstTriangle));
  }
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof(count));
  if (const std::uint64_t wanted = kFirstTriangle + std::uint64_t{count} * kTriangleBytes; bytes.size() != wanted) {
    throw StlFileError(fmt::format("byte {}: {} triangles are stated, which take {} bytes, but the file has {}",
                                   kHeaderBytes, count, wanted, bytes.size()));
  }
  Mesh mesh;
  for (std::size_t at = kFirstTriangle; at < bytes.size(); at += kTriangleBytes) {
    std::array<std::array<float, 3>, 3> numbers;
    std::memcpy(numbers.data(), bytes.data() + at + kNormalBytes, sizeof(numbers));
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = Eigen::Vector3f(numbers[i].data()).cast<double>();
      if (!corners[i].allFinite())
        throw StlFileError(fmt::format("byte {}: a corner has a number that is not finite",
                                       at + kNormalBytes + i * sizeof(numbers[i])));
    }
    mesh.add_polygon(corners);
  }
  return mesh;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw StlFileError(fmt::format("cannot be read: {}", failure.message()));
  if (size > kMaxStlBytes) throw StlFileError(fmt::format("{} bytes, more than the limit of {}", size, kMaxStlBytes));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!file && size > 0) throw StlFileError(fmt::format("cannot be read: {}", std::strerror(errno)));
  return std::move(bytes).str();
}

void append_vector(std::string& bytes, const Eigen::Vector3d& vector) {
  const Eigen::Vector3f single = vector.cast<float>();
  bytes.append(reinterpret_cast<const char*>(single.data()), kNormalBytes);
}

}  // namespace

Mesh decode_stl(std::string_view bytes) {
  if (bytes.empty()) throw StlFileError("the file is empty");
  const bool is_ascii = bytes.starts_with("solid") && bytes.find('\0') == std::string_view::npos;
  Mesh mesh = is_ascii ? decode_ascii(bytes) : decode_binary(bytes);
  if (mesh.triangles().empty()) throw StlFileError("holds no triangle with an area");
  return mesh;
}

Mesh read_stl(const std::filesystem::path& path) {
  try {
    return decode_stl(read_bytes(path));
  } catch (const StlFileError& error) {
    throw StlFileError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

std::string encode_stl(const Mesh& mesh) {
  std::string bytes = "binary STL, metres";
  bytes.resize(kHeaderBytes, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  for (const Triangle& triangle : mesh.triangles()) {
    append_vector(bytes, triangle.normal());
    for (const Eigen::Vector3d& corner : triangle.corners) append_vector(bytes, corner);
    bytes.append(sizeof(std::uint16_t), '\0');
  }
  return bytes;
}

void write_stl(const std::filesystem::path& path, const Mesh& mesh) {
  const std::string bytes = encode_stl(mesh);
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw StlFileError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
}

}  // namespace stairway::sim
