// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "tests/tools/temporary_folder.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/stl_file.hpp"

namespace stairway::sim {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

Mesh two_triangles() {
  Mesh mesh;
  mesh.add_polygon(Corners{{0, 0, 0.25}, {0, 1, 0.25}, {0.5, 1, 0.25}, {0.5, 0, 0.25}});
  return mesh;
}

const std::string kAscii =
    "solid stairs of mine\n"
    "  facet normal 0 0 -1\n"
    "    outer loop\n"
    "      vertex 0 0 0.25\n"
    "      vertex 0 1 2.5e-1\n"
    "      vertex 5E-1 +1.0 0.25\n"
    "    endloop\n"
    "  endfacet\n"
    "  facet normal nan nan nan\n"
    "    outer loop\n"
    "      vertex 0 0 0.25\n"
    "      vertex 0.5 1 0.25\n"
    "      vertex 0.5 0 0.25\n"
    "    endloop\n"
    "  endfacet\n"
    "endsolid stairs of mine\n";

std::string error_of(const std::string& bytes) {
  try {
    decode_stl(bytes);
  } catch (const StlFileError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

template <typename Number>
std::string patched(std::string bytes, std::size_t at, Number number) {
  std::memcpy(bytes.data() + at, &number, sizeof(number));
  return bytes;
}

void expect_same_corners(const Mesh& mesh, const Mesh& expected) {
  ASSERT_EQ(mesh.triangles().size(), expected.triangles().size());
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f single = expected.triangles()[i].corners[k].cast<float>();
      EXPECT_EQ(mesh.triangles()[i].corners[k], single.cast<double>());
    }
  }
}

TEST(SimStlFile, gives_back_the_triangles_of_every_shipped_scene) {
  for (const std::string& name : shipped_scene_names()) {
    SCOPED_TRACE(name);
    const Scene scene = build_scene(load_scene(name));
    const std::string bytes = encode_stl(scene.mesh);
    EXPECT_EQ(bytes.size(), 84 + 50 * scene.mesh.triangles().size());
    const Mesh mesh = decode_stl(bytes);
    expect_same_corners(mesh, scene.mesh);
    EXPECT_EQ(mesh.surface_count(), mesh.triangles().size());
    expect_same_corners(decode_stl(encode_stl(mesh)), mesh);
  }
}

TEST(SimStlFile, writes_what_the_format_says) {
  const std::string bytes = encode_stl(two_triangles());
  EXPECT_FALSE(bytes.starts_with("solid"));
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  EXPECT_EQ(count, 2U);
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof(normal));
  EXPECT_EQ(normal[0], 0.0F);
  EXPECT_EQ(normal[2], -1.0F) << "corners that turn right seen from above";
}

TEST(SimStlFile, reads_ascii_in_any_layout_and_several_solids) {
  expect_same_corners(decode_stl(kAscii), two_triangles());
  std::string dos;
  for (const char c : kAscii) dos += c == '\n' ? "\r\n" : std::string(1, c);
  expect_same_corners(decode_stl(dos), two_triangles());
  EXPECT_EQ(decode_stl(kAscii + "\n" + kAscii).triangles().size(), 4U);
  EXPECT_EQ(decode_stl(replaced(kAscii, "vertex 0.5 1 0.25", "vertex 0 0 0.25")).triangles().size(), 1U)
      << "a triangle without area";
}

TEST(SimStlFile, a_binary_file_may_begin_like_ascii) {
  const std::string bytes = encode_stl(two_triangles());
  expect_same_corners(decode_stl("solid" + bytes.substr(5)), two_triangles());
}

