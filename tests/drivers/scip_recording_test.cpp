// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/scip/scip_framer.hpp"
#include "drivers/scip/scip_replies.hpp"
#include "tests/drivers/shared_data.hpp"

namespace stairway::drivers {
namespace {

// A log is a row of { u32 seconds, u32 microseconds, u32 length, bytes }, big-endian.
class LogReader {
 public:
  explicit LogReader(std::string_view log) : rest_(log) {}
  bool is_at_end() const { return rest_.size() < 12; }

  HostStamp take_stamp_ns() {
    const HostStamp seconds = take_number();
    return seconds * 1'000'000'000 + HostStamp{take_number()} * 1000;
  }

  std::string_view take_bytes() {
    const std::string_view bytes = rest_.substr(0, std::min<std::size_t>(take_number(), rest_.size() - 4));
    rest_.remove_prefix(bytes.size());
    return {rest_.data() - bytes.size(), bytes.size()};
  }

 private:
  std::uint32_t take_number() {
    std::uint32_t value = 0;
    for (const char c : rest_.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
    rest_.remove_prefix(4);
    return value;
  }

  std::string_view rest_;
};

struct Recorded {
  HostStamp arrival_ns;
  std::string text;
};

std::vector<Recorded> read_blocks(const std::string& log) {
  LogReader reader(log);
  ScipFramer framer;
  std::vector<Recorded> blocks;
  while (!reader.is_at_end()) {
    const HostStamp stamp_ns = reader.take_stamp_ns();
    framer.add(reader.take_bytes(), stamp_ns, [&](const ScipBlock& block) {
      blocks.push_back({block.arrival_ns, std::string(block.text)});
    });
  }
  return blocks;
}

class ScipRecording : public testing::Test {
 protected:
  void SetUp() override {
    const auto log = read_shared_data("scip/utm30lx_session.read.log");
    if (!log) GTEST_SKIP() << "no recording of a UTM-30LX; set STAIRWAY_SHARED_DATA to the folder that holds scip/";
    blocks_ = read_blocks(*log);
  }
  std::vector<Recorded> blocks_;
};

TEST_F(ScipRecording, has_an_answer_with_right_sums_to_every_command) {
  std::vector<std::string> answers;
  for (const Recorded& block : blocks_) {
    const auto reply = parse_reply(block.text);
    ASSERT_TRUE(reply) << block.text.substr(0, 60);
    answers.push_back(std::string(reply->echo) + " " + std::string(reply->status));
    if (reply->echo == "VV") {
      EXPECT_EQ(parse_version(reply->data)->serial, "00903971");
    }
    if (reply->echo == "PP") {
      EXPECT_EQ(parse_parameters(reply->data)->front_step, 540);
    }
    if (reply->echo == "II") {
      EXPECT_TRUE(parse_state(reply->data)->is_healthy());
    }
  }
  EXPECT_EQ(answers, (std::vector<std::string>{"VV 00", "VV 00", "PP 00", "II 00", "BM 02", "CR00 04", "VV 00", "PP 00",
                                               "II 00", "ME0000108001101 00", "ME0000108001100 99"}));
}

TEST_F(ScipRecording, decodes_the_full_scan_with_intensities) {
  const auto reply = parse_reply(blocks_.back().text);
  ASSERT_TRUE(reply);
  const auto request = parse_scan_request(*parse_command(reply->echo));
  ASSERT_TRUE(request);
  EXPECT_EQ(blocks_.back().text.size() + 1, 6717U);
  RawScan scan;
  ASSERT_TRUE(decode_scan(reply->data, *request, scan));
  EXPECT_EQ(scan.stamp_ms, 4821609U);
  ASSERT_EQ(scan.ranges_mm.size(), 1081U);
  ASSERT_EQ(scan.intensities.size(), 1081U);
  const std::vector<std::uint32_t> ranges = {45, 48, 49, 50, 49, 50, 56, 56, 56, 56};
  EXPECT_NE(std::ranges::search(scan.ranges_mm, ranges).begin(), scan.ranges_mm.end());
  const std::vector<std::uint32_t> intensities = {1809, 1780, 1792, 1746, 1779, 1744, 1762, 1774, 1725, 1751};
  EXPECT_NE(std::ranges::search(scan.intensities, intensities).begin(), scan.intensities.end());
  EXPECT_EQ(std::ranges::max(scan.intensities), 16219U);
}

TEST(ScipSharedData, computed_full_scans_survive_the_round_trip) {
  for (const std::string name : {"md_full", "me_full", "md_0528_0551", "me_0532_0547"}) {
    SCOPED_TRACE(name);
    const auto message = read_shared_data("scip/" + name + ".txt");
    if (!message) GTEST_SKIP() << "no computed scans; set STAIRWAY_SHARED_DATA to the folder that holds scip/";
    const auto reply = parse_reply(std::string_view(*message).substr(0, message->size() - 1));
    ASSERT_TRUE(reply);
    const auto request = parse_scan_request(*parse_command(reply->echo));
    ASSERT_TRUE(request);
    RawScan scan;
    ASSERT_TRUE(decode_scan(reply->data, *request, scan));
    EXPECT_EQ(encode_reply(reply->echo, "99", encode_scan_data(scan, *request)), *message);
  }
}

}  // namespace
}  // namespace stairway::drivers
