// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_replies.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/scip/scip_framer.hpp"
#include "tests/drivers/scip_samples.hpp"

namespace stairway::drivers {
namespace {

const std::vector<std::uint32_t> kMdRanges = {1000, 1001, 1003, 1006, 1010, 1015, 1021, 1028, 1036, 1045, 1055,  1066,
                                              1078, 1091, 1105, 1120, 5000, 5001, 1,    2,    3,    23,   30000, 60000};

ScanRequest request_of(const std::string& message) {
  return parse_scan_request(*parse_command(message.substr(0, message.find('\n')))).value();
}

// The message without the empty line that ends it.
std::string_view block_of(const std::string& message) {
  return std::string_view(message).substr(0, message.size() - 1);
}

tl::expected<RawScan, ScipError> decode(std::string_view block, const ScanRequest& request) {
  RawScan scan;
  const auto reply = parse_reply(block);
  if (!reply) return tl::unexpected(reply.error());
  if (reply->echo != to_command(request) || reply->status != "99") return tl::unexpected(ScipError::BadForm);
  const auto decoded = decode_scan(reply->data, request, scan);
  if (!decoded) return tl::unexpected(decoded.error());
  return scan;
}

// Every block that comes out of a stream, decoded as `request` asks.
std::vector<RawScan> decode_stream(const std::string& bytes, const ScanRequest& request) {
  ScipFramer framer;
  std::vector<RawScan> scans;
  framer.add(bytes, 0, [&](const ScipBlock& block) {
    auto scan = decode(block.text, request);
    if (!scan) {
      const auto reply = find_reply(block.text, to_command(request));
      RawScan salvaged;
      if (reply && decode_scan(reply->data, request, salvaged)) scan = salvaged;
    }
    if (scan) scans.push_back(*scan);
  });
  return scans;
}

TEST(ScipReplies, decode_ranges) {
  const auto scan = decode(block_of(samples::kMd), request_of(samples::kMd));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->stamp_ms, 4821609U);
  EXPECT_EQ(scan->ranges_mm, kMdRanges);
  EXPECT_TRUE(scan->intensities.empty());
}

TEST(ScipReplies, decode_ranges_and_intensities_that_straddle_lines) {
  const auto scan = decode(block_of(samples::kMe), request_of(samples::kMe));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->stamp_ms, 16777210U);
  ASSERT_EQ(scan->ranges_mm.size(), 16U);
  ASSERT_EQ(scan->intensities.size(), 16U);
  for (std::uint32_t i = 0; i < 16; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(scan->ranges_mm[i], i == 5 ? 1U : i == 9 ? 4U : 1000 + 7 * i);
    EXPECT_EQ(scan->intensities[i], i == 5 ? 0U : i == 9 ? 120U : 2000 + 11 * i);
  }
}

TEST(ScipReplies, encode_the_same_bytes_again) {
  for (const std::string& message : {samples::kMd, samples::kMe}) {
    const ScanRequest request = request_of(message);
    const auto scan = decode(block_of(message), request);
    ASSERT_TRUE(scan);
    EXPECT_EQ(encode_reply(to_command(request), "99", encode_scan_data(*scan, request)), message);
  }
  EXPECT_EQ(encode_reply("QT", "00"), "QT\n00P\n\n");
  EXPECT_EQ(encode_reply("CR00", "04"), "CR00\n04T\n\n");
  EXPECT_EQ(encode_reply("TM1", "00", "00?Xg\n"), "TM1\n00P\n00?Xg\n\n");
}

TEST(ScipReplies, a_full_scan_has_the_size_on_the_wire) {
  ScanRequest request;
  RawScan scan{0, std::vector<std::uint32_t>(1081, 1234), {}};
  EXPECT_EQ(encode_reply(to_command(request), "99", encode_scan_data(scan, request)).size(), 3372U);
  request.symbol = "ME";
  scan.intensities.assign(1081, 99);
  EXPECT_EQ(encode_reply(to_command(request), "99", encode_scan_data(scan, request)).size(), 6717U);
}

TEST(ScipReplies, refuse_a_scan_with_too_many_or_too_few_values) {
  const ScanRequest request = request_of(samples::kMd);
  RawScan scan{7, std::vector<std::uint32_t>(25, 1000), {}};
  EXPECT_EQ(decode_scan(encode_scan_data(scan, request), request, scan).error(), ScipError::WrongCount);
  scan = {7, std::vector<std::uint32_t>(23, 1000), {}};
  EXPECT_EQ(decode_scan(encode_scan_data(scan, request), request, scan).error(), ScipError::WrongCount);
  EXPECT_FALSE(decode_scan("", request, scan));
}

TEST(ScipReplies, refuse_data_lines_of_a_wrong_length_even_if_their_sums_fit) {
  ScanRequest request;
  request.last_step = 43;  // 132 characters: 64 + 64 + 4
  const std::string payload(132, '0');
  const auto decode_lines = [&](std::initializer_list<std::size_t> lengths) {
    std::string data;
    append_line(data, "0000");
    for (const std::size_t length : lengths) append_line(data, payload.substr(0, length));
    RawScan scan;
    return decode_scan(data, request, scan);
  };
  EXPECT_TRUE(decode_lines({64, 64, 4}));
  EXPECT_EQ(decode_lines({66, 64, 2}).error(), ScipError::BadForm);
  EXPECT_EQ(decode_lines({62, 64, 6}).error(), ScipError::BadForm);
  EXPECT_EQ(decode_lines({132}).error(), ScipError::BadForm);
}

