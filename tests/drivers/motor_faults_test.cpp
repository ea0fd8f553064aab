// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "drivers/canopen/motor_session.hpp"
#include "drivers/canopen/motor_setup.hpp"
#include "tests/drivers/can_text.hpp"
#include "tests/drivers/motor_bench.hpp"
#include "tools/sim/random.hpp"

namespace stairway::drivers {
namespace {

bool was_sent(const std::vector<CanFrame>& frames, const CanFrame& frame) {
  return std::ranges::find(frames, frame) != frames.end();
}

TEST(MotorFaults, no_drive_is_searched_without_end_and_found_when_it_comes) {
  MotorBench bench;
  bench.session.set_speed(kSpeed_rad_s);
  bench.drive.faults().is_silent = true;
  bench.run(20.0);
  EXPECT_EQ(bench.session.state(), MotorState::Searching);
  EXPECT_GE(bench.count(MotorTrouble::HeartbeatLost), 5U);
  EXPECT_NE(bench.detail(MotorTrouble::HeartbeatLost).find("no drive answers as node 1 on can0"), std::string::npos);
  bench.drive.faults().is_silent = false;
  EXPECT_TRUE(bench.run_until(MotorState::Running, 5.0));
}

TEST(MotorFaults, a_node_with_a_heartbeat_that_answers_nothing_is_not_told_as_absent) {
  MotorSession session{MotorOptions{}};
  std::string told;
  for (HostStamp now_ns = 0; now_ns < 5'000 * kMs; now_ns += 10 * kMs) {
    std::vector<CanArrival> arrivals;
    if (now_ns % (100 * kMs) == 50 * kMs) arrivals.push_back({now_ns, encode_heartbeat(1, NmtState::PreOperational)});
    for (const MotorEvent& event : session.on_arrivals(arrivals, now_ns)) {
      if (const auto* trouble = std::get_if<MotorTroubleEvent>(&event)) told = trouble->detail;
    }
    static_cast<void>(session.take_output());
  }
  EXPECT_EQ(session.counters().count(MotorTrouble::HeartbeatLost), 0U);
  EXPECT_NE(told.find("node 1 on can0 sends its heartbeat, but answers no request"), std::string::npos) << told;
}

TEST(MotorFaults, a_drive_that_was_already_set_up_and_is_not_to_be_reset_is_found) {
  MotorOptions options;
  options.reset_on_start = false;
  MotorBench bench(options);
  bench.run(0.1);
  EXPECT_TRUE(bench.run_until(MotorState::Running, 3.0));
  EXPECT_FALSE(was_sent(bench.sent, encode_nmt(NmtCommand::ResetCommunication, 1)));
  EXPECT_EQ(bench.all_troubles(), 0U);
}

TEST(MotorFaults, a_drive_that_restarts_in_operation_is_set_up_again) {
  RunningBench bench;
  bench.drive.power_cycle(bench.now_ns);
  EXPECT_TRUE(bench.run_until(MotorState::Configuring, 0.3));
  EXPECT_EQ(bench.count(MotorTrouble::Rebooted), 1U);
  EXPECT_TRUE(bench.recovers(3.0));
  EXPECT_EQ(bench.all_troubles(), 1U);
}

TEST(MotorFaults, a_silent_drive_is_searched_and_not_enabled_before_it_is_heard) {
  RunningBench bench;
  bench.drive.faults().is_silent = true;
  ASSERT_TRUE(bench.run_until(MotorState::Searching, 0.4));
  EXPECT_EQ(bench.count(MotorTrouble::HeartbeatLost), 1U);
  bench.sent.clear();
  bench.run(5.0);
  for (const CanFrame& frame : bench.sent) EXPECT_NE(frame.id, cob::kRpdo1 + 1) << to_string(frame);
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);  // the reset of its communication has stopped it
  bench.drive.faults().is_silent = false;
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, a_heartbeat_that_stops_alone_is_a_loss_too) {
  RunningBench bench;
  bench.drive.faults().has_no_heartbeat = true;
  EXPECT_TRUE(bench.run_until(MotorState::Searching, 0.4));
  EXPECT_EQ(bench.count(MotorTrouble::HeartbeatLost), 1U);
  bench.drive.faults().has_no_heartbeat = false;
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, the_disk_stops_by_itself_when_this_host_dies) {
  for (const ConnectionLoss reaction :
       {ConnectionLoss::Fault, ConnectionLoss::DisableVoltage, ConnectionLoss::QuickStop}) {
    MotorOptions options;
    options.connection_loss = reaction;
    RunningBench bench(options);
    bench.now_ns += 3'000 * kMs;  // nobody polls
    bench.bus.advance(bench.now_ns);
    EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0) << static_cast<int>(reaction);
    EXPECT_TRUE(is_off(bench.drive.state())) << to_string(bench.drive.state());
    EXPECT_TRUE(bench.recovers(10.0)) << static_cast<int>(reaction);
  }
}

