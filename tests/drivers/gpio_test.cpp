// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "drivers/gpio/encoder_lines.hpp"
#include "drivers/gpio/kernel_edge_port.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;
using namespace drivers;

gpio_v2_line_event event(std::uint32_t number, std::uint32_t offset, HostStamp stamp_ns, bool is_rising = true) {
  gpio_v2_line_event event{};
  event.seqno = number;
  event.offset = offset;
  event.timestamp_ns = static_cast<std::uint64_t>(stamp_ns);
  event.id = is_rising ? GPIO_V2_LINE_EVENT_RISING_EDGE : GPIO_V2_LINE_EVENT_FALLING_EDGE;
  return event;
}

TEST(EdgeMerger, holds_edges_back_until_older_ones_must_have_come) {
  EdgeMerger merger;
  merger.add({5'000'000, EncoderLine::A, true});
  EXPECT_TRUE(merger.release(5'000'000).edges.empty());
  EXPECT_FALSE(merger.is_empty());
  merger.add({4'900'000, EncoderLine::B, true});
  const EdgeBatch batch = merger.release(6'000'000);
  ASSERT_EQ(batch.edges.size(), 2U);
  EXPECT_EQ(batch.edges[0].line, EncoderLine::B);
  EXPECT_EQ(batch.complete_ns, 5'000'000);
  EXPECT_TRUE(merger.is_empty());
}

TEST(EdgeMerger, completeness_does_not_go_back) {
  EdgeMerger merger;
  EXPECT_EQ(merger.release(9'000'000).complete_ns, 8'000'000);
  EXPECT_EQ(merger.release(3'000'000).complete_ns, 8'000'000);
}

TEST(KernelEvents, lost_ones_are_known_by_their_numbers) {
  const std::array<std::uint32_t, 3> offsets{17, 4, 9};
  EdgeMerger merger;
  std::optional<std::uint32_t> expected = 1;
  const std::array first{event(1, 17, 10), event(2, 4, 20, false), event(5, 9, 30)};
  EXPECT_EQ(take_kernel_events(first, offsets, expected, merger), 2U);
  const std::array second{event(6, 99, 40), event(10, 4, 50)};
  EXPECT_EQ(take_kernel_events(second, offsets, expected, merger), 3U);
  const EdgeBatch batch = merger.release(1'000'100);
  ASSERT_EQ(batch.edges.size(), 4U);
  EXPECT_EQ(batch.edges[0].line, EncoderLine::A);
  EXPECT_TRUE(batch.edges[0].is_rising);
  EXPECT_EQ(batch.edges[1].line, EncoderLine::B);
  EXPECT_FALSE(batch.edges[1].is_rising);
  EXPECT_EQ(batch.edges[2].line, EncoderLine::Index);
  EXPECT_EQ(batch.edges[3].stamp_ns, 50);
}

TEST(KernelEvents, numbers_wrap) {
  const std::array<std::uint32_t, 1> offsets{0};
  EdgeMerger merger;
  std::optional<std::uint32_t> expected = 0xffffffff;
  EXPECT_EQ(take_kernel_events(std::array{event(0xffffffff, 0, 1), event(0, 0, 2)}, offsets, expected, merger), 0U);
  EXPECT_EQ(take_kernel_events(std::array{event(2, 0, 3)}, offsets, expected, merger), 1U);
}

class KernelPort : public testing::Test {
 protected:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_NONBLOCK | O_CLOEXEC), 0);
    writer = FileDescriptor(ends[1]);
    port = std::make_unique<KernelEdgePort>(FileDescriptor(ends[0]), std::vector<std::uint32_t>{3, 4, 5}, 768);
  }
  void send(const gpio_v2_line_event& what) {
    ASSERT_EQ(::write(writer.get(), &what, sizeof(what)), static_cast<ssize_t>(sizeof(what)));
  }
  FileDescriptor writer;
  std::unique_ptr<KernelEdgePort> port;
};

TEST_F(KernelPort, gives_edges_in_order_and_tells_what_is_missing) {
  const HostStamp now_ns = monotonic_now_ns() - 10'000'000;
  send(event(1, 4, now_ns + 100));
  send(event(2, 3, now_ns));
  send(event(4, 3, now_ns + 200, false));
  const auto batch = port->read(1s);
  ASSERT_TRUE(batch);
  ASSERT_EQ(batch->edges.size(), 3U);
  EXPECT_EQ(batch->edges[0].line, EncoderLine::A);
  EXPECT_EQ(batch->edges[1].line, EncoderLine::B);
  EXPECT_EQ(batch->lost_edges, 1U);
  EXPECT_EQ(port->queued_edges(), 256);
}

TEST_F(KernelPort, gives_more_edges_than_one_read_takes) {
  const HostStamp now_ns = monotonic_now_ns() - 10'000'000;
  for (std::uint32_t i = 1; i <= 200; ++i) send(event(i, 3, now_ns + i, i % 2 == 1));
  const auto batch = port->read(1s);
  ASSERT_TRUE(batch);
  EXPECT_EQ(batch->edges.size(), 200U);
  EXPECT_EQ(batch->lost_edges, 0U);
}

TEST_F(KernelPort, an_empty_wait_is_no_error) {
  const auto batch = port->read(1ms);
  ASSERT_TRUE(batch);
  EXPECT_TRUE(batch->edges.empty());
  EXPECT_GT(batch->complete_ns, 0);
}

TEST_F(KernelPort, a_chip_that_went_away_closes_it) {
  { const FileDescriptor old = std::move(writer); }
  EXPECT_EQ(port->read(1s).error(), PortError::Closed);
  EXPECT_EQ(port->levels().error(), PortError::Closed);
}

TEST(GpioLines, says_what_is_missing) {
  const auto folder = std::filesystem::temp_directory_path() / ("gpio-test-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  EncoderOptions options;
  options.chip = "encoder";
  EXPECT_NE(find_gpio_lines(options, folder).error().find("has no GPIO chip"), std::string::npos);
  std::ofstream(folder / "gpiochip0") << "no chip";
  EXPECT_NE(find_gpio_lines(options, folder).error().find("there are gpiochip0"), std::string::npos);
  options.chip = "gpiochip0";
  EXPECT_NE(find_gpio_lines(options, folder).error().find("is not a GPIO chip"), std::string::npos);
  options.chip = (folder / "gpiochip7").string();
  EXPECT_NE(find_gpio_lines(options, folder).error().find("does not exist"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(EncoderLines, without_a_chip_give_a_reason_by_every_access) {
  EncoderOptions options;
  options.chip = "no-such-chip";
  for (const GpioAccess access : {GpioAccess::Auto, GpioAccess::Libgpiod, GpioAccess::Kernel}) {
    options.access = access;
    const auto port = open_encoder_lines(options);
    ASSERT_FALSE(port);
    EXPECT_NE(port.error().find("encoder.chip"), std::string::npos);
  }
}

}  // namespace
}  // namespace stairway::test
