// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/can/socket_can_port.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "drivers/can/raw_can_frame.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::milliseconds;

can_frame error_frame(canid_t classes, std::uint8_t controller = 0) {
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | classes;
  raw.len = CAN_ERR_DLC;
  raw.data[1] = controller;
  return raw;
}

TEST(RawCanFrame, error_frames_become_conditions) {
  struct Case {
    can_frame raw;
    std::vector<CanCondition> conditions;
  };
  const Case cases[] = {
      {error_frame(0x001), {CanCondition::TransmitStuck}},
      {error_frame(0x004, 0x01), {CanCondition::Overrun}},
      {error_frame(0x004, 0x02), {CanCondition::TransmitStuck}},
      {error_frame(0x004, 0x04), {CanCondition::Warning}},
      {error_frame(0x004, 0x08), {CanCondition::Warning}},
      {error_frame(0x004, 0x10), {CanCondition::Passive}},
      {error_frame(0x004, 0x20), {CanCondition::Passive}},
      {error_frame(0x004, 0x40), {CanCondition::Active}},
      {error_frame(0x020), {CanCondition::Unheard}},
      {error_frame(0x040), {CanCondition::BusOff}},
      {error_frame(0x100), {CanCondition::Restarted}},
      {error_frame(0x064, 0x30), {CanCondition::Passive, CanCondition::Unheard, CanCondition::BusOff}},
      {error_frame(0x002), {}},
      {error_frame(0x088, 0xff), {}},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.raw.can_id);
    const auto arrivals = from_raw_frame(one.raw);
    ASSERT_EQ(arrivals.size(), one.conditions.size());
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      EXPECT_EQ(std::get<CanCondition>(arrivals[i]), one.conditions[i]);
    }
  }
}

TEST(RawCanFrame, frames_go_both_ways) {
  const CanFrame frame{0x601, 3, {1, 2, 3}};
  const can_frame raw = to_raw_frame(frame);
  EXPECT_EQ(raw.can_id, 0x601U);
  EXPECT_EQ(raw.len, 3);
  const auto arrivals = from_raw_frame(raw);
  ASSERT_EQ(arrivals.size(), 1U);
  EXPECT_EQ(std::get<CanFrame>(arrivals[0]), frame);
}

TEST(RawCanFrame, what_canopen_does_not_have_is_left_out) {
  can_frame raw{};
  raw.can_id = 0x601 | CAN_EFF_FLAG;
  EXPECT_TRUE(from_raw_frame(raw).empty());
  raw.can_id = 0x601 | CAN_RTR_FLAG;
  EXPECT_TRUE(from_raw_frame(raw).empty());
  raw.can_id = 0x601;
  raw.len = 9;
  EXPECT_TRUE(from_raw_frame(raw).empty());
  raw.len = 8;
  EXPECT_FALSE(from_raw_frame(raw).empty());
}

TEST(RawCanFrame, filters_let_the_node_and_other_masters_through) {
  std::vector<canid_t> ids;
  for (const can_filter& filter : raw_filters(5, 127)) {
    EXPECT_EQ(filter.can_mask, 0xC00007FFU);
    ids.push_back(filter.can_id);
  }
  EXPECT_EQ(ids, (std::vector<canid_t>{0x000, 0x085, 0x185, 0x285, 0x585, 0x605, 0x705, 0x77F}));
}

// A pair of local sockets keeps messages apart as a CAN socket does.
struct SocketPair {
  SocketPair() {
    int sockets[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, sockets), 0);
    other = sockets[1];
    port = std::make_unique<SocketCanPort>(sockets[0], [this] { return link; });
  }
  ~SocketPair() {
    if (other >= 0) close(other);
  }
  void say(const CanFrame& frame) {
    const can_frame raw = to_raw_frame(frame);
    ASSERT_EQ(write(other, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
  }

  int other = -1;
  CanLink link = CanLink::Up;
  std::unique_ptr<SocketCanPort> port;
};

TEST(SocketCanPort, reads_all_that_is_there_in_order_and_stamps_it) {
  SocketPair pair;
  const HostStamp before_ns = monotonic_now_ns();
  for (std::uint8_t i = 0; i < 5; ++i) pair.say({0x181, 1, {i}});
  const auto arrivals = pair.port->read(milliseconds(1000));
  ASSERT_TRUE(arrivals);
  ASSERT_EQ(arrivals->size(), 5U);
  for (std::uint8_t i = 0; i < 5; ++i) {
    EXPECT_EQ(std::get<CanFrame>((*arrivals)[i].what), (CanFrame{0x181, 1, {i}}));
    EXPECT_GE((*arrivals)[i].arrival_ns, before_ns);
    EXPECT_LE((*arrivals)[i].arrival_ns, monotonic_now_ns());
  }
}

TEST(SocketCanPort, an_empty_wait_gives_nothing) {
  SocketPair pair;
  const auto arrivals = pair.port->read(milliseconds(1));
  ASSERT_TRUE(arrivals);
  EXPECT_TRUE(arrivals->empty());
}

TEST(SocketCanPort, a_short_read_is_an_error_and_the_next_frame_is_read) {
  SocketPair pair;
  ASSERT_EQ(write(pair.other, "short", 5), 5);
  pair.say({0x701, 1, {5}});
  const auto failed = pair.port->read(milliseconds(1000));
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error(), PortError::Io);
  const auto arrivals = pair.port->read(milliseconds(1000));
  ASSERT_TRUE(arrivals);
  ASSERT_EQ(arrivals->size(), 1U);
}

TEST(SocketCanPort, writes_whole_frames) {
  SocketPair pair;
  ASSERT_TRUE(pair.port->write({0x201, 2, {0x0f, 0x00}}));
  can_frame raw{};
  ASSERT_EQ(read(pair.other, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
  EXPECT_EQ(raw.can_id, 0x201U);
  EXPECT_EQ(raw.len, 2);
  EXPECT_EQ(raw.data[0], 0x0f);
}

TEST(SocketCanPort, a_full_queue_fails_after_a_while_and_works_again_when_it_is_read) {
  SocketPair pair;
  int placed = 0;
  while (pair.port->write({0x201, 0, {}})) ASSERT_LT(++placed, 100000);
  const auto refused = pair.port->write({0x201, 0, {}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), PortError::Io);
  can_frame raw{};
  for (int i = 0; i < placed; ++i) ASSERT_EQ(read(pair.other, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
  EXPECT_TRUE(pair.port->write({0x201, 0, {}}));
}

TEST(SocketCanPort, is_closed_for_good_when_the_interface_goes) {
  SocketPair pair;
  close(pair.other);
  pair.other = -1;
  for (int i = 0; i < 2; ++i) {
    const auto arrivals = pair.port->read(milliseconds(1000));
    ASSERT_FALSE(arrivals);
    EXPECT_EQ(arrivals.error(), PortError::Closed);
  }
  EXPECT_EQ(pair.port->write({0x201, 0, {}}).error(), PortError::Closed);
}

TEST(SocketCanPort, an_interface_that_is_not_there_has_a_reason) {
  const auto port = open_socket_can({.interface = "nocan77"});
  ASSERT_FALSE(port);
  const bool is_named = port.error().find("nocan77 does not exist") != std::string::npos;
  EXPECT_TRUE(is_named || port.error().find("this kernel has no CAN") != std::string::npos) << port.error();
}

}  // namespace
}  // namespace stairway::drivers
