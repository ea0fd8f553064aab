// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "ipc/message_codec.hpp"
#include "tests/ipc/message_fixtures.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway::ipc {
namespace {

using nlohmann::json;

const std::filesystem::path kTypes = STAIRWAY_SOURCE_DIR "/ipc/types";

Bytes read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::map<std::string, Bytes> sample_messages() {
  ScanMessage scan = test::sample_scan();
  scan.scan.intensities.assign(scan.scan.ranges_m.size(), 1234);
  return {{"scan_t", encode(scan)},
          {"disk_t", encode(test::kDisk)},
          {"angles_t", encode(test::kAngles)},
          {"stairways_t", encode(test::sample_stairways())},
          {"health_t", encode(test::kHealth)},
          {"settings_t", encode(test::kSettings)},
          {"command_t", encode(test::kCommand)},
          {"command_ack_t", encode(test::kAck)},
          {"cloud_slice_t", encode(test::kSlice)},
          {"raw_t", encode(test::kRaw)}};
}

/// The fields of every sample as Python read them, by type; Python has encoded them again into the folder.
std::map<std::string, json> decode_by_python(const stairway::test::TemporaryFolder& folder) {
  std::string command = "PYTHONPATH=" STAIRWAY_PYTHON_DIR " PYTHONDONTWRITEBYTECODE=1 python3 " STAIRWAY_SOURCE_DIR
                        "/tests/ipc/decode_messages.py " +
                        folder.path("");
  for (const auto& [type, bytes] : sample_messages()) {
    std::ofstream(folder.path(type), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    command += " " + type;
  }
  EXPECT_EQ(std::system((command + " >" + folder.path("json")).c_str()), 0) << command;
  std::map<std::string, json> messages;
  std::ifstream lines(folder.path("json"));
  for (std::string line; std::getline(lines, line);) {
    const json object = json::parse(line);
    messages[object["type"]] = object["message"];
  }
  return messages;
}

TEST(PythonMessages, are_read_as_cpp_wrote_them) {
  const stairway::test::TemporaryFolder folder;
  auto got = decode_by_python(folder);
  for (const auto& [type, bytes] : sample_messages())
    EXPECT_EQ(read_bytes(folder.path(type + ".again")), bytes) << type;
  EXPECT_EQ(got["scan_t"]["sequence"], std::int64_t{1} << 40);
  EXPECT_EQ(got["scan_t"]["num_beams"], 1081);
  EXPECT_EQ(got["scan_t"]["statuses"][4], 4);
  EXPECT_TRUE(got["scan_t"]["ranges_m"][1].is_null()) << "NaN where there is no range";
  EXPECT_EQ(got["scan_t"]["intensities"][1080], 1234);
  EXPECT_EQ(got["disk_t"]["angle_rad"], -3.5);
  EXPECT_EQ(got["disk_t"]["fault_text"], "drive silent for 1.2 s");
  EXPECT_EQ(got["angles_t"]["angles_rad"][1], 1.0 / 3.0);
  EXPECT_EQ(got["angles_t"]["valid"], json::parse("[true, false, true]"));
  EXPECT_EQ(got["stairways_t"]["stairways"][0]["nosings"][1]["right_m"], json::parse("[10.0, 11.0, 12.0]"));
  EXPECT_EQ(got["stairways_t"]["stairways"][0]["is_irregular"], true);
  EXPECT_EQ(got["stairways_t"]["stairways"][0]["steps"][1]["height_m"], 0.182);
  EXPECT_EQ(got["stairways_t"]["rejected"][0]["figure_names"], json::parse(R"(["steps", "limit"])"));
  EXPECT_EQ(got["health_t"]["reasons"], json::parse(R"(["encoder:disconnected", "not-recording"])"));
  EXPECT_EQ(got["health_t"]["stage_p95_ms"], json::parse("[1.2, 950.5]"));
  EXPECT_EQ(got["health_t"]["last_sweep_points"], 1513400);
  EXPECT_EQ(got["settings_t"]["toml"], test::kSettings.toml);
  EXPECT_EQ(got["command_ack_t"]["text"], "no such speed");
  EXPECT_EQ(got["cloud_slice_t"]["points"].size(), 24u);
  EXPECT_EQ(got["raw_t"]["bytes"][4], 255);
}

TEST(MessageTypes, every_field_tells_its_unit_and_what_it_means) {
  const std::regex field(R"(\s+\w+ \w+(\[\w+\])*;.*)");
  const std::regex told(R"(\s+\w+ \w+(\[\w+\])*;\s+// \[[^\]]+\] \S.*)");
  for (const auto& entry : std::filesystem::directory_iterator(kTypes)) {
    std::ifstream file(entry.path());
    int fields = 0;
    for (std::string line; std::getline(file, line);) {
      if (!std::regex_match(line, field)) continue;
      ++fields;
      EXPECT_TRUE(std::regex_match(line, told)) << entry.path().filename() << ": " << line;
    }
    EXPECT_GT(fields, 0) << entry.path();
  }
}

}  // namespace
}  // namespace stairway::ipc
