// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/cloud_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "ipc/cloud/lzf.hpp"
#include "tests/ipc/cloud_fixtures.hpp"

namespace stairway::ipc {
namespace {

using test::PcdField;

const std::vector<Eigen::Vector3f> kPoints{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}, {7.0F, 8.0F, 9.0F}};
const double kNan = std::numeric_limits<double>::quiet_NaN();

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_" + name)) {}
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

double value_of(const std::string& field, const Eigen::Vector3f& point) {
  return field == "x" ? point.x() : field == "y" ? point.y() : field == "z" ? point.z() : 77.0;
}

std::string pcd_ascii_body(const std::vector<PcdField>& fields, const std::vector<Eigen::Vector3f>& points) {
  std::string body;
  for (const auto& point : points) {
    for (const PcdField& field : fields) {
      for (int i = 0; i < field.count; ++i) {
        body += std::to_string(static_cast<int>(value_of(field.name, point))) + " ";
      }
    }
    body += "\n";
  }
  return body;
}

std::string pcd_binary_body(const std::vector<PcdField>& fields, const std::vector<Eigen::Vector3f>& points) {
  std::string body;
  for (const auto& point : points) {
    for (const PcdField& field : fields) {
      for (int i = 0; i < field.count; ++i) test::append_typed(body, field.type, value_of(field.name, point));
    }
  }
  return body;
}

std::string pcd_body_by_field(const std::vector<PcdField>& fields, const std::vector<Eigen::Vector3f>& points) {
  std::string body;
  for (const PcdField& field : fields) {
    for (const auto& point : points) {
      for (int i = 0; i < field.count; ++i) test::append_typed(body, field.type, value_of(field.name, point));
    }
  }
  return body;
}

std::string pcd_with_crlf_header(std::string header) {
  for (std::size_t i = header.find('\n'); i != std::string::npos; i = header.find('\n', i + 2)) header.insert(i, "\r");
  return header;
}

TEST(PcdFile, reads_every_type_and_order_of_fields_in_all_three_encodings) {
  const std::vector<std::vector<PcdField>> layouts{
      {{"x", "F4"}, {"y", "F4"}, {"z", "F4"}},
      {{"z", "F4"}, {"y", "F4"}, {"x", "F4"}},
      {{"x", "F8"}, {"y", "F8"}, {"z", "F8"}},
      {{"x", "I1"}, {"y", "U1"}, {"z", "I2"}},
      {{"x", "U2"}, {"y", "I4"}, {"z", "U4"}},
      {{"x", "I8"}, {"y", "U8"}, {"z", "F4"}},
      {{"rgb", "U4"}, {"x", "F4"}, {"y", "F4"}, {"z", "F4"}},
      {{"x", "F4"}, {"y", "F4"}, {"z", "F4"}, {"_", "U1", 4}, {"normal", "F4", 3}, {"_", "U1", 5}},
      {{"fpfh", "F4", 33}, {"y", "F4"}, {"intensity", "F4"}, {"x", "F8"}, {"t", "U8"}, {"z", "I2"}},
  };
  for (const auto& fields : layouts) {
    const std::vector<std::pair<std::string, std::string>> bodies{
        {"ascii", pcd_ascii_body(fields, kPoints)},
        {"binary", pcd_binary_body(fields, kPoints)},
        {"binary_compressed", test::compressed_body(pcd_body_by_field(fields, kPoints))}};
    for (const auto& [encoding, body] : bodies) {
      const std::string header = test::pcd_header(fields, kPoints.size(), encoding);
      SCOPED_TRACE(header);
      for (const std::string& bytes : {header + body, pcd_with_crlf_header(header) + body, header + body + "tail"}) {
        const auto loaded = decode_cloud(bytes);
        ASSERT_TRUE(loaded) << loaded.error().text;
        EXPECT_EQ(loaded->cloud.points, kPoints);
        EXPECT_EQ(loaded->dropped_points, 0U);
        EXPECT_FALSE(loaded->cloud.sensor_origin);
      }
    }
  }
}

TEST(PcdFile, drops_and_counts_points_that_are_not_finite) {
  const std::vector<PcdField> fields{{"x", "F4"}, {"y", "F4"}, {"z", "F4"}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<Eigen::Vector3f> points{{nan, 0, 0}, kPoints[0], {0, inf, 0}, {0, 0, -inf}, kPoints[1]};
  const auto binary = decode_cloud(test::pcd_header(fields, 5, "binary") + pcd_binary_body(fields, points));
  ASSERT_TRUE(binary);
  EXPECT_EQ(binary->cloud.points, (std::vector<Eigen::Vector3f>{kPoints[0], kPoints[1]}));
  EXPECT_EQ(binary->dropped_points, 3U);

  const auto ascii =
      decode_cloud(test::pcd_header(fields, 4, "ascii") + "nan nan nan\r\n\r\n1 +2 3.0e0\n-inf 0 0\n0 1e300 0");
  ASSERT_TRUE(ascii) << ascii.error().text;
  EXPECT_EQ(ascii->cloud.points, (std::vector<Eigen::Vector3f>{kPoints[0]}));
  EXPECT_EQ(ascii->dropped_points, 3U);
}

TEST(PcdFile, drops_doubles_that_float_cannot_hold) {
  const std::vector<PcdField> fields{{"x", "F8"}, {"y", "F8"}, {"z", "F8"}};
  std::string body;
  for (const double value : {1.0, 2.0, -1e300, kNan, 1.0, 1.0}) test::append_number<double>(body, value);
  const auto loaded = decode_cloud(test::pcd_header(fields, 2, "binary") + body);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->dropped_points, 2U);
}

TEST(PcdFile, takes_the_viewpoint_for_the_sensor_origin) {
  std::string header = test::pcd_header({{"x", "F4"}, {"y", "F4"}, {"z", "F4"}}, 1, "ascii");
  header.replace(header.find("0 0 0 1 0 0 0"), 5, "0.25 -1 1.5");
  const auto loaded = decode_cloud(header + "1 2 3\n");
  ASSERT_TRUE(loaded) << loaded.error().text;
  ASSERT_TRUE(loaded->cloud.sensor_origin);
  EXPECT_EQ(*loaded->cloud.sensor_origin, Eigen::Vector3f(0.25F, -1.0F, 1.5F));
}

TEST(PcdFile, takes_a_header_without_count_and_viewpoint_and_points) {
  const auto loaded =
      decode_cloud("VERSION .5\nCOLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3");
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(loaded->cloud.points, (std::vector<Eigen::Vector3f>{kPoints[0]}));
}

TEST(PcdFile, without_points_is_an_empty_cloud) {
  for (const char* encoding : {"ascii", "binary", "binary_compressed"}) {
    const auto loaded = decode_cloud(test::pcd_header({{"x", "F4"}, {"y", "F4"}, {"z", "F4"}}, 0, encoding));
    ASSERT_TRUE(loaded) << loaded.error().text;
    EXPECT_TRUE(loaded->cloud.points.empty());
  }
}

TEST(Lzf, expands_literals_short_long_and_overlapping_references) {
  using namespace std::string_literals;
  const std::vector<std::pair<std::string, std::string>> cases{
      {"\x02"s + "abc", "abc"},
      {"\x02"s + "abc" + "\x20\x02"s, "abcabc"},        // three bytes from three back
      {"\x00"s + "a" + "\xe0\x00\x00"s, "aaaaaaaaaa"},  // nine bytes from one back
      {"\x00"s + "a" + "\xe0\xff\x00"s, std::string(265, 'a')},
  };
  for (const auto& [packed, expected] : cases) {
    const auto expanded = cloud::expand_lzf(packed, expected.size());
    ASSERT_TRUE(expanded) << expanded.error();
    EXPECT_EQ(*expanded, expected);
    EXPECT_FALSE(cloud::expand_lzf(packed, expected.size() - 1));
    EXPECT_FALSE(cloud::expand_lzf(packed, expected.size() + 1));
    EXPECT_FALSE(cloud::expand_lzf(packed.substr(0, packed.size() - 1), expected.size()));
  }
  EXPECT_FALSE(cloud::expand_lzf("\x00"s + "a" + "\x20\x01"s, 4));  // from before the start
}

struct PlyCase {
  std::string properties;
  std::vector<std::string> columns;  ///< name and PCD-style type of each property; "list" for a list of two uchar
};

const std::vector<PlyCase> kPlyCases{
    {"property float x\nproperty float y\nproperty float z\n", {"x F4", "y F4", "z F4"}},
    {"property double z\nproperty float64 y\nproperty float32 x\n", {"z F8", "y F8", "x F4"}},
    {"property char x\nproperty uint8 y\nproperty short z\n", {"x I1", "y U1", "z I2"}},
    {"property ushort x\nproperty int32 y\nproperty uint z\n", {"x U2", "y I4", "z U4"}},
    {"property uchar red\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n",
     {"red U1", "x F4", "y F4", "z F4", "nx F4"}},
    {"property float x\nproperty list uchar uchar tags\nproperty float y\nproperty float z\n",
     {"x F4", "list", "y F4", "z F4"}},
};

std::string ply_text(const PlyCase& layout, const std::string& format, const std::string& eol) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment made by hand\nelement range 2\nproperty short from\n" +
                     "element face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n" + layout.properties +
                     "element edge 1\nproperty int v\nend_header\n";
  std::string out;
  for (const char c : text) out += c == '\n' ? eol : std::string(1, c);
  return out;
}

