// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/sdo_client.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

constexpr int kAttempts = 2;
constexpr std::size_t kMaxBytes = 256;
constexpr std::size_t kSegment = 7;

}  // namespace

std::uint32_t SdoResult::number() const {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size() && i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
  }
  return value;
}

bool SdoResult::is_missing() const {
  return outcome == Outcome::Aborted && (abort_code == sdo_abort::kNoObject || abort_code == sdo_abort::kNoSubindex);
}

std::string describe(const SdoResult& result) {
  std::string out = (result.is_write ? "write " : "read ") + to_string(result.object);
  if (result.outcome == SdoResult::Outcome::NoAnswer) return out + ": no answer";
  if (result.outcome == SdoResult::Outcome::Done) return out + ": done";
  return out + ": refused, " + hex_text(result.abort_code, 8) + " (" + describe_abort(result.abort_code) + ")";
}

void SdoClient::read(ObjectAddress object, HostStamp now_ns) { request(object, false, {}, now_ns); }

void SdoClient::write(ObjectAddress object, ObjectValue value, HostStamp now_ns) {
  std::string bytes;
  for (int i = 0; i < value.size; ++i) bytes.push_back(static_cast<char>(value.value >> (8 * i)));
  request(object, true, std::move(bytes), now_ns);
}

void SdoClient::write(ObjectAddress object, std::string bytes, HostStamp now_ns) {
  request(object, true, std::move(bytes), now_ns);
}

void SdoClient::request(ObjectAddress object, bool is_write, std::string bytes, HostStamp now_ns) {
  transfer_ = {.object = object, .is_write = is_write};
  to_write_ = std::move(bytes);
  attempts_ = 0;
  result_.reset();
  state_ = State::Queued;
  if (now_ns >= deaf_until_ns_) begin(now_ns);
}

void SdoClient::cancel(HostStamp now_ns) {
  if (state_ == State::Waiting) {
    send_abort(sdo_abort::kTimeout);
    deaf_until_ns_ = now_ns + timeout_ns_;
  }
  state_ = State::Idle;
  result_.reset();
}

void SdoClient::begin(HostStamp now_ns) {
  ++attempts_;
  is_segmented_ = false;
  is_toggled_ = false;
  position_ = 0;
  sent_ = 0;
  transfer_.bytes.clear();
  SdoFrame frame{.kind = SdoKind::UploadRequest, .object = transfer_.object};
  if (transfer_.is_write) {
    frame.kind = SdoKind::DownloadRequest;
    frame.is_expedited = to_write_.size() <= 4;
    if (frame.is_expedited) frame.bytes = to_write_;
    if (!frame.is_expedited) frame.number = static_cast<std::uint32_t>(to_write_.size());
  }
  send(frame, now_ns);
}

void SdoClient::send(const SdoFrame& frame, HostStamp now_ns) {
  output_.push_back(encode_sdo(static_cast<std::uint16_t>(cob::kSdoRequest + node_), frame));
  state_ = State::Waiting;
  deadline_ns_ = now_ns + timeout_ns_;
}

void SdoClient::send_segment(HostStamp now_ns) {
  SdoFrame frame{.kind = SdoKind::DownloadSegment, .is_toggled = is_toggled_};
  frame.bytes = to_write_.substr(position_, kSegment);
  sent_ = frame.bytes.size();
  frame.is_last = position_ + sent_ == to_write_.size();
  send(frame, now_ns);
}

void SdoClient::send_abort(std::uint32_t code) {
  const SdoFrame frame{.kind = SdoKind::Abort, .object = transfer_.object, .number = code};
  output_.push_back(encode_sdo(static_cast<std::uint16_t>(cob::kSdoRequest + node_), frame));
}

bool SdoClient::is_answer(const SdoFrame& answer) const {
  if (answer.kind == SdoKind::Abort) return answer.object == transfer_.object;
  if (is_segmented_) return answer.kind == (transfer_.is_write ? SdoKind::SegmentTaken : SdoKind::UploadSegment);
  return answer.kind == (transfer_.is_write ? SdoKind::DownloadDone : SdoKind::UploadAnswer) &&
         answer.object == transfer_.object;
}

bool SdoClient::on_frame(const CanFrame& frame, HostStamp now_ns) {
  const auto answer = decode_sdo_answer(frame);
  if (state_ != State::Waiting || !answer || !is_answer(*answer)) return false;
  if (answer->kind == SdoKind::Abort) {
    transfer_.abort_code = answer->number;
    finish(SdoResult::Outcome::Aborted);
  } else if (answer->kind == SdoKind::UploadAnswer) {
    take_upload(*answer, now_ns);
  } else if (answer->kind == SdoKind::DownloadDone && to_write_.size() <= 4) {
    finish(SdoResult::Outcome::Done);
  } else {
    take_segment(*answer, now_ns);
  }
  return true;
}

void SdoClient::take_upload(const SdoFrame& answer, HostStamp now_ns) {
  if (answer.is_expedited) {
    transfer_.bytes = answer.bytes;
    return finish(SdoResult::Outcome::Done);
  }
  if (answer.number > kMaxBytes) return fail(sdo_abort::kMemory);
  is_segmented_ = true;
  send({.kind = SdoKind::UploadAskSegment, .is_toggled = is_toggled_}, now_ns);
}

void SdoClient::take_segment(const SdoFrame& answer, HostStamp now_ns) {
  if (answer.kind == SdoKind::DownloadDone) {
    is_segmented_ = true;
    return send_segment(now_ns);
  }
  if (answer.is_toggled != is_toggled_) return fail(sdo_abort::kToggle);
  is_toggled_ = !is_toggled_;
  if (transfer_.is_write) {
    position_ += sent_;
    return position_ == to_write_.size() ? finish(SdoResult::Outcome::Done) : send_segment(now_ns);
  }
  transfer_.bytes += answer.bytes;
  if (transfer_.bytes.size() > kMaxBytes) return fail(sdo_abort::kMemory);
  if (answer.is_last) return finish(SdoResult::Outcome::Done);
  send({.kind = SdoKind::UploadAskSegment, .is_toggled = is_toggled_}, now_ns);
}

void SdoClient::fail(std::uint32_t code) {
  send_abort(code);
  transfer_.abort_code = code;
  finish(SdoResult::Outcome::Aborted);
}

void SdoClient::finish(SdoResult::Outcome outcome) {
  transfer_.outcome = outcome;
  result_ = std::move(transfer_);
  state_ = State::Idle;
}

void SdoClient::on_time(HostStamp now_ns) {
  if (state_ == State::Queued && now_ns >= deaf_until_ns_) {
    begin(now_ns);
  } else if (state_ == State::Waiting && now_ns >= deadline_ns_) {
    send_abort(sdo_abort::kTimeout);
    deaf_until_ns_ = now_ns + timeout_ns_;
    state_ = State::Queued;
    if (attempts_ >= kAttempts) finish(SdoResult::Outcome::NoAnswer);
  }
}

HostStamp SdoClient::deadline() const {
  if (state_ == State::Idle) return std::numeric_limits<HostStamp>::max();
  return state_ == State::Queued ? deaf_until_ns_ : deadline_ns_;
}

std::optional<SdoResult> SdoClient::take_result() { return std::exchange(result_, std::nullopt); }

std::vector<CanFrame> SdoClient::take_output() { return std::exchange(output_, {}); }

}  // namespace stairway::drivers