TEST(MotorFaults, an_interrupted_hearing_of_this_host_is_told_by_its_emergency) {
  RunningBench bench;
  bench.drive.faults().is_deaf = true;
  bench.run(0.7);
  EXPECT_NE(bench.detail(MotorTrouble::Emergency).find("8130 (the drive missed this host's heartbeat)"),
            std::string::npos);
  bench.drive.faults().is_deaf = false;
  EXPECT_TRUE(bench.recovers(10.0));
}

TEST(MotorFaults, every_refused_object_is_told_and_waited_for_or_done_without) {
  for (const SetupStep& step : motor_setup(MotorOptions{})) {
    SCOPED_TRACE(to_string(step.object));
    MotorBench bench;
    bench.drive.faults().aborts[step.object] = sdo_abort::kNoObject;
    bench.run(1.5);
    EXPECT_GE(bench.count(MotorTrouble::SdoAbort), 1U);
    EXPECT_NE(bench.detail(MotorTrouble::SdoAbort).find(to_string(step.object)), std::string::npos);
    EXPECT_NE(bench.detail(MotorTrouble::SdoAbort).find("06020000 (no such object)"), std::string::npos);
    if (step.without != nullptr) {
      EXPECT_EQ(bench.session.state(), MotorState::Running);
      EXPECT_NE(bench.detail(MotorTrouble::SdoAbort).find(step.without), std::string::npos);
    } else {
      EXPECT_NE(bench.session.state(), MotorState::Running);
      EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
      bench.drive.faults().aborts.clear();
      EXPECT_TRUE(bench.run_until(MotorState::Running, 10.0));
    }
  }
}

TEST(MotorFaults, every_object_without_an_answer_is_told_and_waited_for) {
  for (const SetupStep& step : motor_setup(MotorOptions{})) {
    SCOPED_TRACE(to_string(step.object));
    MotorBench bench;
    bench.drive.faults().unanswered.insert(step.object);
    bench.run(2.0);
    EXPECT_GE(bench.count(MotorTrouble::SdoTimeout), 1U);
    EXPECT_NE(bench.detail(MotorTrouble::SdoTimeout).find(to_string(step.object) + ": no answer"), std::string::npos);
    bench.drive.faults().unanswered.clear();
    EXPECT_TRUE(bench.run_until(MotorState::Running, 10.0));
  }
}

TEST(MotorFaults, one_lost_answer_costs_a_retry_and_no_more) {
  MotorBench bench;
  bench.drive.faults().unanswered.insert(objects::kMode);
  bench.run(0.5);
  bench.drive.faults().unanswered.clear();
  EXPECT_TRUE(bench.run_until(MotorState::Running, 3.0));
}

TEST(MotorFaults, a_node_that_is_no_drive_is_unsuitable) {
  for (const auto& [object, value, text] :
       {std::tuple{objects::kDeviceType, 0x00030191U, "no CiA 402 drive"},
        std::tuple{objects::kSupportedModes, 0x00000001U, "no profile velocity mode"}}) {
    SetupSequence setup{MotorOptions{}};
    SdoClient sdo{1, 200 * kMs};
    setup.begin(sdo, 0);
    SdoResult result{.object = object};
    for (int i = 0; i < 4; ++i) result.bytes.push_back(static_cast<char>(value >> (8 * i)));
    const auto advance = setup.on_result(sdo, result, 0);
    EXPECT_EQ(advance.progress, SetupSequence::Progress::Failed);
    ASSERT_TRUE(advance.trouble);
    EXPECT_EQ(advance.trouble->trouble, MotorTrouble::Unsuitable);
    EXPECT_NE(advance.trouble->detail.find(text), std::string::npos);
  }
}