void append_ply_number(std::string& out, const std::string& format, const std::string& type, double value) {
  if (format == "ascii") {
    out += std::to_string(static_cast<int>(value)) + " ";
  } else {
    test::append_typed(out, type, value, format == "binary_big_endian");
  }
}

std::string ply_body(const PlyCase& layout, const std::string& format) {
  std::string out;
  const std::string end = format == "ascii" ? "\n" : "";
  for (int i = 0; i < 2; ++i) append_ply_number(out, format, "I2", i), out += end;
  append_ply_number(out, format, "U1", 3);
  for (int i = 0; i < 3; ++i) append_ply_number(out, format, "I4", i);
  out += end;
  for (const auto& point : kPoints) {
    for (const std::string& column : layout.columns) {
      if (column == "list") {
        for (const double value : {2.0, 8.0, 9.0}) append_ply_number(out, format, "U1", value);
      } else {
        append_ply_number(out, format, column.substr(column.size() - 2),
                          value_of(column.substr(0, column.find(' ')), point));
      }
    }
    out += end;
  }
  append_ply_number(out, format, "I4", 5);
  return out + end;
}

TEST(PlyFile, reads_every_type_and_order_and_skips_lists_and_other_elements) {
  for (const PlyCase& layout : kPlyCases) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      for (const char* eol : {"\n", "\r\n"}) {
        SCOPED_TRACE(layout.properties + format);
        const auto loaded = decode_cloud(ply_text(layout, format, eol) + ply_body(layout, format));
        ASSERT_TRUE(loaded) << loaded.error().text;
        EXPECT_EQ(loaded->cloud.points, kPoints);
      }
    }
  }
}

