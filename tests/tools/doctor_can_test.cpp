// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <cstring>
#include <deque>

#include "tools/doctor/can.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

using Bytes = std::vector<std::byte>;

template <typename Value>
void append(Bytes& bytes, const Value& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

void append_attribute(Bytes& bytes, unsigned short type, const Bytes& payload) {
  append(bytes, rtattr{static_cast<unsigned short>(RTA_LENGTH(payload.size())), type});
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  bytes.resize((bytes.size() + 3) / 4 * 4);
}

template <typename Value>
Bytes bytes_of(const Value& value) {
  Bytes bytes;
  append(bytes, value);
  return bytes;
}

Bytes bytes_of(const char* text) {
  const auto* first = reinterpret_cast<const std::byte*>(text);
  return {first, first + std::strlen(text) + 1};
}

/// What the kernel says about a CAN controller at 500 kbit/s.
Bytes link_message(std::uint32_t state) {
  can_bittiming timing{};
  timing.bitrate = 500'000;
  Bytes data, info, attributes;
  append_attribute(data, IFLA_CAN_BITTIMING, bytes_of(timing));
  append_attribute(data, IFLA_CAN_STATE, bytes_of(state));
  append_attribute(data, IFLA_CAN_RESTART_MS, bytes_of(std::uint32_t{100}));
  append_attribute(info, IFLA_INFO_KIND, bytes_of("can"));
  append_attribute(info, IFLA_INFO_DATA, data);
  append_attribute(attributes, IFLA_IFNAME, bytes_of("can0"));
  append_attribute(attributes, IFLA_TXQLEN, bytes_of(std::uint32_t{100}));
  append_attribute(attributes, IFLA_LINKINFO, info);
  nlmsghdr header{};
  header.nlmsg_len = static_cast<std::uint32_t>(NLMSG_LENGTH(sizeof(ifinfomsg)) + attributes.size());
  header.nlmsg_type = RTM_NEWLINK;
  ifinfomsg body{};
  body.ifi_type = ARPHRD_CAN;
  body.ifi_flags = IFF_UP;
  Bytes message = bytes_of(header);
  append(message, body);
  message.insert(message.end(), attributes.begin(), attributes.end());
  return message;
}

TEST(DoctorCanLink, reads_what_the_kernel_says) {
  const auto link = parse_link_message(link_message(CAN_STATE_ERROR_PASSIVE));
  ASSERT_TRUE(link);
  EXPECT_EQ(link->name, "can0");
  EXPECT_EQ(link->kind, "can");
  EXPECT_TRUE(link->is_can && link->is_up);
  EXPECT_EQ(link->tx_queue_frames, 100U);
  EXPECT_EQ(link->bit_rate, 500'000U);
  EXPECT_EQ(link->bus_state, CanBusState::Passive);
  EXPECT_EQ(link->restart_ms, 100U);
}

TEST(DoctorCanLink, survives_a_message_cut_or_changed_anywhere) {
  const Bytes good = link_message(CAN_STATE_ERROR_ACTIVE);
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(parse_link_message(std::span(good).first(length))) << length;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const int value : {0, 1, 0x7f, 0xff}) {
      Bytes changed = good;
      changed[at] = static_cast<std::byte>(value);
      const auto link = parse_link_message(changed);
      EXPECT_TRUE(!link || link->name.size() < good.size());
    }
  }
}

TEST(DoctorCanLink, asks_the_real_kernel) {
  const auto loopback = read_link("lo");
  if (!loopback) GTEST_SKIP() << "no loopback interface here";
  EXPECT_EQ(loopback->name, "lo");
  EXPECT_FALSE(loopback->is_can);
  EXPECT_FALSE(read_link("no-such-link"));
  EXPECT_FALSE(read_link("a name that no interface may have"));
}

CanFacts good_facts() {
  return {.interface = "can0",
          .no_kernel_support = "",
          .link = LinkInfo{.name = "can0",
                           .kind = "can",
                           .is_can = true,
                           .is_up = true,
                           .tx_queue_frames = 100,
                           .bit_rate = 500'000,
                           .bus_state = CanBusState::Active,
                           .restart_ms = 100},
          .others = {}};
}

TEST(DoctorCan, every_fault_has_its_words) {
  struct Case {
    std::function<void(CanFacts&)> change;
    const char* name;
    State state;
    const char* part;
  };
  const Case table[] = {
      {[](auto&) {}, "can-bus", State::Ok, "error-active"},
      {[](auto& f) { f.no_kernel_support = "Address family not supported"; }, "can", State::Failure,
       "modprobe can-raw"},
      {[](auto& f) { f.link.reset(), f.others = {"can3"}; }, "can-link", State::Failure, "there is can3"},
      {[](auto& f) { f.link->is_can = false; }, "can-link", State::Failure, "no CAN interface"},
      {[](auto& f) { f.link->is_up = false; }, "can-link", State::Failure, "ip link set can0 up"},
      {[](auto& f) { f.link->tx_queue_frames = 10; }, "can-link", State::Warning, "txqueuelen 100"},
      {[](auto& f) { f.link->restart_ms = 0; }, "can-bus", State::Warning, "restart-ms 100"},
      {[](auto& f) { f.link->bus_state = CanBusState::Passive; }, "can-bus", State::Warning, "120 ohm"},
      {[](auto& f) { f.link->bus_state = CanBusState::BusOff; }, "can-bus", State::Failure, "type can restart"},
      {[](auto& f) { f.link->bus_state = CanBusState::Stopped; }, "can-bus", State::Failure, "down, then up"},
      {[](auto& f) { f.link->bus_state.reset(); }, "can-bus", State::Skipped, "virtual"},
  };
  for (const Case& row : table) {
    SCOPED_TRACE(row.part);
    CanFacts facts = good_facts();
    row.change(facts);
    const auto checks = judge(facts);
    const auto worst =
        std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return check.name == row.name; });
    ASSERT_NE(worst, checks.end());
    EXPECT_EQ(worst->state, row.state) << worst->text;
    EXPECT_NE((worst->text + worst->remedy).find(row.part), std::string::npos) << worst->text << worst->remedy;
  }
}

