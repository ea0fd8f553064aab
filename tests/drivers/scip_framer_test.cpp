// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_framer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/drivers/scip_samples.hpp"

namespace stairway::drivers {
namespace {

std::vector<std::string> frame(ScipFramer& framer, std::string_view bytes, HostStamp arrival_ns = 0) {
  std::vector<std::string> blocks;
  framer.add(bytes, arrival_ns, [&](const ScipBlock& block) { blocks.emplace_back(block.text); });
  return blocks;
}

TEST(ScipFramer, gives_the_same_messages_however_the_bytes_are_cut) {
  const std::string stream = samples::kVersion + samples::kMd + samples::kMe + samples::kMd;
  for (std::size_t length = 1; length < 140; ++length) {
    SCOPED_TRACE(length);
    ScipFramer framer;
    std::vector<std::string> blocks;
    for (std::size_t at = 0; at < stream.size(); at += length) {
      for (std::string& block : frame(framer, std::string_view(stream).substr(at, length))) {
        blocks.push_back(std::move(block) + "\n");
      }
    }
    ASSERT_EQ(blocks, (std::vector<std::string>{samples::kVersion, samples::kMd, samples::kMe, samples::kMd}));
  }
}

TEST(ScipFramer, skips_empty_lines_between_messages) {
  ScipFramer framer;
  EXPECT_EQ(frame(framer, "\n\n\nQT\n00P\n\n\n\nBM\n").size(), 1U);
  EXPECT_EQ(frame(framer, "00P\n\n"), std::vector<std::string>{"BM\n00P\n"});
}

TEST(ScipFramer, drops_a_message_without_end_and_goes_on_behind_it) {
  ScipFramer framer(100);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(frame(framer, "0123456789\n0123456789").empty());
  EXPECT_EQ(framer.overflows(), 1U);
  EXPECT_EQ(frame(framer, "\n\nQT\n00P\n\n"), std::vector<std::string>{"QT\n00P\n"});
}

TEST(ScipFramer, says_whether_a_message_has_an_arrival_of_its_own) {
  ScipFramer framer;
  std::vector<std::pair<HostStamp, bool>> arrivals;
  const auto keep = [&](const ScipBlock& block) { arrivals.emplace_back(block.arrival_ns, block.is_arrival_exact); };
  framer.add("QT\n00", 10, keep);
  framer.add("P\n\nBM\n00P\n\n", 20, keep);
  framer.add("RS\n00P\n\n", 30, keep);
  EXPECT_EQ(arrivals, (std::vector<std::pair<HostStamp, bool>>{{10, true}, {20, false}, {30, true}}));
}

}  // namespace
}  // namespace stairway::drivers