TEST(CloudFile, written_files_read_back_bit_for_bit) {
  scan::PointCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    const auto t = static_cast<float>(i);
    cloud.points.emplace_back(std::sin(t) * 30.0F, std::cos(t) / 3.0F, t * 1e-7F);
  }
  cloud.sensor_origin = Eigen::Vector3f(0.1F, -0.2F, 0.7F);
  const std::vector<std::array<std::uint8_t, 3>> colours(1000, {200, 100, 50});
  const std::vector<std::uint32_t> labels(1000, 0xfffffffeU);
  for (const PointAttributes& attributes : {PointAttributes{}, PointAttributes{colours, {}},
                                            PointAttributes{{}, labels}, PointAttributes{colours, labels}}) {
    const TemporaryFile pcd("cloud.pcd");
    const TemporaryFile ply("cloud.ply");
    ASSERT_TRUE(write_pcd(pcd.path(), cloud, attributes));
    ASSERT_TRUE(write_ply(ply.path(), cloud, attributes));
    const auto from_pcd = read_cloud_file(pcd.path());
    const auto from_ply = read_cloud_file(ply.path());
    ASSERT_TRUE(from_pcd) << from_pcd.error().text;
    ASSERT_TRUE(from_ply) << from_ply.error().text;
    EXPECT_EQ(from_pcd->cloud.points, cloud.points);
    EXPECT_EQ(from_pcd->cloud.sensor_origin, cloud.sensor_origin);
    EXPECT_EQ(from_ply->cloud.points, cloud.points);
  }
}

TEST(CloudFile, refuses_attributes_of_another_length_and_places_that_cannot_be_written) {
  const scan::PointCloud cloud{kPoints, {}};
  const std::vector<std::uint32_t> labels(2);
  const TemporaryFile file("short.pcd");
  const auto short_labels = write_pcd(file.path(), cloud, {{}, labels});
  ASSERT_FALSE(short_labels);
  EXPECT_NE(short_labels.error().text.find("2 labels for 3 points"), std::string::npos) << short_labels.error().text;
  EXPECT_FALSE(std::filesystem::exists(file.path()));

  const auto no_folder = write_ply("/nonexistent/cloud.ply", cloud);
  ASSERT_FALSE(no_folder);
  EXPECT_EQ(no_folder.error().fault, CloudFileFault::Unwritable);
  EXPECT_EQ(no_folder.error().text, "/nonexistent/cloud.ply: cannot write: No such file or directory");
}

std::filesystem::path shared_clouds() {
  const char* from_environment = std::getenv("STAIRWAY_SHARED_DATA");
  return std::filesystem::path(from_environment != nullptr ? from_environment : STAIRWAY_SHARED_DATA) / "clouds";
}

TEST(CloudFile, reads_real_recordings) {
  if (!std::filesystem::exists(shared_clouds())) GTEST_SKIP() << "no recordings at " << shared_clouds();
  struct Recording {
    const char* name;
    std::size_t points;
    std::size_t dropped;
  };
  for (const Recording& recording : {Recording{"lidar_metal_stair.pcd", 617755, 0},
                                     {"lidar_metal_stair_unlevelled.pcd", 617755, 0},
                                     {"kinect2_stair.pcd", 217088, 0},
                                     {"kinect2_stair_level.pcd", 216979, 0}}) {
    SCOPED_TRACE(recording.name);
    const auto loaded = read_cloud_file(shared_clouds() / recording.name);
    ASSERT_TRUE(loaded) << loaded.error().text;
    EXPECT_EQ(loaded->cloud.points.size(), recording.points);
    EXPECT_EQ(loaded->dropped_points, recording.dropped);
  }
}

}  // namespace
}  // namespace stairway::ipc
