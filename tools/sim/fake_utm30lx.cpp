// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_utm30lx.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "drivers/scip/scip_codec.hpp"
#include "drivers/scip/scip_replies.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr std::size_t kLongestLine = 100;
constexpr std::size_t kMostCommands = 16;
constexpr HostStamp kHostBuffer_ns = 1'000'000'000;
constexpr std::uint32_t kCounterMask = 0xffffff;
constexpr int kLeastRange_mm = 23;
constexpr std::size_t kLongestTag = 16;

bool is_number(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The status that refuses the parameters of a measurement command; empty when they are numbers of the right length.
std::string refusal(std::string_view parameters, bool is_stream) {
  static constexpr std::array<std::pair<std::size_t, const char*>, 5> kFields{
      {{4, "01"}, {4, "02"}, {2, "03"}, {1, "06"}, {2, "07"}}};
  const std::size_t length = is_stream ? 13 : 10;
  if (parameters.size() < length) return "0C";
  if (parameters.size() > length) return "0D";
  for (const auto& [digits, status] : kFields) {
    if (!is_number(parameters.substr(0, digits))) return status;
    parameters.remove_prefix(std::min(digits, parameters.size()));
  }
  return {};
}

// The nearest distance of neighbouring beams, or an error code when none of them has one.
std::uint32_t nearest(std::span<const std::uint32_t> group) {
  std::uint32_t best = group.front();
  for (const std::uint32_t value : group) {
    if (value >= kLeastRange_mm && (best < kLeastRange_mm || value < best)) best = value;
  }
  return best;
}

}  // namespace

std::string FakeUtm30lxOptions::problem() const {
  if (counter_at_start_ms < 0 || counter_at_start_ms > kCounterMask) return "counter at start must have 24 bits";
  if (!(std::abs(clock_rate - 1) <= 0.01)) return "clock rate must lie within 1 % of 1";
  if (!(std::abs(turn_period_s - 0.025) <= 0.005)) return "turn period must lie within 5 ms of 25 ms";
  // Scans must stay in order.
  if (!(latency_s >= 0 && latency_s <= 1)) return "latency must lie within 0 .. 1 s";
  if (!(jitter_s >= 0 && jitter_s <= turn_period_s)) return "jitter must lie between 0 and the turn period";
  return {};
}

FakeUtm30lx::FakeUtm30lx(const FakeUtm30lxOptions& options, RangeSource measure)
    : options_{options},
      measure_{std::move(measure)},
      counter_start_ns_{options.start_ns},
      counter_start_ms_{options.counter_at_start_ms} {}

HostStamp FakeUtm30lx::turn_start_ns(std::uint64_t turn) const {
  return options_.start_ns + std::llround(1e9 * options_.turn_period_s * static_cast<double>(turn));
}

HostStamp FakeUtm30lx::turn_due_ns(std::uint64_t turn) const {
  const double delay_s = options_.latency_s + options_.jitter_s * Random{options_.seed, turn}.uniform();
  return turn_start_ns(turn) + std::llround(1e9 * delay_s);
}

std::uint32_t FakeUtm30lx::counter_at(HostStamp stamp_ns) const {
  const double elapsed_ms = 1e-6 * static_cast<double>(stamp_ns - counter_start_ns_) * options_.clock_rate;
  return static_cast<std::uint32_t>(counter_start_ms_ + static_cast<std::int64_t>(std::floor(elapsed_ms))) &
         kCounterMask;
}

void FakeUtm30lx::receive(std::string_view bytes, HostStamp now_ns) {
  for (const char c : bytes) {
    if (c != '\n' && c != '\r') {
      if (line_.size() < kLongestLine) line_.push_back(c);
      continue;
    }
    if (!line_.empty() && commands_.size() < kMostCommands) commands_.push_back({now_ns, line_});
    line_.clear();
  }
}

std::uint64_t FakeUtm30lx::next_turn() const {
  std::uint64_t next = std::numeric_limits<std::uint64_t>::max();
  if (stream_) next = turn_ + static_cast<std::uint64_t>(turns_to_skip_);
  if (commands_.empty()) return next;
  // A command is seen at the begin of the turn after it came.
  const double turns =
      1e-9 * static_cast<double>(commands_.front().received_ns - options_.start_ns) / options_.turn_period_s;
  return std::min(next, std::max(turn_, static_cast<std::uint64_t>(std::max(0.0, std::ceil(turns)))));
}