TEST(MotorFaults, a_mode_that_does_not_change_is_told) {
  MotorBench bench;
  bench.drive.faults().is_mode_stuck = true;
  bench.run(6.0);
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("6061 reads 1, not 3"), std::string::npos);
  bench.drive.faults().is_mode_stuck = false;
  EXPECT_TRUE(bench.run_until(MotorState::Running, 10.0));
}

TEST(MotorFaults, a_fault_in_operation_is_told_reset_by_an_edge_and_left) {
  RunningBench bench;
  bench.drive.raise_fault(0x2310, bench.now_ns);
  ASSERT_TRUE(bench.run_until(MotorState::Faulted, 0.1));
  EXPECT_TRUE(bench.recovers(5.0));
  EXPECT_NE(bench.detail(MotorTrouble::Emergency).find("2310 (overcurrent at the motor)"), std::string::npos);
  EXPECT_NE(bench.detail(MotorTrouble::Fault).find("error 2310 (overcurrent at the motor)"), std::string::npos);
  EXPECT_EQ(bench.count(MotorTrouble::Fault), 1U);
  EXPECT_TRUE(was_sent(bench.sent, frame_of("201#800000000000")));
}

TEST(MotorFaults, a_fault_that_does_not_clear_is_reset_three_times_a_minute_and_no_more) {
  RunningBench bench;
  bench.drive.faults().is_fault_stuck = true;
  bench.drive.raise_fault(0x7305, bench.now_ns);
  const auto edges = [&] {
    int count = 0;
    std::uint8_t last = 0;
    for (const CanFrame& frame : bench.sent) {
      if (frame.id != cob::kRpdo1 + 1) continue;
      count += (frame.data[0] & 0x80) != 0 && (last & 0x80) == 0;
      last = frame.data[0];
    }
    return count;
  };
  bench.run(50.0);
  EXPECT_EQ(bench.session.state(), MotorState::Faulted);
  EXPECT_EQ(edges(), 3);
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("no more fault resets than 3 in 60 s"), std::string::npos);
  bench.drive.faults().is_fault_stuck = false;
  EXPECT_TRUE(bench.recovers(70.0));
  EXPECT_EQ(edges(), 4);
}

TEST(MotorFaults, no_reset_without_remote_control) {
  RunningBench bench;
  bench.drive.faults().is_local = true;
  bench.drive.raise_fault(0x3210, bench.now_ns);
  bench.run(10.0);
  EXPECT_EQ(bench.session.state(), MotorState::Faulted);
  EXPECT_FALSE(was_sent(bench.sent, frame_of("201#800000000000")));
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("not under remote control"), std::string::npos);
  EXPECT_EQ(bench.count(MotorTrouble::StateTimeout), 1U);
  bench.drive.faults().is_local = false;
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, a_local_drive_cannot_be_enabled_and_says_so) {
  MotorBench bench;
  bench.drive.faults().is_local = true;
  bench.run(7.0);
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("not under remote control"), std::string::npos);
  bench.drive.faults().is_local = false;
  EXPECT_TRUE(bench.run_until(MotorState::Running, 8.0));
}

TEST(MotorFaults, safe_torque_off_is_told_and_waited_for) {
  RunningBench bench;
  bench.drive.faults().is_torque_off = true;
  ASSERT_TRUE(bench.run_until(MotorState::Enabling, 0.1));
  EXPECT_NE(bench.detail(MotorTrouble::SwitchedOff).find("safe torque off"), std::string::npos);
  bench.run(12.0);
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  EXPECT_NE(bench.detail(MotorTrouble::StateTimeout).find("safe torque off"), std::string::npos);
  bench.drive.faults().is_torque_off = false;
  EXPECT_TRUE(bench.recovers(15.0));
}

TEST(MotorFaults, a_quick_stop_contact_is_told_and_left_by_way_of_switch_on_disabled) {
  RunningBench bench;
  bench.drive.faults().is_quick_stop_input = true;
  bench.run(0.3);
  EXPECT_NE(bench.detail(MotorTrouble::SwitchedOff).find("quick stop"), std::string::npos);
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  bench.drive.faults().is_quick_stop_input = false;
  EXPECT_TRUE(bench.recovers(20.0));
}

TEST(MotorFaults, a_chattering_contact_is_backed_off_from) {
  RunningBench bench;
  bench.drive.faults().is_quick_stop_input = true;
  bench.run(60.0);
  EXPECT_LE(bench.count(MotorTrouble::SwitchedOff), 12U);
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
}

