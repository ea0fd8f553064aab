// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/sdo_client.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/canopen/canopen_frames.hpp"
#include "tests/drivers/can_text.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kMs = 1'000'000;
constexpr HostStamp kTimeout_ns = 200 * kMs;

struct Talk {
  std::vector<std::string> said() {
    std::vector<std::string> out;
    for (const CanFrame& frame : client.take_output()) out.push_back(to_string(frame));
    return out;
  }
  bool hear(const char* text) { return client.on_frame(frame_of(text), now_ns); }
  void wait(HostStamp duration_ns) {
    now_ns += duration_ns;
    client.on_time(now_ns);
  }

  SdoClient client{1, kTimeout_ns};
  HostStamp now_ns = 0;
};

using Texts = std::vector<std::string>;

TEST(SdoClient, reads_and_writes_numbers) {
  Talk talk;
  talk.client.write({0x6060, 0}, ObjectValue{3, 1}, talk.now_ns);
  EXPECT_EQ(talk.said(), Texts{"601#2F60600003000000"});
  EXPECT_TRUE(talk.hear("581#6060600000000000"));
  EXPECT_EQ(talk.client.take_result()->outcome, SdoResult::Outcome::Done);
  EXPECT_FALSE(talk.client.take_result());

  talk.client.read({0x6041, 0}, talk.now_ns);
  EXPECT_EQ(talk.said(), Texts{"601#4041600000000000"});
  EXPECT_TRUE(talk.hear("581#4B41600037060000"));
  EXPECT_EQ(talk.client.take_result()->number(), 0x0637U);
}

TEST(SdoClient, reads_text_in_segments) {
  Talk talk;
  talk.client.read({0x1008, 0}, talk.now_ns);
  talk.said();
  EXPECT_TRUE(talk.hear("581#410810000A000000"));
  EXPECT_EQ(talk.said(), Texts{"601#6000000000000000"});
  EXPECT_TRUE(talk.hear("581#0044726976652041"));
  EXPECT_EQ(talk.said(), Texts{"601#7000000000000000"});
  EXPECT_TRUE(talk.hear("581#1942424200000000"));
  EXPECT_EQ(talk.client.take_result()->bytes, "Drive ABBB");
}

TEST(SdoClient, writes_text_in_segments) {
  Talk talk;
  talk.client.write({0x2000, 1}, std::string("abcdefghi"), talk.now_ns);
  EXPECT_EQ(talk.said(), Texts{"601#2100200109000000"});
  EXPECT_TRUE(talk.hear("581#6000200100000000"));
  EXPECT_EQ(talk.said(), Texts{"601#0061626364656667"});
  EXPECT_TRUE(talk.hear("581#2000000000000000"));
  EXPECT_EQ(talk.said(), Texts{"601#1B68690000000000"});
  EXPECT_TRUE(talk.hear("581#3000000000000000"));
  EXPECT_EQ(talk.client.take_result()->outcome, SdoResult::Outcome::Done);
}

TEST(SdoClient, a_toggle_bit_that_stands_still_aborts) {
  Talk talk;
  talk.client.read({0x1008, 0}, talk.now_ns);
  talk.hear("581#410810000A000000");
  talk.said();
  EXPECT_TRUE(talk.hear("581#1044726976652041"));
  EXPECT_EQ(talk.said(), Texts{"601#8008100000000305"});
  EXPECT_EQ(talk.client.take_result()->abort_code, sdo_abort::kToggle);
}

TEST(SdoClient, a_value_that_never_ends_aborts) {
  Talk talk;
  talk.client.read({0x1008, 0}, talk.now_ns);
  talk.hear("581#4008100000000000");
  for (int i = 0; i < 100 && talk.client.is_busy(); ++i) {
    talk.hear(i % 2 == 0 ? "581#0041414141414141" : "581#1041414141414141");
  }
  EXPECT_EQ(talk.client.take_result()->abort_code, sdo_abort::kMemory);
}