/// A bus on which arrivals are as scripted; a read without one lets its time pass.
class ScriptedBus : public CanPort {
 public:
  explicit ScriptedBus(HostStamp& now_ns) : now_ns_(now_ns) {}

  tl::expected<std::vector<CanArrival>, PortError> read(std::chrono::nanoseconds timeout) override {
    if (arrivals.empty()) {
      if (is_removed) return tl::unexpected(PortError::Closed);
      now_ns_ += timeout.count();
      return std::vector<CanArrival>{};
    }
    const CanArrival first = arrivals.front();
    arrivals.pop_front();
    now_ns_ += 10'000'000;
    return std::vector<CanArrival>{first};
  }
  tl::expected<void, PortError> write(const CanFrame& frame) override {
    sent.push_back(frame);
    return {};
  }

  std::deque<CanArrival> arrivals;
  std::vector<CanFrame> sent;
  bool is_removed = false;

 private:
  HostStamp& now_ns_;
};

struct Drive {
  HostStamp now_ns = 5'000'000'000;
  ScriptedBus bus{now_ns};

  void hears(std::variant<CanFrame, CanCondition> what) { bus.arrivals.push_back({0, what}); }
  DriveFacts listen(bool may_ask) {
    return listen_for_drive(bus, 1, may_ask, std::chrono::seconds(2), [this] { return now_ns; });
  }
};

TEST(DoctorDrive, a_heartbeat_ends_the_wait_and_nothing_is_sent) {
  Drive drive;
  drive.hears(CanFrame{0x701, 1, {0x05}});
  const DriveFacts facts = drive.listen(false);
  EXPECT_EQ(facts.heartbeat, 0x05);
  EXPECT_TRUE(drive.bus.sent.empty());
  EXPECT_LT(drive.now_ns, 6'000'000'000);
  EXPECT_EQ(judge(facts).state, State::Ok);
  EXPECT_EQ(judge(facts).text, "node 1 is operational");
}

TEST(DoctorDrive, is_asked_for_its_type_and_answers) {
  struct Case {
    CanFrame answer;
    State state;
    const char* part;
  };
  const Case table[] = {
      {{0x581, 8, {0x43, 0x00, 0x10, 0x00, 0x92, 0x01, 0x02, 0x00}}, State::Ok, "00020192"},
      {{0x581, 8, {0x43, 0x00, 0x10, 0x00, 0x91, 0x01, 0x00, 0x00}}, State::Failure, "no CiA 402 drive"},
      {{0x581, 8, {0x80, 0x00, 0x10, 0x00, 0x00, 0x00, 0x02, 0x06}}, State::Failure, "06020000"},
      {{0x581, 8, {0x43, 0x41, 0x60, 0x00, 0x92, 0x01, 0x02, 0x00}}, State::Failure, "silent even when asked"},
      {{0x582, 8, {0x43, 0x00, 0x10, 0x00, 0x92, 0x01, 0x02, 0x00}}, State::Failure, "silent even when asked"},
  };
  for (const Case& row : table) {
    SCOPED_TRACE(row.part);
    Drive drive;
    drive.hears(row.answer);
    const Check check = judge(drive.listen(true));
    ASSERT_EQ(drive.bus.sent.size(), 1U);
    EXPECT_EQ(drive.bus.sent.front(), (CanFrame{0x601, 8, {0x40, 0x00, 0x10, 0x00}}));
    EXPECT_EQ(check.state, row.state) << check.text;
    EXPECT_NE(check.text.find(row.part), std::string::npos) << check.text;
  }
}

TEST(DoctorDrive, silence_is_told_by_what_else_is_heard) {
  Drive quiet;
  EXPECT_EQ(judge(quiet.listen(false)).state, State::Warning);
  EXPECT_NE(judge(quiet.listen(false)).remedy.find("--probe"), std::string::npos);

  Drive others;
  others.hears(CanFrame{0x703, 1, {0x05}});
  EXPECT_NE(judge(others.listen(false)).text.find("node 3 is heard"), std::string::npos);

  Drive unheard;
  unheard.hears(CanCondition::Unheard);
  EXPECT_NE(judge(unheard.listen(true)).text.find("nobody acknowledges"), std::string::npos);

  Drive removed;
  removed.bus.is_removed = true;
  EXPECT_EQ(judge(removed.listen(false)).state, State::Warning) << "and it comes to an end";
}

}  // namespace
}  // namespace stairway::doctor