TEST(MotorFaults, bus_off_and_restart) {
  RunningBench bench;
  bench.bus.set_bus_off(true, bench.now_ns);
  bench.run(2.0);
  EXPECT_EQ(bench.session.state(), MotorState::Searching);
  EXPECT_NE(bench.detail(MotorTrouble::Bus), "");
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  bench.bus.set_bus_off(false, bench.now_ns);
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, link_down_and_up) {
  RunningBench bench;
  bench.bus.set_link(false, bench.now_ns);
  bench.run(1.0);
  EXPECT_EQ(bench.session.state(), MotorState::Searching);
  EXPECT_NE(bench.detail(MotorTrouble::Bus).find("ip link set can0 up"), std::string::npos);
  bench.sent.clear();
  bench.run(5.0);
  EXPECT_TRUE(bench.sent.empty());
  EXPECT_EQ(bench.drive.disk_speed_rad_s(), 0.0);
  bench.bus.set_link(true, bench.now_ns);
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, a_cut_cable_is_told_once) {
  RunningBench bench;
  bench.bus.set_unheard(true, bench.now_ns);
  bench.run(5.0);
  EXPECT_EQ(bench.session.state(), MotorState::Searching);
  EXPECT_GE(bench.count(MotorTrouble::Bus), 1U);
  EXPECT_LE(bench.all<MotorTroubleEvent>().size(), 6U);
  bench.bus.set_unheard(false, bench.now_ns);
  EXPECT_TRUE(bench.recovers(5.0));
}

TEST(MotorFaults, a_removed_interface_is_waited_for) {
  RunningBench bench;
  bench.bus.set_removed(true);
  bench.run(3.0);
  EXPECT_EQ(bench.session.state(), MotorState::Backoff);
  EXPECT_GE(bench.count(MotorTrouble::Disconnected), 1U);
  bench.bus.set_removed(false);
  EXPECT_TRUE(bench.recovers(20.0));
}

TEST(MotorFaults, a_speed_that_is_never_reached_is_told_once) {
  RunningBench bench;
  bench.drive.faults().reachable_share = 0.5;
  bench.session.set_speed(0.3);
  bench.run(20.0);
  EXPECT_EQ(bench.count(MotorTrouble::NotReached), 1U);
  EXPECT_NE(bench.detail(MotorTrouble::NotReached).find("wanted 0.3"), std::string::npos);
  EXPECT_EQ(bench.session.state(), MotorState::Running);
}

TEST(MotorFaults, slow_ramps_within_the_time_are_no_trouble) {
  RunningBench bench;
  bench.drive.faults().ramp_share = 0.1;
  bench.session.set_speed(0.3);
  bench.run(10.0);
  EXPECT_EQ(bench.all_troubles(), 0U);
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), 0.3, 1e-3);
}

TEST(MotorFaults, feedback_tells_what_the_drive_tells_be_it_wrong) {
  RunningBench bench;
  bench.drive.faults().is_velocity_reversed = true;
  bench.run(0.1);
  EXPECT_NEAR(bench.all<DriveFeedback>().back().speed_rad_s, -kSpeed_rad_s, 1e-3);
}

TEST(MotorFaults, a_reversed_drive_turns_the_disk_the_right_way) {
  MotorOptions options;
  options.reverse = true;
  sim::FakeDriveOptions drive_options;
  drive_options.reverse = true;
  RunningBench bench(options, drive_options);
  EXPECT_NEAR(bench.drive.disk_speed_rad_s(), kSpeed_rad_s, 1e-4);
  bench.run(1.0);
  const auto feedbacks = bench.all<DriveFeedback>();
  EXPECT_NEAR(feedbacks.back().speed_rad_s, kSpeed_rad_s, 1e-4);
  EXPECT_GT(feedbacks.back().angle_rad, feedbacks.front().angle_rad);
}

