// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/canopen/sdo_frames.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// How a transfer ended.
struct SdoResult {
  enum class Outcome : std::uint8_t {
    Done,
    Aborted,  ///< by the drive, or by this side because of what the drive sent; `abort_code` says why
    NoAnswer,
  };
  ObjectAddress object;
  bool is_write = false;
  Outcome outcome = Outcome::Done;
  std::uint32_t abort_code = 0;
  std::string bytes;  ///< what was read

  /// The first four bytes of what was read.
  std::uint32_t number() const;
  /// Nothing is known about this object: it, or its subindex, is not there.
  bool is_missing() const;
};
/// "write 6040:0: refused, 06010002 (read-only)".
std::string describe(const SdoResult& result);

/// Reads and writes a node's object dictionary, one transfer at a time, expedited and in segments. Frames and times in,
/// frames and results out.
///
/// A transfer without an answer is aborted, then tried once more. Answers carry no number, so after a time-out the
/// client is deaf for as long again: an answer that comes late is taken for what it is and never for the answer to the
/// next request. Values of more than 256 bytes are aborted.
class SdoClient {
 public:
  /// @param node  1..127.
  SdoClient(std::uint8_t node, HostStamp timeout_ns) : node_(node), timeout_ns_(timeout_ns) {}

  /// @pre  !is_busy().
  void read(ObjectAddress object, HostStamp now_ns);
  void write(ObjectAddress object, ObjectValue value, HostStamp now_ns);
  /// Any length from 1 to 256 bytes.
  void write(ObjectAddress object, std::string bytes, HostStamp now_ns);
  /// Gives up what is under way; it has no result. What comes next waits until a late answer would have come.
  void cancel(HostStamp now_ns);
  bool is_busy() const { return state_ != State::Idle; }

  /// Takes a frame that the node sent as an SDO answer.
  /// @return False when nobody asked for it.
  bool on_frame(const CanFrame& frame, HostStamp now_ns);
  void on_time(HostStamp now_ns);
  /// When something is due if no answer comes [ns].
  HostStamp deadline() const;

  /// The result of a transfer that has ended, once.
  std::optional<SdoResult> take_result();
  /// Frames to send, in order.
  std::vector<CanFrame> take_output();

 private:
  enum class State : std::uint8_t { Idle, Queued, Waiting };

  void request(ObjectAddress object, bool is_write, std::string bytes, HostStamp now_ns);
  void begin(HostStamp now_ns);
  void send(const SdoFrame& frame, HostStamp now_ns);
  void send_segment(HostStamp now_ns);
  void send_abort(std::uint32_t code);
  void take_upload(const SdoFrame& answer, HostStamp now_ns);
  void take_segment(const SdoFrame& answer, HostStamp now_ns);
  void fail(std::uint32_t code);
  void finish(SdoResult::Outcome outcome);
  bool is_answer(const SdoFrame& answer) const;

  std::uint8_t node_;
  HostStamp timeout_ns_;
  State state_ = State::Idle;
  HostStamp deadline_ns_ = 0;    // of the answer
  HostStamp deaf_until_ns_ = 0;  // late answers are dropped before
  int attempts_ = 0;

  SdoResult transfer_;
  std::string to_write_;
  bool is_segmented_ = false;
  bool is_toggled_ = false;
  std::size_t position_ = 0;  // of the next segment to write
  std::size_t sent_ = 0;      // bytes in the segment that is not confirmed yet

  std::optional<SdoResult> result_;
  std::vector<CanFrame> output_;
};

}  // namespace stairway::drivers
