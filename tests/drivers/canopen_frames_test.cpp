// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/canopen_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "drivers/canopen/cia402.hpp"
#include "drivers/canopen/motor_setup.hpp"
#include "drivers/canopen/pdo_map.hpp"
#include "drivers/canopen/process_data.hpp"
#include "drivers/canopen/sdo_frames.hpp"
#include "tests/drivers/can_text.hpp"

namespace stairway::drivers {
namespace {

TEST(CanopenFrames, commands_and_states_of_the_network) {
  const std::pair<CanFrame, const char*> cases[] = {
      {encode_nmt(NmtCommand::Start, 1), "000#0101"},
      {encode_nmt(NmtCommand::Stop, 1), "000#0201"},
      {encode_nmt(NmtCommand::EnterPreOperational, 1), "000#8001"},
      {encode_nmt(NmtCommand::ResetNode, 1), "000#8101"},
      {encode_nmt(NmtCommand::ResetCommunication, 0), "000#8200"},
      {encode_sync(), "080#"},
      {encode_heartbeat(127, NmtState::Operational), "77F#05"},
      {encode_heartbeat(1, NmtState::BootUp), "701#00"},
  };
  for (const auto& [frame, text] : cases) {
    EXPECT_EQ(to_string(frame), text);
    EXPECT_EQ(frame_of(text), frame);
  }
}

TEST(CanopenFrames, heartbeats_name_a_state_or_nothing) {
  const std::pair<const char*, std::optional<NmtState>> cases[] = {
      {"701#00", NmtState::BootUp},  {"701#7F", NmtState::PreOperational}, {"701#05", NmtState::Operational},
      {"701#04", NmtState::Stopped}, {"701#85", NmtState::Operational},    {"701#01", std::nullopt},
      {"701#", std::nullopt},        {"701#0500", std::nullopt},
  };
  for (const auto& [text, state] : cases) EXPECT_EQ(decode_heartbeat(frame_of(text)), state) << text;
}

TEST(CanopenFrames, commands_to_the_drive_and_what_it_tells) {
  EXPECT_EQ(to_string(encode_command(1, {0x000f, 60000})), "201#0F0060EA0000");
  EXPECT_EQ(to_string(encode_command(127, {0x0006, -1})), "27F#0600FFFFFFFF");
  const std::pair<const char*, DriveStatus> cases[] = {
      {"181#370656EA0000", {0x0637, 59990}},
      {"181#3706AA15FFFF", {0x0637, -59990}},
      {"181#5002000000800000", {0x0250, std::numeric_limits<std::int32_t>::min()}},
  };
  for (const auto& [text, status] : cases) EXPECT_EQ(decode_status(frame_of(text)), status) << text;
  EXPECT_FALSE(decode_status(frame_of("181#370656EA00")));
  EXPECT_EQ(decode_position(frame_of("281#FEFFFFFF")), -2);
  EXPECT_FALSE(decode_position(frame_of("281#FEFFFF")));
}

TEST(CanopenFrames, every_byte_of_what_the_drive_tells_counts) {
  const CanFrame frame = frame_of("181#370656EA0000");
  for (std::size_t i = 0; i < frame.length; ++i) {
    CanFrame changed = frame;
    changed.data[i] ^= 0xff;
    EXPECT_NE(decode_status(changed), decode_status(frame)) << i;
  }
}

TEST(CanopenFrames, emergencies_both_ways_with_their_meaning) {
  const CanFrame frame = frame_of("081#3081110000000000");
  const auto emergency = decode_emergency(frame);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(emergency->code, 0x8130);
  EXPECT_EQ(emergency->error_register, 0x11);
  EXPECT_EQ(encode_emergency(1, *emergency), frame);
  EXPECT_EQ(describe(*emergency),
            "8130 (the drive missed this host's heartbeat), error register 11, vendor bytes 00 00 00 00 00");
  EXPECT_EQ(decode_emergency(frame_of("081#0000000000000000")), Emergency{});
  EXPECT_FALSE(decode_emergency(frame_of("081#30811100000000")));
}

TEST(CanopenFrames, every_error_code_has_a_text) {
  const std::pair<std::uint16_t, const char*> cases[] = {
      {0x2310, "overcurrent at the motor"},
      {0x3210, "supply voltage too high"},
      {0x3220, "supply voltage too low"},
      {0x4210, "drive too hot"},
      {0x4310, "drive too hot"},
      {0x7305, "motor encoder"},
      {0x8110, "CAN messages lost in the drive"},
      {0x8120, "CAN error passive"},
      {0x8130, "the drive missed this host's heartbeat"},
      {0x8140, "recovered from bus-off"},
      {0x8150, "two nodes use one identifier"},
      {0x8210, "PDO too short"},
      {0x8400, "speed cannot be followed"},
      {0x8500, "position"},
      {0x8611, "following error"},
      {0xff01, "see the drive's manual"},
      {0x5123, "drive hardware"},
      {0x6123, "drive software or parameters"},
      {0x1000, "generic error"},
  };
  for (const auto& [code, text] : cases) EXPECT_STREQ(describe_error_code(code), text);
}

struct SdoCase {
  const char* text;
  SdoFrame frame;
};

TEST(SdoFrames, requests_both_ways) {
  const auto write = [](ObjectAddress object, std::string bytes) {
    return SdoFrame{.kind = SdoKind::DownloadRequest, .object = object, .is_expedited = true, .bytes = bytes};
  };
  using std::string_literals::operator""s;
  const SdoCase cases[] = {
      {"601#2F60600003000000", write({0x6060, 0}, "\x03")},
      {"601#2B40600006000000", write({0x6040, 0}, "\x06\0"s)},
      {"601#2B40600007000000", write({0x6040, 0}, "\x07\0"s)},
      {"601#2B4060000F000000", write({0x6040, 0}, "\x0f\0"s)},
      {"601#2B40600080000000", write({0x6040, 0}, "\x80\0"s)},
      {"601#23FF600018FCFFFF", write({0x60ff, 0}, "\x18\xfc\xff\xff")},
      {"601#23FF600060EA0000", write({0x60ff, 0}, "\x60\xea\0\0"s)},
      {"601#2383600010270000", write({0x6083, 0}, "\x10\x27\0\0"s)},
      {"601#2B17100064000000", write({0x1017, 0}, "\x64\0"s)},
      {"601#23161001F4017F00", write({0x1016, 1}, "\xf4\x01\x7f\0"s)},
      {"601#2799200001020300", write({0x2099, 0}, "\x01\x02\x03")},
      {"601#2108100014000000", {.kind = SdoKind::DownloadRequest, .object = {0x1008, 0}, .number = 20}},
      {"601#4041600000000000", {.kind = SdoKind::UploadRequest, .object = {0x6041, 0}}},
      {"601#4018100100000000", {.kind = SdoKind::UploadRequest, .object = {0x1018, 1}}},
      {"601#6000000000000000", {.kind = SdoKind::UploadAskSegment}},
      {"601#7000000000000000", {.kind = SdoKind::UploadAskSegment, .is_toggled = true}},
      {"601#0061626364656667", {.kind = SdoKind::DownloadSegment, .bytes = "abcdefg"}},
      {"601#1B61000000000000",
       {.kind = SdoKind::DownloadSegment, .is_toggled = true, .is_last = true, .bytes = "a\0"s}},
      {"601#8040600000000405", {.kind = SdoKind::Abort, .object = {0x6040, 0}, .number = 0x05040000}},
  };
  for (const SdoCase& one : cases) {
    EXPECT_EQ(to_string(encode_sdo(0x601, one.frame)), one.text);
    EXPECT_EQ(decode_sdo_request(frame_of(one.text)), one.frame) << one.text;
  }
}

TEST(SdoFrames, answers_both_ways) {
  using std::string_literals::operator""s;
  const auto value = [](ObjectAddress object, std::string bytes) {
    return SdoFrame{.kind = SdoKind::UploadAnswer, .object = object, .is_expedited = true, .bytes = bytes};
  };
  const SdoCase cases[] = {
      {"581#6060600000000000", {.kind = SdoKind::DownloadDone, .object = {0x6060, 0}}},
      {"581#4B41600037060000", value({0x6041, 0}, "\x37\x06")},
      {"581#4318100178563412", value({0x1018, 1}, "\x78\x56\x34\x12")},
      {"581#4F61600003000000", value({0x6061, 0}, "\x03")},
      {"581#4799200001020300", value({0x2099, 0}, "\x01\x02\x03")},
      {"581#4108100014000000", {.kind = SdoKind::UploadAnswer, .object = {0x1008, 0}, .number = 20}},
      {"581#0061626364656667", {.kind = SdoKind::UploadSegment, .bytes = "abcdefg"}},
      {"581#1B68690000000000", {.kind = SdoKind::UploadSegment, .is_toggled = true, .is_last = true, .bytes = "hi"}},
      {"581#3000000000000000", {.kind = SdoKind::SegmentTaken, .is_toggled = true}},
      {"581#8000600000000206", {.kind = SdoKind::Abort, .object = {0x6000, 0}, .number = 0x06020000}},
      {"581#8041600002000106", {.kind = SdoKind::Abort, .object = {0x6041, 0}, .number = 0x06010002}},
  };
  for (const SdoCase& one : cases) {
    EXPECT_EQ(decode_sdo_answer(frame_of(one.text)), one.frame) << one.text;
    // A length of 2 leaves the upper bits of the command as the vector has them only where the bytes fill it.
    EXPECT_EQ(decode_sdo_answer(encode_sdo(0x581, one.frame)), one.frame) << one.text;
  }
}

TEST(SdoFrames, a_value_without_a_size_has_four_bytes) {
  const auto answer = decode_sdo_answer(frame_of("581#4241600037060000"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->bytes.size(), 4U);
}

TEST(SdoFrames, short_frames_and_unknown_commands_are_nothing) {
  EXPECT_FALSE(decode_sdo_answer(frame_of("581#60606000000000")));
  EXPECT_FALSE(decode_sdo_request(frame_of("601#40416000")));
  EXPECT_FALSE(decode_sdo_answer(frame_of("581#A060600000000000")));
  EXPECT_FALSE(decode_sdo_request(frame_of("601#E060600000000000")));
}

TEST(SdoFrames, every_abort_code_has_a_text) {
  const std::uint32_t codes[] = {0x05030000, 0x05040000, 0x05040001, 0x05040002, 0x05040003, 0x05040004, 0x05040005,
                                 0x06010000, 0x06010001, 0x06010002, 0x06020000, 0x06040041, 0x06040042, 0x06040043,
                                 0x06040047, 0x06060000, 0x06070010, 0x06070012, 0x06070013, 0x06090011, 0x06090030,
                                 0x06090031, 0x06090032, 0x06090036, 0x060A0023, 0x08000000, 0x08000020, 0x08000021,
                                 0x08000022, 0x08000023, 0x08000024};
  for (const std::uint32_t code : codes) EXPECT_STRNE(describe_abort(code), "unknown reason") << std::hex << code;
  EXPECT_STREQ(describe_abort(0x12345678), "unknown reason");
}

TEST(Cia402, statuswords_name_a_state) {
  const std::pair<std::uint16_t, DriveState> cases[] = {
      {0x0000, DriveState::NotReady},
      {0x0240, DriveState::SwitchOnDisabled},
      {0x0250, DriveState::SwitchOnDisabled},
      {0x0231, DriveState::Ready},
      {0x0233, DriveState::SwitchedOn},
      {0x0237, DriveState::Enabled},
      {0x0637, DriveState::Enabled},
      {0x0217, DriveState::QuickStop},
      {0x021f, DriveState::FaultReaction},
      {0x0218, DriveState::Fault},
      {0x0238, DriveState::Fault},
      {0x0001, DriveState::Unknown},
  };
  for (const auto& [word, state] : cases) EXPECT_EQ(decode_statusword(word), state) << std::hex << word;
}

TEST(Cia402, one_step_at_a_time_leads_to_operation_enabled) {
  const std::pair<DriveState, std::optional<std::uint16_t>> cases[] = {
      {DriveState::NotReady, std::nullopt},
      {DriveState::SwitchOnDisabled, 0x0006},
      {DriveState::Ready, 0x0007},
      {DriveState::SwitchedOn, 0x000f},
      {DriveState::Enabled, 0x000f},
      {DriveState::QuickStop, 0x0000},
      {DriveState::FaultReaction, std::nullopt},
      {DriveState::Fault, std::nullopt},
      {DriveState::Unknown, std::nullopt},
  };
  for (const auto& [state, command] : cases) EXPECT_EQ(command_to_enable(state), command) << to_string(state);
}

std::vector<std::string> texts(const std::vector<ObjectWrite>& writes) {
  std::vector<std::string> out;
  for (const ObjectWrite& write : writes) {
    SdoFrame frame{.kind = SdoKind::DownloadRequest, .object = write.object, .is_expedited = true};
    for (int i = 0; i < write.value.size; ++i) frame.bytes.push_back(static_cast<char>(write.value.value >> (8 * i)));
    out.push_back(to_string(encode_sdo(0x601, frame)));
  }
  return out;
}

TEST(PdoMap, is_set_in_the_order_that_drives_require) {
  const auto maps = motor_pdo_maps(1);
  ASSERT_EQ(maps.size(), 3U);
  EXPECT_EQ(texts(mapping_writes(maps[0])),
            (std::vector<std::string>{"601#2300140101020080", "601#2F001402FF000000", "601#2F00160000000000",
                                      "601#2300160110004060", "601#230016022000FF60", "601#2F00160002000000",
                                      "601#2300140101020000"}));
  EXPECT_EQ(texts(mapping_writes(maps[1])),
            (std::vector<std::string>{"601#23001801810100C0", "601#2F00180201000000", "601#2F001A0000000000",
                                      "601#23001A0110004160", "601#23001A0220006C60", "601#2F001A0002000000",
                                      "601#2300180181010040"}));
}

TEST(MotorSetup, bounds_of_the_units) {
  MotorOptions options;
  options.velocity_units_per_turn_per_s = 1000;
  const MotorUnits units(options);
  EXPECT_EQ(units.velocity_units(2 * std::numbers::pi), 1000);
  EXPECT_EQ(units.velocity_units(-1e300), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(units.velocity_units(1e300), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(units.velocity_units(std::nan("")), 0);
  EXPECT_EQ(units.acceleration_units(0.0), 1U);
  options.reverse = true;
  EXPECT_EQ(MotorUnits(options).velocity_units(2 * std::numbers::pi), -1000);
  EXPECT_NEAR(MotorUnits(options).speed_rad_s(-1000), 2 * std::numbers::pi, 1e-12);
}

TEST(MotorOptions, a_speed_below_half_a_unit_is_refused_and_a_coarse_one_is_warned_of) {
  MotorOptions options;
  options.velocity_units_per_turn_per_s = 60;
  const double unit_rad_s = 2 * std::numbers::pi / 60;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NE(speed_problem(options, sign * 0.49 * unit_rad_s).find("velocity_units_per_turn_per_s"),
              std::string::npos);
    EXPECT_EQ(speed_problem(options, sign * 0.51 * unit_rad_s), "");
    EXPECT_NE(speed_warning(options, sign * 1.4 * unit_rad_s).find("(-29 %)"), std::string::npos);
    EXPECT_NE(speed_warning(options, sign * 1.9 * unit_rad_s).find("(5 %)"), std::string::npos);
    EXPECT_EQ(speed_warning(options, sign * 2.05 * unit_rad_s), "");
  }
}

TEST(MotorOptions, problems_name_the_setting) {
  EXPECT_EQ(MotorOptions{}.problem(), "");
  const auto problem = [](auto change) {
    MotorOptions options;
    change(options);
    return options.problem();
  };
  EXPECT_EQ(problem([](MotorOptions& o) { o.interface = "can 0"; }),
            "interface must be the name of a network interface like can0");
  EXPECT_EQ(problem([](MotorOptions& o) { o.node_id = 128; }), "node_id must lie between 1 and 127");
  EXPECT_EQ(problem([](MotorOptions& o) { o.host_node_id = o.node_id; }), "node_id and host_node_id must differ");
  EXPECT_NE(problem([](MotorOptions& o) { o.counts_per_turn = std::nan(""); }), "");
  EXPECT_NE(problem([](MotorOptions& o) { o.max_backoff_s = 0.1; }), "");
}

}  // namespace
}  // namespace stairway::drivers