TEST(SdoClient, an_abort_says_why) {
  Talk talk;
  talk.client.write({0x6041, 0}, ObjectValue{0, 2}, talk.now_ns);
  EXPECT_TRUE(talk.hear("581#8041600002000106"));
  const auto result = talk.client.take_result();
  ASSERT_TRUE(result);
  EXPECT_EQ(describe(*result), "write 6041:0: refused, 06010002 (read-only)");
  EXPECT_FALSE(result->is_missing());
}

TEST(SdoClient, is_silent_after_a_time_out_and_asks_once_more) {
  Talk talk;
  talk.client.read({0x6041, 0}, talk.now_ns);
  talk.said();
  talk.wait(kTimeout_ns);
  EXPECT_EQ(talk.said(), Texts{"601#8041600000000405"});
  talk.wait(kTimeout_ns / 2);
  EXPECT_FALSE(talk.hear("581#4B41600040020000"));  // late
  EXPECT_FALSE(talk.client.take_result());
  talk.wait(kTimeout_ns / 2);
  EXPECT_EQ(talk.said(), Texts{"601#4041600000000000"});
  EXPECT_TRUE(talk.hear("581#4B41600037060000"));
  EXPECT_EQ(talk.client.take_result()->number(), 0x0637U);
}

TEST(SdoClient, gives_up_after_the_second_time_out) {
  Talk talk;
  talk.client.read({0x6041, 0}, talk.now_ns);
  for (int i = 0; i < 3; ++i) talk.wait(kTimeout_ns);
  const auto result = talk.client.take_result();
  ASSERT_TRUE(result);
  EXPECT_EQ(describe(*result), "read 6041:0: no answer");
  EXPECT_FALSE(talk.client.is_busy());
}

TEST(SdoClient, a_late_answer_is_never_the_answer_to_the_next_request) {
  Talk talk;
  talk.client.read({0x6041, 0}, talk.now_ns);
  for (int i = 0; i < 3; ++i) talk.wait(kTimeout_ns);
  talk.client.take_result();
  talk.said();
  talk.client.read({0x6041, 0}, talk.now_ns);
  EXPECT_TRUE(talk.said().empty());
  EXPECT_FALSE(talk.hear("581#4B41600040020000"));
  talk.wait(kTimeout_ns);
  EXPECT_EQ(talk.said(), Texts{"601#4041600000000000"});
  EXPECT_TRUE(talk.hear("581#4B41600037060000"));
  EXPECT_EQ(talk.client.take_result()->number(), 0x0637U);
}

TEST(SdoClient, answers_about_another_object_or_to_nobody_are_not_taken) {
  Talk talk;
  EXPECT_FALSE(talk.hear("581#4B41600037060000"));
  talk.client.read({0x6041, 0}, talk.now_ns);
  EXPECT_FALSE(talk.hear("581#4B6C600037060000"));
  EXPECT_FALSE(talk.hear("581#8000600000000206"));
  EXPECT_FALSE(talk.hear("581#6041600000000000"));
  EXPECT_TRUE(talk.hear("581#4B41600037060000"));
}

TEST(SdoClient, every_broken_bit_of_an_answer_is_survived) {
  for (std::size_t bit = 0; bit < 32; ++bit) {
    Talk talk;
    talk.client.read({0x6041, 0}, talk.now_ns);
    CanFrame broken = frame_of("581#4B41600037060000");
    broken.data[bit / 8] = static_cast<std::uint8_t>(broken.data[bit / 8] ^ 1U << bit % 8);
    talk.client.on_frame(broken, talk.now_ns);
    talk.client.take_result();
    for (int i = 0; i < 5; ++i) talk.wait(kTimeout_ns);
    talk.client.take_result();
    ASSERT_FALSE(talk.client.is_busy()) << bit;
    talk.client.read({0x6041, 0}, talk.now_ns);
    ASSERT_TRUE(talk.hear("581#4B41600037060000")) << bit;
    EXPECT_EQ(talk.client.take_result()->number(), 0x0637U) << bit;
  }
}

}  // namespace
}  // namespace stairway::drivers
