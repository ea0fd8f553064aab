// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "ipc/cloud_file.hpp"
#include "tests/ipc/cloud_fixtures.hpp"

namespace stairway::ipc {
namespace {

const std::vector<test::PcdField> kFields{{"x", "F4"}, {"y", "F4"}, {"z", "F4"}, {"intensity", "F4"}};

std::string pcd(const std::string& encoding) {
  std::string body;
  if (encoding == "ascii") body = "1 2 3 4\n5 6 7 8\n9 10 11 12\n";
  for (int i = 0; encoding != "ascii" && i < 12; ++i) test::append_number<float>(body, i % 4);
  if (encoding == "binary_compressed") body = test::compressed_body(body);
  return test::pcd_header(kFields, 3, encoding) + body;
}

std::string ply(const std::string& format) {
  std::string bytes = "ply\nformat " + format +
                      " 1.0\nelement face 1\nproperty list uchar int i\nelement vertex 2\nproperty float x\n"
                      "property float y\nproperty list uchar uchar t\nproperty float z\nend_header\n";
  if (format == "ascii") return bytes + "2 0 1\n1 2 1 9 3\n4 5 0 6\n";
  const bool big_endian = format == "binary_big_endian";
  const auto add = [&](const char* type, double value) { test::append_typed(bytes, type, value, big_endian); };
  add("U1", 2), add("I4", 0), add("I4", 1);
  add("F4", 1), add("F4", 2), add("U1", 1), add("U1", 9), add("F4", 3);
  add("F4", 4), add("F4", 5), add("U1", 0), add("F4", 6);
  return bytes;
}

const std::vector<std::string> kGoodFiles{pcd("ascii"),
                                          pcd("binary"),
                                          pcd("binary_compressed"),
                                          ply("ascii"),
                                          ply("binary_little_endian"),
                                          ply("binary_big_endian")};

void expect_error_or_few_points(const std::string& bytes) {
  const auto loaded = decode_cloud(bytes);
  if (loaded) {
    EXPECT_LE(loaded->cloud.points.size() + loaded->dropped_points, bytes.size());
  } else {
    EXPECT_FALSE(loaded.error().text.empty());
    EXPECT_LT(loaded.error().text.size(), 300U);
  }
}

TEST(DamagedCloudFile, cut_anywhere_before_the_last_number_is_an_error) {
  for (const std::string& good : kGoodFiles) {
    ASSERT_TRUE(decode_cloud(good)) << decode_cloud(good).error().text;
    // The last number of an ascii file may lose digits unnoticed, and every file its last line end.
    const std::size_t last_number = good.back() == '\n' ? good.find_last_of(" \n", good.size() - 2) + 1 : good.size();
    for (std::size_t length = 0; length < last_number; ++length) {
      const auto loaded = decode_cloud(good.substr(0, length));
      EXPECT_FALSE(loaded) << "cut at " << length << " of " << good.size() << ":\n" << good.substr(0, length);
    }
  }
}

TEST(DamagedCloudFile, flipped_bytes_never_crash_or_inflate) {
  for (const std::string& good : kGoodFiles) {
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (const unsigned mask : {0x01U, 0x10U, 0x20U, 0x80U, 0xffU}) {
        std::string bad = good;
        bad[i] = static_cast<char>(static_cast<unsigned char>(bad[i]) ^ mask);
        expect_error_or_few_points(bad);
      }
    }
  }
}

TEST(DamagedCloudFile, random_edits_never_crash_or_inflate) {
  std::mt19937_64 random(20180711);
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  for (int round = 0; round < 20000; ++round) {
    std::string bad = kGoodFiles[below(kGoodFiles.size())];
    for (std::size_t edit = 0; edit <= below(4); ++edit) {
      const std::size_t at = below(bad.size());
      switch (below(4)) {
        case 0:
          bad[at] = static_cast<char>(random());
          break;
        case 1:
          bad.insert(at, std::to_string(random() >> below(64)));
          break;
        case 2:
          bad.erase(at, below(8));
          break;
        default:
          bad.insert(at, bad.substr(below(bad.size()), below(20)));
          break;
      }
      if (bad.empty()) break;
    }
    expect_error_or_few_points(bad);
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(DamagedCloudFile, error_says_where_and_what_was_expected) {
  struct Case {
    std::string bytes;
    CloudFileFault fault;
    std::string text;
  };
  const std::string ascii = pcd("ascii");
  const std::string binary = pcd("binary");
  const std::string mesh = ply("binary_little_endian");
  const std::vector<Case> cases{
      {"", CloudFileFault::Truncated, "the file is empty"},
      {"solid cube\n", CloudFileFault::NotACloud,
       "line 1: expected a PCD ('# .PCD' or 'VERSION') or PLY ('ply') file, found 'solid cube'"},
      {std::string("\x1f\x8b\x08 zipped", 10), CloudFileFault::NotACloud,
       "line 1: expected a PCD ('# .PCD' or 'VERSION') or PLY ('ply') file, found '\\x1f\\x8b\\x08 zipped'"},
      {replaced(ascii, "WIDTH 3", "WIDTH three"), CloudFileFault::Malformed,
       "line 7: WIDTH: expected a whole number from 0 to 4294967295, found 'three'"},
      {replaced(ascii, "WIDTH 3", "WIDTH 4"), CloudFileFault::Malformed,
       "line 11: POINTS is not WIDTH times HEIGHT (4 times 1)"},
      {replaced(ascii, "SIZE 4 4 4 4", "SIZE 4 4 4"), CloudFileFault::Malformed,
       "line 4: SIZE: expected 4 values, one per field, found 3"},
      {replaced(ascii, "TYPE F F F F", "TYPE F F Q F"), CloudFileFault::Malformed,
       "line 5: TYPE: expected a type F, I or U, found 'Q'"},
      {replaced(ascii, "FIELDS x y z", "FIELDS x y h"), CloudFileFault::Malformed, "line 11: FIELDS has no z"},
      {replaced(ascii, "FIELDS x y z intensity", "FIELDS x y z x"), CloudFileFault::Malformed,
       "line 11: FIELDS names x twice"},
      {replaced(ascii, "COUNT 1 1", "COUNT 1 2"), CloudFileFault::Malformed, "line 11: COUNT of y is 2, expected 1"},
      {replaced(ascii, "SIZE 4", "SIZE 2"), CloudFileFault::Malformed,
       "line 11: x has TYPE F and SIZE 2, expected F 4, F 8, or I or U with 1, 2, 4 or 8"},
      {replaced(ascii, "DATA ascii", "DATA zipped"), CloudFileFault::Malformed,
       "line 11: expected DATA ascii, binary or binary_compressed, found 'zipped'"},
      {replaced(ascii, "5 6 7 8", "5 6,5 7 8"), CloudFileFault::Malformed,
       "line 13: expected a number for y, found '6,5'"},
      {replaced(ascii, "5 6 7 8", "5 6 7"), CloudFileFault::Malformed,
       "line 13: too few numbers for the declared fields"},
      {replaced(ascii, "5 6 7 8", "5 6 7 8 9"), CloudFileFault::Malformed,
       "line 13: '9' stands behind the last declared field"},
      {replaced(replaced(ascii, "WIDTH 3", "WIDTH 4"), "POINTS 3", "POINTS 4"), CloudFileFault::Truncated,
       "byte 179: the header declares 4 points, but the file has room for 3"},
      {replaced(replaced(binary, "WIDTH 3", "WIDTH 4000000000"), "POINTS 3", "POINTS 4000000000"),
       CloudFileFault::Truncated,
       "byte 198: the header declares 4000000000 points of 16 bytes, but only 48 bytes follow"},
      {replaced(mesh, "property float z", "property float w"), CloudFileFault::Malformed,
       "line 10: the element vertex lacks a property x, y or z"},
      {replaced(mesh, "float y", "flaot y"), CloudFileFault::Malformed,
       "line 7: 'property': expected a type such as float or uchar, found 'flaot'"},
      {replaced(mesh, "vertex 2", "vertex 3"), CloudFileFault::Truncated,
       "byte 220: the file ends within 'vertex' 2 of 3"},
      {replaced(mesh, "vertex 2", "vertices 2"), CloudFileFault::Malformed,
       "line 10: the header has no element vertex"},
      {replaced(mesh, "1.0\n", "1.0\nfoo\n"), CloudFileFault::Malformed,
       "line 3: 'foo': expected format, comment, element, property or end_header"},
  };
  for (const Case& entry : cases) {
    const auto loaded = decode_cloud(entry.bytes);
    ASSERT_FALSE(loaded) << entry.text;
    EXPECT_EQ(loaded.error().text, entry.text);
    EXPECT_EQ(to_string(loaded.error().fault), to_string(entry.fault)) << entry.text;
  }
}

TEST(DamagedCloudFile, compressed_sizes_are_checked_before_memory_is_taken) {
  const std::string header = test::pcd_header(kFields, 250'000'000, "binary_compressed");
  std::string body;
  test::append_number<std::uint32_t>(body, 10);
  test::append_number<std::uint32_t>(body, 4'000'000'000.0);
  const auto loaded = decode_cloud(header + body + "0123456789");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().text.find("10 compressed bytes cannot expand to 4000000000"), std::string::npos)
      << loaded.error().text;
}

TEST(DamagedCloudFile, file_that_cannot_be_opened_is_named_with_the_reason) {
  const auto missing = read_cloud_file("/nonexistent/a.pcd");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text, "/nonexistent/a.pcd: No such file or directory");
  const auto folder = read_cloud_file("/");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text, "/: not a regular file");
  EXPECT_EQ(read_cloud_file("/dev/zero").error().fault, CloudFileFault::Unreadable);
}

}  // namespace
}  // namespace stairway::ipc