HostStamp FakeUtm30lx::next_due_ns() const {
  if (!output_.empty()) return output_.front().arrival_ns;
  if (!stream_ && commands_.empty()) return std::numeric_limits<HostStamp>::max();
  return turn_due_ns(next_turn());
}

std::optional<drivers::ByteChunk> FakeUtm30lx::take(HostStamp now_ns) {
  while (output_.empty()) {
    if (next_due_ns() > now_ns) return std::nullopt;
    const std::uint64_t next = next_turn();
    if (stream_) turns_to_skip_ -= static_cast<int>(next - turn_);
    turn_ = next;
    while (stream_ && commands_.empty() && now_ns - turn_start_ns(turn_) > kHostBuffer_ns) ++turn_;
    run_turn();
    ++turn_;
  }
  if (output_.front().arrival_ns > now_ns) return std::nullopt;
  drivers::ByteChunk chunk = std::move(output_.front());
  output_.pop_front();
  return chunk;
}

void FakeUtm30lx::run_turn() {
  const bool was_streaming = stream_.has_value();
  if (!commands_.empty() && commands_.front().received_ns <= turn_start_ns(turn_)) {
    const std::string line = std::move(commands_.front().line);
    commands_.pop_front();
    const auto before = stream_;
    answer(line);
    if (stream_ != before) return;
  }
  if (!was_streaming || !stream_) return;
  if (turns_to_skip_ > 0) {
    --turns_to_skip_;
    return;
  }
  turns_to_skip_ = stream_->skip_scan;
  send_scan();
}

void FakeUtm30lx::say(std::string bytes) { output_.push_back({turn_due_ns(turn_), std::move(bytes)}); }

void FakeUtm30lx::answer(const std::string& line) {
  const auto command = drivers::parse_command(line);
  std::string body;
  std::string status = "0E";
  if (!command) {
    const std::size_t semicolon = line.find(';');
    if (semicolon != std::string::npos) status = line.size() - semicolon - 1 > kLongestTag ? "0G" : "0H";
  } else if (command->symbol == "TM") {
    status = answer_time_command(command->parameters, body);
  } else if (command->symbol == "RS" || command->symbol == "RT") {
    reset(command->symbol == "RS");
    status = "00";
  } else if (is_adjusting_time_) {
    status = "0E";
  } else if (command->symbol == "VV" || command->symbol == "PP" || command->symbol == "II") {
    body = command->symbol == "VV" ? version_lines() : command->symbol == "PP" ? parameter_lines() : state_lines();
    status = "00";
  } else if (command->symbol == "BM") {
    status = std::exchange(is_laser_on_, true) ? "02" : "00";
  } else if (command->symbol == "QT") {
    is_laser_on_ = false;
    stream_.reset();
    status = "00";
  } else if (command->symbol == "CR") {
    status = "04";
  } else if (command->symbol == "HS") {
    status = "03";
  } else if (command->symbol == "MD" || command->symbol == "MS" || command->symbol == "GD" || command->symbol == "GS") {
    status = start_scan(*command, body);
  }
  say(drivers::encode_reply(line, status, body));
}

std::string FakeUtm30lx::answer_time_command(std::string_view parameters, std::string& body) {
  if (parameters == "0") {
    if (stream_) return "10";
    is_laser_on_ = false;
    return std::exchange(is_adjusting_time_, true) ? "02" : "00";
  }
  if (parameters == "1") {
    if (!is_adjusting_time_) return "04";
    drivers::append_line(body, drivers::encode_number(counter_at(turn_due_ns(turn_)), 4));
    return "00";
  }
  if (parameters == "2") return std::exchange(is_adjusting_time_, false) ? "00" : "03";
  return "01";
}