TEST(SimStlFile, trouble_is_named_with_its_place_and_the_next_file_is_read) {
  const std::string binary = encode_stl(two_triangles());
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  const std::pair<std::string, const char*> table[] = {
      {"", "the file is empty"},
      {"stairs", "byte 6: the file ends within the header of 84 bytes"},
      {binary.substr(0, 83), "byte 83: the file ends within the header"},
      {binary.substr(0, 183), "byte 80: 2 triangles are stated, which take 184 bytes, but the file has 183"},
      {binary + '\0', "byte 80: 2 triangles are stated, which take 184 bytes, but the file has 185"},
      {patched(binary, 80, std::uint32_t{3}), "byte 80: 3 triangles are stated, which take 234 bytes"},
      {patched(binary, 80, ~std::uint32_t{0}), "byte 80: 4294967295 triangles are stated, which take 214748364834"},
      {patched(binary, 96, nan), "byte 96: a corner has a number that is not finite"},
      {patched(binary, 134 + 12 + 24 + 8, infinite), "byte 170: a corner has a number that is not finite"},
      {patched(binary.substr(0, 84), 80, std::uint32_t{0}), "holds no triangle with an area"},
      {std::string(200, 'x'), "byte 80: 2021161080 triangles are stated"},
      {"solid nothing\nendsolid\n", "holds no triangle with an area"},
      {"solid", "line 1: expected 'facet' or 'endsolid', found the end of the file"},
      {"solid of garbage\n\x01\xff", "line 2: expected 'facet' or 'endsolid', found '\\x01\\xff'"},
      {"solidarity " + kAscii, "line 1: expected 'solid', found 'solidarity'"},
      {replaced(kAscii, "normal 0", "0"), "line 2: expected 'normal', found '0'"},
      {replaced(kAscii, "outer loop", "loop"), "line 3: expected 'outer', found 'loop'"},
      {replaced(kAscii, "0 1 2.5e-1", "0 1 2.5e-1m"), "line 5: expected a finite number, found '2.5e-1m'"},
      {replaced(kAscii, "0 1 2.5e-1", "0 nan 0"), "line 5: expected a finite number, found 'nan'"},
      {replaced(kAscii, "0 1 2.5e-1", "0 1e999 0"), "line 5: expected a finite number, found '1e999'"},
      {replaced(kAscii, "0 1 2.5e-1", "0 1"), "line 6: expected a finite number, found 'vertex'"},
      {replaced(kAscii, "      vertex 0 1 2.5e-1\n", ""), "line 6: expected 'vertex', found 'endloop'"},
      {kAscii.substr(0, kAscii.size() - 40), "line 14: expected 'endloop', found 'end'"},
      {kAscii + "trailing", "line 17: expected 'solid', found 'trailing'"},
  };
  for (const auto& [bytes, expected] : table) {
    SCOPED_TRACE(expected);
    const std::string error = error_of(bytes);
    EXPECT_EQ(error.find(expected), 0U) << error;
    EXPECT_EQ(error_of(binary), "no error");
    EXPECT_EQ(error_of(kAscii), "no error");
  }
}

TEST(SimStlFile, no_beginning_of_a_file_is_taken_for_a_file) {
  const std::string binary = encode_stl(two_triangles());
  for (std::size_t size = 0; size < binary.size(); ++size)
    EXPECT_NE(error_of(binary.substr(0, size)), "no error") << size;
  const std::size_t complete = kAscii.find("endsolid") + std::string("endsolid").size();
  for (std::size_t size = 0; size < complete; ++size) EXPECT_NE(error_of(kAscii.substr(0, size)), "no error") << size;
}

TEST(SimStlFile, errors_name_the_file) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path("stairs.stl");
  const auto failure_of = [](const std::filesystem::path& file) {
    try {
      read_stl(file);
    } catch (const StlFileError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  write_stl(path, two_triangles());
  EXPECT_EQ(failure_of(path), "no error");
  expect_same_corners(read_stl(path), two_triangles());
  test::write_text(path, "stairs");
  EXPECT_EQ(failure_of(path).find(path.string() + ": byte 6: "), 0U) << failure_of(path);
  std::filesystem::remove(path);
  EXPECT_EQ(failure_of(path).find(path.string() + ": cannot be read: "), 0U) << failure_of(path);
  EXPECT_EQ(failure_of("/").find("/: cannot be read: "), 0U) << failure_of("/");
  try {
    write_stl("/no/such/folder/a.stl", two_triangles());
    ADD_FAILURE() << "was written";
  } catch (const StlFileError& error) {
    EXPECT_EQ(std::string(error.what()).find("/no/such/folder/a.stl: cannot be written: "), 0U) << error.what();
  }
}

}  // namespace
}  // namespace stairway::sim
