// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "drivers/can/raw_can_frame.hpp"
#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/motor_session.hpp"
#include "tests/fuzz/targets.hpp"
#include "tools/sim/fake_can_bus.hpp"
#include "tools/sim/fake_drive.hpp"

namespace stairway::fuzz {
namespace {

using namespace drivers;

constexpr HostStamp kMs = 1'000'000;
constexpr HostStamp kPoll_ns = 20 * kMs;
constexpr HostStamp kPauses_ns[] = {0, kMs, 10 * kMs, 50 * kMs, 200 * kMs, 1000 * kMs, 4000 * kMs, 10'000 * kMs};
constexpr double kSpeeds_rad_s[] = {0.0,
                                    0.18,
                                    -0.18,
                                    6.3,
                                    1e9,
                                    -1e30,
                                    std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::quiet_NaN()};
constexpr double kSpeed_rad_s = 0.2;
constexpr double kSpeedTolerance_rad_s = 1e-3;
constexpr HostStamp kRecovery_ns = 60'000 * kMs;
constexpr std::size_t kMaxDetail = 512;
constexpr std::size_t kMaxFrames = 32;

enum Action : std::uint8_t {
  AnyFrame,     ///< heard by the host alone
  RawFrame,     ///< likewise, as the kernel hands it out, error frames among them
  DriveFrame,   ///< likewise, with an identifier of the drive
  SdoAnswer,    ///< to whatever was asked last
  OtherMaster,  ///< heard by host and drive
  Condition,
  Run,
  Pause,
  Speed,
  Request,
  Wire,
  DriveFault,
  kActions,
};

MotorOptions options() {
  MotorOptions options;
  options.max_backoff_s = 1.0;
  options.fault_reset_window_s = 1.0;
  require(options.problem().empty(), "the options of the test are usable");
  return options;
}

/// A session and a drive in order on a bus, between which the fuzzer may say and break what it likes.
class Bench {
 public:
  Bench() { poll(); }

  void hear(std::variant<CanFrame, CanCondition> what) {
    const CanArrival arrival{now_ns_, what};
    take(session_.on_arrivals({&arrival, 1}, now_ns_));
    send();
  }

  void run(HostStamp duration_ns) {
    for (const HostStamp end_ns = now_ns_ + duration_ns; now_ns_ < end_ns; poll()) now_ns_ += kPoll_ns;
  }
  void pause(HostStamp pause_ns) {
    now_ns_ += pause_ns;
    poll();
  }

  void poll() {
    const auto arrivals = bus.take(now_ns_);
    take(arrivals ? session_.on_arrivals(*arrivals, now_ns_) : session_.on_disconnect(now_ns_, "removed"));
    send();
  }

  void send() {
    const std::vector<CanFrame> output = session_.take_output();
    require(output.size() <= kMaxFrames, "one step sends a few frames at most");
    for (const CanFrame& frame : output) {
      check(frame);
      if (bus.write(frame, now_ns_)) continue;
      take(session_.on_unsent(now_ns_));
      break;
    }
  }

  /// However it was left, a drive in order turns again, and stops when it is told to.
  void recover() {
    drive.faults() = {};
    bus.set_removed(false);
    bus.set_link(true, now_ns_);
    bus.set_bus_off(false, now_ns_);
    bus.set_unheard(false, now_ns_);
    drive.power_cycle(now_ns_);
    session_.start();
    set_speed(kSpeed_rad_s);
    const auto is_turning = [&] { return std::abs(drive.disk_speed_rad_s() - kSpeed_rad_s) < kSpeedTolerance_rad_s; };
    const HostStamp turning_by_ns = now_ns_ + kRecovery_ns;
    while (!is_turning() && now_ns_ < turning_by_ns) run(kPoll_ns);
    require(is_turning(), "after garbage, a drive in order turns again");
    session_.stop();
    const HostStamp stopped_by_ns = now_ns_ + kRecovery_ns;
    while (session_.state() != MotorState::Stopped && now_ns_ < stopped_by_ns) run(kPoll_ns);
    require(session_.has_stopped_safely(), "a drive in order says that it has stopped");
    require(std::abs(drive.disk_speed_rad_s()) < kSpeedTolerance_rad_s, "and then the disk stands");
  }

  void set_speed(double speed_rad_s) { session_.set_speed(speed_rad_s); }
  MotorSession& session() { return session_; }
  HostStamp now_ns() const { return now_ns_; }
  const CanFrame& last_request() const { return last_request_; }

  sim::FakeDrive drive{{}};
  sim::FakeCanBus bus{drive};

 private:
  void check(const CanFrame& frame) {
    require(frame.id <= 0x7FF && frame.length <= 8, "frames are of the classic kind");
    if (frame.id == cob::kSdoRequest + 1) last_request_ = frame;
    if (frame.id != cob::kRpdo1 + 1 || session_.wanted_speed_rad_s() != 0.0) return;
    const bool is_still = std::all_of(frame.data.begin() + 2, frame.data.begin() + 6, [](auto b) { return b == 0; });
    require(is_still, "a disk that is to stand is never told to turn");
  }

  static void take(const std::vector<MotorEvent>& events) {
    for (const MotorEvent& event : events) {
      if (const auto* trouble = std::get_if<MotorTroubleEvent>(&event))
        require(!trouble->detail.empty() && trouble->detail.size() <= kMaxDetail, "a trouble is told in one line");
      if (const auto* feedback = std::get_if<DriveFeedback>(&event))
        require(std::isfinite(feedback->angle_rad) && std::isfinite(feedback->speed_rad_s), "feedback is numbers");
    }
  }

  MotorSession session_{options()};
  HostStamp now_ns_ = 5'000 * kMs;
  CanFrame last_request_;
};

CanFrame frame_of(std::uint16_t id, FuzzInput& input) {
  CanFrame frame{.id = id, .length = static_cast<std::uint8_t>(input.byte() % 9)};
  const auto bytes = input.bytes(frame.length);
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

std::uint16_t any_id(FuzzInput& input) {
  return static_cast<std::uint16_t>((input.byte() * 256U + input.byte()) & 0x7FF);
}

void hear_raw(Bench& bench, FuzzInput& input) {
  can_frame raw{};
  for (int shift = 24; shift >= 0; shift -= 8) raw.can_id |= static_cast<canid_t>(input.byte()) << shift;
  raw.len = input.byte();
  const auto bytes = input.bytes(std::size(raw.data));
  std::copy(bytes.begin(), bytes.end(), std::begin(raw.data));
  const auto heard = from_raw_frame(raw);
  require(heard.size() <= 10, "an error frame tells each condition once");
  for (const auto& what : heard) {
    const auto* frame = std::get_if<CanFrame>(&what);
    require(frame == nullptr || (frame->length <= 8 && to_raw_frame(*frame).can_id == (raw.can_id & CAN_SFF_MASK)),
            "frames stay as they are");
    bench.hear(what);
  }
}

std::uint16_t drive_id(FuzzInput& input) {
  constexpr std::uint16_t kIds[] = {cob::kEmergency, cob::kTpdo1, cob::kTpdo2, cob::kSdoAnswer, cob::kHeartbeat};
  return static_cast<std::uint16_t>(kIds[input.byte() % std::size(kIds)] + 1);
}

/// With the right index and subindex, so that it gets past the first look.
CanFrame sdo_answer(const CanFrame& request, FuzzInput& input) {
  CanFrame frame = frame_of(cob::kSdoAnswer + 1, input);
  if (input.byte() % 4 != 0) std::copy_n(request.data.begin() + 1, 3, frame.data.begin() + 1);
  return frame;
}

void ask(MotorSession& session, std::uint8_t what, HostStamp now_ns) {
  switch (what % 4) {
    case 0:
      return session.stop();
    case 1:
      return session.quick_stop();
    case 2:
      return session.start();
    default:
      return session.retry_now(now_ns);
  }
}

void handle_wire(Bench& bench, std::uint8_t what) {
  const bool is_on = (what & 1) != 0;
  switch (what / 2 % 4) {
    case 0:
      return bench.bus.set_link(is_on, bench.now_ns());
    case 1:
      return bench.bus.set_bus_off(is_on, bench.now_ns());
    case 2:
      return bench.bus.set_unheard(is_on, bench.now_ns());
    default:
      return bench.bus.set_removed(is_on);
  }
}

void break_drive(Bench& bench, FuzzInput& input) {
  sim::FakeDriveFaults& faults = bench.drive.faults();
  const std::uint8_t what = input.byte();
  bool* const switches[] = {&faults.is_silent,           &faults.is_deaf,
                            &faults.has_no_heartbeat,    &faults.is_local,
                            &faults.is_torque_off,       &faults.is_quick_stop_input,
                            &faults.is_fault_stuck,      &faults.is_velocity_reversed,
                            &faults.is_status_pdo_short, &faults.is_mode_stuck};
  if (what < std::size(switches)) *switches[what] = !*switches[what];
  if (what == 0x10) bench.drive.power_cycle(bench.now_ns());
  if (what == 0x11) bench.drive.raise_fault(static_cast<std::uint16_t>(input.byte() * 256U), bench.now_ns());
  if (what == 0x12) faults.ramp_share = 0.01 * (1 + input.byte());
  if (what == 0x13) faults.reachable_share = 0.01 * input.byte();
}

void step(Bench& bench, FuzzInput& input) {
  switch (input.byte() % kActions) {
    case AnyFrame:
      return bench.hear(frame_of(any_id(input), input));
    case RawFrame:
      return hear_raw(bench, input);
    case DriveFrame:
      return bench.hear(frame_of(drive_id(input), input));
    case SdoAnswer:
      return bench.hear(sdo_answer(bench.last_request(), input));
    case OtherMaster:
      return bench.bus.add_frame(frame_of(any_id(input), input), bench.now_ns());
    case Condition:
      return bench.hear(static_cast<CanCondition>(input.byte() % (static_cast<int>(CanCondition::LinkUp) + 1)));
    case Run:
      return bench.run((1 + input.byte() % 32) * kPoll_ns);
    case Pause:
      return bench.pause(kPauses_ns[input.byte() % std::size(kPauses_ns)]);
    case Speed:
      return bench.set_speed(kSpeeds_rad_s[input.byte() % std::size(kSpeeds_rad_s)]);
    case Request:
      return ask(bench.session(), input.byte(), bench.now_ns());
    case Wire:
      return handle_wire(bench, input.byte());
    default:
      return break_drive(bench, input);
  }
}

void append_frame(Seed& seed, Action action, const CanFrame& frame) {
  seed.push_back(action);
  seed.push_back(static_cast<std::uint8_t>(frame.id >> 8));
  seed.push_back(static_cast<std::uint8_t>(frame.id & 0xFF));
  seed.push_back(frame.length);
  seed.insert(seed.end(), frame.data.begin(), frame.data.begin() + frame.length);
}

}  // namespace

void run_can(std::span<const std::uint8_t> bytes) {
  FuzzInput input(bytes);
  Bench bench;
  while (!input.is_empty()) step(bench, input);
  bench.recover();
}

std::vector<Seed> can_seeds() {
  // A drive that is found, turns, and stops; one that fails in the ways of the checklist; frames of the documents.
  std::vector<Seed> seeds{
      {Run, 31, Run, 31, Speed, 1, Run, 31, Run, 31, Request, 0, Run, 31},
      {Run, 31, Speed, 2, Run, 31, Request, 1, Run, 20, Request, 2, Run, 31},
      {Run, 31, Wire, 0, Run, 20, Wire, 1, Run, 31, Wire, 3, Run, 9, Wire, 2, Run, 31, Wire, 7, Run, 3, Wire, 6},
  };
  for (std::uint8_t fault = 0; fault <= 0x10; ++fault) {
    seeds.push_back({Speed, 1, Run, 31, Run, 31, DriveFault, fault, Run, 31, Pause, 4, Run, 31});
  }
  seeds.push_back({Speed, 1, Run, 31, Run, 31, DriveFault, 0x11, 0x81, Run, 31, Run, 31});
  Seed frames{Run, 31, Speed, 1, Run, 31};
  for (const CanFrame& frame : {
           CanFrame{0x701, 1, {0x00}},
           CanFrame{0x701, 1, {0x7F}},
           CanFrame{0x701, 1, {0x05}},
           CanFrame{0x581, 8, {0x60, 0x60, 0x60, 0x00}},
           CanFrame{0x581, 8, {0x4B, 0x41, 0x60, 0x00, 0x37, 0x06}},
           CanFrame{0x581, 8, {0x43, 0x18, 0x10, 0x01, 0x78, 0x56, 0x34, 0x12}},
           CanFrame{0x581, 8, {0x80, 0x00, 0x60, 0x00, 0x00, 0x00, 0x02, 0x06}},
           CanFrame{0x581, 8, {0x41, 0x08, 0x10, 0x00, 0x14}},
           CanFrame{0x181, 6, {0x37, 0x06, 0x56, 0xEA}},
           CanFrame{0x181, 6, {0x18, 0x02}},
           CanFrame{0x081, 8, {0x30, 0x81, 0x11}},
       })
    append_frame(frames, AnyFrame, frame);
  seeds.push_back(frames);
  Seed other_master{Run, 31, Speed, 1, Run, 31};
  for (const CanFrame& frame : {
           CanFrame{0x000, 2, {0x81, 0x01}},
           CanFrame{0x000, 2, {0x02, 0x00}},
           CanFrame{0x601, 8, {0x2B, 0x40, 0x60, 0x00, 0x06}},
           CanFrame{0x601, 8, {0x40, 0x41, 0x60, 0x00}},
           CanFrame{0x201, 6, {0x0F, 0x00, 0x60, 0xEA}},
       }) {
    append_frame(other_master, OtherMaster, frame);
    other_master.insert(other_master.end(), {Run, 5});
  }
  seeds.push_back(other_master);
  seeds.push_back(
      {SdoAnswer, 8, 0x4B, 0, 0, 0, 0x92, 0x01, 0, 0, 1, Run, 3, SdoAnswer, 8, 0x41, 0, 0, 0, 9, 0, 0, 0, 1});
  return seeds;
}

}  // namespace stairway::fuzz