TEST(MotorFaults, the_angle_goes_on_through_the_overflow_of_the_position) {
  for (const double direction : {1.0, -1.0}) {
    sim::FakeDriveOptions drive_options;
    drive_options.start_turns = direction * (std::ldexp(1.0, 31) / drive_options.counts_per_turn - 0.1);
    MotorBench bench({}, drive_options);
    bench.session.set_speed(direction * 1.0);
    bench.run(5.0);
    const auto feedbacks = bench.all<DriveFeedback>();
    ASSERT_GT(feedbacks.size(), 300U);
    for (std::size_t i = 1; i < feedbacks.size(); ++i) {
      EXPECT_NEAR(feedbacks[i].angle_rad, feedbacks[i - 1].angle_rad, 0.02);
    }
    EXPECT_GT(direction * (feedbacks.back().angle_rad - feedbacks.front().angle_rad), 2.0);
    EXPECT_GT(std::abs(feedbacks.back().angle_rad), std::ldexp(1.0, 31) / 204800.0 * 2 * std::numbers::pi);
  }
}

TEST(MotorFaults, process_data_that_are_too_short_are_not_used) {
  RunningBench bench;
  bench.drive.faults().is_status_pdo_short = true;
  bench.run(1.0);
  EXPECT_GE(bench.count(MotorTrouble::Unexpected), 1U);
  EXPECT_NE(bench.detail(MotorTrouble::Unexpected).find("shorter than it was mapped"), std::string::npos);
  EXPECT_GE(bench.count(MotorTrouble::HeartbeatLost), 1U);
  bench.drive.faults().is_status_pdo_short = false;
  EXPECT_TRUE(bench.recovers(10.0));
}

TEST(MotorFaults, other_masters_are_noticed) {
  for (const char* text : {"000#8001", "601#4041600000000000", "581#4B41600037060000", "77F#05"}) {
    SCOPED_TRACE(text);
    RunningBench bench;
    bench.bus.add_frame(frame_of(text), bench.now_ns);
    bench.run(0.002);
    EXPECT_GE(bench.count(MotorTrouble::Unexpected), 1U);
    EXPECT_NE(bench.detail(MotorTrouble::Unexpected).find(text), std::string::npos);
    bench.run(0.5);
    EXPECT_TRUE(bench.recovers(10.0));
  }
}

TEST(MotorFaults, a_drive_that_another_master_stopped_is_started_again) {
  RunningBench bench;
  bench.bus.add_frame(encode_nmt(NmtCommand::Stop, 1), bench.now_ns);
  bench.run(0.5);
  EXPECT_NE(bench.session.state(), MotorState::Running);
  EXPECT_TRUE(bench.recovers(10.0));
}

TEST(MotorFaults, random_frames_never_break_the_session) {
  sim::Random random{7};
  for (int round = 0; round < 20; ++round) {
    MotorBench bench;
    bench.session.set_speed(kSpeed_rad_s);
    static constexpr std::uint16_t kIds[] = {0x000, 0x081, 0x181, 0x281, 0x581, 0x601, 0x701, 0x77f, 0x123};
    for (int i = 0; i < 3000; ++i) {
      if (i % 3 == 0) {
        CanFrame frame{kIds[static_cast<std::size_t>(random.uniform(0, 8.999))],
                       static_cast<std::uint8_t>(random.uniform(0, 8.999)),
                       {}};
        for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random.uniform(0, 255.999));
        bench.take(bench.session.on_arrivals(std::vector{CanArrival{bench.now_ns, frame}}, bench.now_ns));
      }
      bench.run(0.001);
      ASSERT_LE(bench.session.take_output().size(), 32U);
    }
    EXPECT_TRUE(bench.run_until(MotorState::Running, 90.0)) << round;
  }
}

TEST(MotorFaults, time_goes_on_between_deadlines) {
  // A caller that sleeps until the deadline must not be called again at the same time without end.
  RunningBench bench;
  bench.drive.raise_fault(0x2310, bench.now_ns);
  HostStamp last_ns = bench.now_ns;
  int same = 0;
  for (int i = 0; i < 20000; ++i) {
    bench.now_ns = std::max(bench.now_ns, std::min(bench.session.deadline(), bench.bus.next_due_ns()));
    bench.poll();
    if (i == 5000) bench.drive.faults().is_silent = true;
    if (i == 8000) bench.drive.faults().is_silent = false;
    same = bench.now_ns == last_ns ? same + 1 : 0;
    last_ns = bench.now_ns;
    ASSERT_LT(same, 50) << to_string(bench.session.state());
  }
  EXPECT_GT(bench.now_ns, 20'000 * kMs);
}

}  // namespace
}  // namespace stairway::drivers