std::string FakeUtm30lx::start_scan(const drivers::Command& command, std::string& body) {
  const bool is_stream = command.symbol.front() == 'M';
  if (auto status = refusal(command.parameters, is_stream); !status.empty()) return status;
  const drivers::ScanRequest request = drivers::parse_scan_request(command).value();
  if (request.last_step >= kBeams) return "04";
  if (request.last_step < request.first_step) return "05";
  if (!is_stream) {
    if (!is_laser_on_) return "10";
    body = scan_body(request);
    return "00";
  }
  is_laser_on_ = true;
  stream_ = request;
  stream_tag_ = command.tag;
  turns_to_skip_ = 0;
  return "00";
}

void FakeUtm30lx::send_scan() {
  const bool is_counted = stream_->scans > 0;
  if (is_counted) --stream_->scans;
  std::string message = drivers::to_command(*stream_);
  if (!stream_tag_.empty()) message += ";" + stream_tag_;
  say(drivers::encode_reply(message, "99", scan_body(*stream_)));
  if (is_counted && stream_->scans == 0) {
    stream_.reset();
    is_laser_on_ = false;
  }
}

std::string FakeUtm30lx::scan_body(const drivers::ScanRequest& request) const {
  std::vector<std::uint32_t> values(kBeams);
  measure_(turn_, turn_start_ns(turn_), values);
  const std::uint32_t largest = (1U << (6 * request.number_length())) - 1;
  drivers::RawScan scan;
  scan.stamp_ms = counter_at(turn_start_ns(turn_));
  for (int step = request.first_step; step <= request.last_step; step += request.effective_cluster()) {
    const int size = std::min(request.effective_cluster(), request.last_step - step + 1);
    const auto group = std::span{values}.subspan(static_cast<std::size_t>(step), static_cast<std::size_t>(size));
    scan.ranges_mm.push_back(std::min(nearest(group), largest));
  }
  return drivers::encode_scan_data(scan, request);
}

void FakeUtm30lx::reset(bool is_clock_reset) {
  stream_.reset();
  is_laser_on_ = false;
  is_adjusting_time_ = false;
  if (!is_clock_reset) return;
  counter_start_ns_ = turn_start_ns(turn_);
  counter_start_ms_ = 0;
}

std::string FakeUtm30lx::version_lines() const {
  std::string lines;
  drivers::append_key_value(lines, "VEND", "Hokuyo Automatic Co.,Ltd.");
  drivers::append_key_value(lines, "PROD", "SOKUIKI Sensor TOP-URG UTM-30LX");
  drivers::append_key_value(lines, "FIRM", "1.18.01(09/Jul./2010)");
  drivers::append_key_value(lines, "PROT", "SCIP 2.0");
  drivers::append_key_value(lines, "SERI", "SIMULATED");
  return lines;
}

std::string FakeUtm30lx::parameter_lines() const {
  std::string lines;
  drivers::append_key_value(lines, "MODL", "UTM-30LX(Hokuyo Automatic Co.,Ltd.)");
  drivers::append_key_value(lines, "DMIN", std::to_string(kLeastRange_mm));
  drivers::append_key_value(lines, "DMAX", "60000");
  drivers::append_key_value(lines, "ARES", std::to_string(kStepsPerTurn));
  drivers::append_key_value(lines, "AMIN", "0");
  drivers::append_key_value(lines, "AMAX", std::to_string(kBeams - 1));
  drivers::append_key_value(lines, "AFRT", std::to_string(kFrontBeam));
  drivers::append_key_value(lines, "SCAN", "2400");
  return lines;
}

std::string FakeUtm30lx::state_lines() const {
  std::string lines;
  drivers::append_key_value(lines, "MODL", "UTM-30LX(Hokuyo Automatic Co.,Ltd.)");
  drivers::append_key_value(lines, "LASR", is_laser_on_ ? "ON" : "OFF");
  drivers::append_key_value(lines, "SCSP", "Initial(2400[rpm])<-Default setting by user");
  drivers::append_key_value(lines, "MESM", "CLASSIC");
  drivers::append_key_value(lines, "SBPS", "USB Full Speed");
  drivers::append_key_value(lines, "TIME", fmt::format("{:06X}", counter_at(turn_due_ns(turn_))));
  drivers::append_key_value(lines, "STAT", "Sensor works well.");
  return lines;
}

}  // namespace stairway::sim