TEST(ScipReplies, read_what_the_sensor_says_about_itself) {
  const auto version = parse_version(parse_reply(block_of(samples::kVersion))->data);
  ASSERT_TRUE(version);
  EXPECT_EQ(version->product, "SOKUIKI Sensor TOP-URG UTM-30LX");
  EXPECT_EQ(version->firmware, "P.1.05(17/Apr./2009)");
  EXPECT_EQ(version->serial, "00903971");

  const auto parameters = parse_parameters(parse_reply(block_of(samples::kParameters))->data);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->min_range_mm, 23);
  EXPECT_EQ(parameters->max_range_mm, 60000);
  EXPECT_EQ(parameters->steps_per_turn, 1440);
  EXPECT_EQ(parameters->last_step, 1080);
  EXPECT_EQ(parameters->front_step, 540);
  EXPECT_EQ(parameters->scan_speed_rpm, 2400);

  const auto state = parse_state(parse_reply(block_of(samples::kState))->data);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->time_ms, 0x4991D0U);
  EXPECT_EQ(state->laser, "ON");
  EXPECT_TRUE(state->is_healthy());
}

TEST(ScipReplies, know_a_sick_sensor_from_a_healthy_one) {
  for (const std::string text : {"Sensor works well.", "Stable 000 no error.", "sensor is working normally", ""}) {
    EXPECT_TRUE((SensorState{{}, {}, {}, {}, {}, text}.is_healthy())) << text;
  }
  EXPECT_FALSE((SensorState{{}, {}, {}, {}, {}, "Trouble!! Error No. =[00->33] "}.is_healthy()));
}

TEST(ScipReplies, refuse_parameters_that_are_missing_or_impossible) {
  const std::string_view good = parse_reply(block_of(samples::kParameters))->data;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string data(good);
    return data.replace(data.find(from), from.size(), to);
  };
  const auto line = [](const std::string& key, const std::string& value) {
    std::string out;
    append_key_value(out, key, value);
    return out;
  };
  EXPECT_EQ(parse_parameters(with("AFRT:540;0\n", "")).error(), ScipError::MissingField);
  EXPECT_EQ(parse_parameters(with("ARES:1440;^\n", line("ARES", "0"))).error(), ScipError::BadForm);
  EXPECT_EQ(parse_parameters(with("ARES:1440;^\n", line("ARES", "14x0"))).error(), ScipError::BadCharacter);
  EXPECT_EQ(parse_parameters(with("AMAX:1080;Z\n", line("AMAX", "99999999999"))).error(), ScipError::BadCharacter);
  EXPECT_EQ(parse_parameters(with("SCAN:2400;U\n", line("SCAN", "-1"))).error(), ScipError::BadForm);
}

TEST(ScipReplies, any_flipped_bit_of_a_scan_gives_an_error_and_the_next_scan_decodes) {
  for (const std::string& good : {samples::kMd, samples::kMe}) {
    const ScanRequest request = request_of(good);
    const RawScan expected = decode(block_of(good), request).value();
    for (std::size_t at = 0; at < good.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        SCOPED_TRACE(std::to_string(at) + " bit " + std::to_string(bit));
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ (1 << bit));
        const auto scans = decode_stream(bad + good, request);
        // A flip in the empty line at the end leaves the scan itself whole, but no end to know it by.
        ASSERT_EQ(scans.size(), 1U);
        ASSERT_EQ(scans.front().ranges_mm, expected.ranges_mm);
        ASSERT_EQ(scans.front().intensities, expected.intensities);
        ASSERT_EQ(scans.front().stamp_ms, expected.stamp_ms);
      }
    }
  }
}

TEST(ScipReplies, any_lost_byte_of_a_scan_gives_an_error_and_the_next_scan_decodes) {
  const ScanRequest request = request_of(samples::kMd);
  for (std::size_t at = 0; at < samples::kMd.size(); ++at) {
    SCOPED_TRACE(at);
    std::string bad = samples::kMd;
    bad.erase(at, 1);
    ASSERT_EQ(decode_stream(bad + samples::kMd, request).size(), 1U);
  }
}

TEST(ScipReplies, any_flip_that_a_sum_can_see_in_key_value_replies_is_an_error) {
  struct Case {
    const std::string& message;
    std::function<bool(std::string_view)> parses;
  };
  const std::vector<Case> cases = {{samples::kVersion, [](auto data) { return parse_version(data).has_value(); }},
                                   {samples::kParameters, [](auto data) { return parse_parameters(data).has_value(); }},
                                   {samples::kState, [](auto data) { return parse_state(data).has_value(); }}};
  for (const auto& [good, parses] : cases) {
    for (std::size_t at = 0; at + 2 < good.size(); ++at) {
      SCOPED_TRACE(good.substr(0, 2) + " byte " + std::to_string(at));
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ 0x04);
      const auto reply = find_reply(block_of(bad), good.substr(0, 2));
      EXPECT_FALSE(reply && reply->status == "00" && parses(reply->data));
    }
    EXPECT_TRUE(parses(find_reply(block_of(good), good.substr(0, 2))->data));
  }
}

TEST(ScipReplies, are_found_behind_junk) {
  EXPECT_EQ(find_reply("0?X0?Y0?[0junkQT\n00P\n", "QT")->status, "00");
  EXPECT_EQ(find_reply("QT\n00Q\nQT\n02R\n", "QT")->status, "02");
  EXPECT_FALSE(find_reply("QT\n00Q\n", "QT"));
  EXPECT_FALSE(find_reply("", "QT"));
}

}  // namespace
}  // namespace stairway::drivers
