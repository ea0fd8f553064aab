// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/sync_pulse_reader.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using drivers::EdgeBatch;
using drivers::EncoderLine;
using drivers::HostStamp;
using drivers::PortError;

/// What the line gives at each read; closed when nothing is left.
class ScriptedLine final : public drivers::EdgePort {
 public:
  explicit ScriptedLine(std::deque<EdgeBatch>& batches) : batches_(batches) {}
  tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds) override {
    if (batches_.empty()) return tl::unexpected(PortError::Closed);
    EdgeBatch batch = batches_.front();
    batches_.pop_front();
    return batch;
  }
  tl::expected<drivers::LineLevels, PortError> levels() override { return drivers::LineLevels{}; }
  int queued_edges() const override { return 16; }

 private:
  std::deque<EdgeBatch>& batches_;
};

class SilentScanner final : public drivers::BytePort {
 public:
  tl::expected<drivers::ByteChunk, PortError> read(std::chrono::nanoseconds) override {
    return drivers::ByteChunk{.arrival_ns = 100, .bytes = "scan"};
  }
  tl::expected<void, PortError> write(std::string_view) override { return {}; }
};

class SyncPulseReaderTest : public testing::Test {
 protected:
  EdgeBatch pulse(HostStamp stamp_ns) {
    return {{{stamp_ns, EncoderLine::A, false}, {stamp_ns + 1'000'000, EncoderLine::A, true}}, 0, stamp_ns};
  }

  std::deque<EdgeBatch> batches;
  int refusals = 0;
  HostStamp now_ns = 0;
  std::vector<HostStamp> pulses;
  std::vector<std::string> problems;
  std::shared_ptr<SyncPulseReader> reader = std::make_shared<SyncPulseReader>(
      drivers::PortOpener<drivers::EdgePort>{[this]() -> tl::expected<std::unique_ptr<drivers::EdgePort>, std::string> {
        if (refusals-- > 0) return tl::unexpected(std::string("no chip"));
        return std::make_unique<ScriptedLine>(batches);
      }},
      [this] { return now_ns; }, [this](HostStamp stamp_ns) { pulses.push_back(stamp_ns); },
      [this](const std::string& problem) { problems.push_back(problem); });
};

TEST_F(SyncPulseReaderTest, beginning_of_every_pulse_is_told_before_the_bytes_behind_it) {
  batches = {pulse(50), pulse(75)};
  const auto opener = with_sync_pulses({[]() -> tl::expected<std::unique_ptr<drivers::BytePort>, std::string> {
                                         return std::make_unique<SilentScanner>();
                                       }},
                                       reader);
  const auto scanner = opener.open();
  ASSERT_TRUE(scanner);
  EXPECT_EQ((*scanner)->read(1ms)->bytes, "scan");
  EXPECT_EQ(pulses, std::vector<HostStamp>{50});
  EXPECT_TRUE((*scanner)->read(1ms));
  EXPECT_EQ(pulses, (std::vector<HostStamp>{50, 75}));
  EXPECT_TRUE(problems.empty());
}

TEST_F(SyncPulseReaderTest, line_that_fails_some_times_is_told_and_tried_again_every_ten_seconds) {
  batches = {pulse(50)};
  refusals = 3;
  for (; now_ns < 35'000'000'000; now_ns += 25'000'000) reader->drain();
  EXPECT_EQ(pulses, std::vector<HostStamp>{50});
  ASSERT_EQ(problems.size(), 4u) << "three refusals, and the end of the script";
  EXPECT_NE(problems.front().find("no chip"), std::string::npos);
  EXPECT_NE(problems.back().find("went away"), std::string::npos);
  batches = {pulse(99)};
  now_ns += 10'000'000'000;
  reader->drain();
  EXPECT_EQ(pulses.back(), 99);
}

TEST_F(SyncPulseReaderTest, scanner_that_is_missing_is_still_missing) {
  const auto opener = with_sync_pulses({[]() -> tl::expected<std::unique_ptr<drivers::BytePort>, std::string> {
                                         return tl::unexpected(std::string("none"));
                                       }},
                                       reader);
  EXPECT_EQ(opener.open().error(), "none");
}

}  // namespace
}  // namespace stairway::daemon
