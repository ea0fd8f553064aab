// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_utm30lx.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "drivers/scip/scip_codec.hpp"
#include "drivers/scip/scip_replies.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/scanner_model.hpp"
#include "tools/sim/sensor_texts.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr std::size_t kLongestLine = 100;
constexpr std::size_t kMostCommands = 16;
constexpr HostStamp kHostBuffer_ns = 1'000'000'000;
constexpr std::uint32_t kCounterMask = 0xffffff;
constexpr int kLeastRange_mm = 23;
constexpr std::size_t kLongestTag = 16;
constexpr std::int64_t kClockJump_ms = 100'000;
constexpr HostStamp kFastAnswer_ns = 1'000'000;
// Beams with intensity that it manages in one turn of the mirror: 95 degrees.
constexpr int kMostBeamsWithIntensity = 381;

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

// Some strength that falls with the distance, as of a grey wall; 0 where there is no echo.
std::uint32_t intensity_of(std::uint32_t range_mm) {
  return range_mm < kLeastRange_mm ? 0 : 16'000'000 / (1000 + std::min(range_mm, 100'000U));
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
    if (line_ == "TM1" && options_.answers_time_at_once && commands_.empty()) {
      answer_time_at_once(now_ns);
    } else if (!line_.empty() && commands_.size() < kMostCommands) {
      commands_.push_back({now_ns, line_});
    }
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
  if (is_stuck_ || faults_.take(SensorFault::Stuck)) {
    is_stuck_ = true;
    return;
  }
  if (is_checking_itself()) return;
  if (turns_to_skip_ > 0) {
    --turns_to_skip_;
    return;
  }
  turns_to_skip_ = stream_->skip_scan;
  send_scan();
}

void FakeUtm30lx::inject(SensorFault fault, int count) {
  if (fault == SensorFault::ClockJump) {
    counter_start_ms_ += kClockJump_ms;
  } else if (fault == SensorFault::ClockReset) {
    set_counter_to_zero();
  } else {
    faults_.add(fault, count);
  }
}

bool FakeUtm30lx::is_checking_itself() {
  if (const int turns = faults_.take_all(SensorFault::SelfCheck); turns > 0) {
    check_turns_ = turns;
    say(drivers::encode_reply(stream_echo(), "21"));
    return true;
  }
  if (check_turns_ == 0) return false;
  if (--check_turns_ == 0) say(drivers::encode_reply(stream_echo(), "98"));
  return true;
}

// In two pieces, and every third message broken; the turn in between is lost.
void FakeUtm30lx::say_slowly(std::string message) {
  if (turn_ % 3 == 0) message = with_flipped_bit(std::move(message), stream_echo().size() + 5, turn_);
  const std::size_t half = message.size() / 2;
  say(message.substr(0, half));
  say(message.substr(half), turn_start_ns(1) - turn_start_ns(0));
  turns_to_skip_ = 1;
}

void FakeUtm30lx::say(std::string bytes, HostStamp delay_ns) {
  if (faults_.take(SensorFault::Garbage)) bytes = with_garbage_before(bytes, turn_);
  output_.push_back({turn_due_ns(turn_) + delay_ns, std::move(bytes), 0});
}

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
    body = describe(command->symbol);
    status = "00";
  } else if (command->symbol == "BM") {
    const bool is_refused = faults_.take(SensorFault::LaserNotReady);
    status = is_refused ? "10" : std::exchange(is_laser_on_, true) ? "02" : "00";
  } else if (command->symbol == "QT") {
    if (faults_.take(SensorFault::QuitIgnored)) return;
    is_laser_on_ = false;
    end_stream();
    status = "00";
  } else if (command->symbol == "CR") {
    status = "04";
  } else if (command->symbol == "HS") {
    status = "03";
  } else if (command->symbol == "MD" || command->symbol == "MS" || command->symbol == "ME" || command->symbol == "GD" ||
             command->symbol == "GS") {
    status = start_scan(*command, body);
  }
  say(drivers::encode_reply(line, status, body));
}

std::string FakeUtm30lx::answer_time_command(std::string_view parameters, std::string& body) {
  if (parameters == "0") {
    if (stream_ || faults_.take(SensorFault::TimeRefused)) return "10";
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

void FakeUtm30lx::answer_time_at_once(HostStamp now_ns) {
  std::string body;
  if (is_adjusting_time_) {
    drivers::append_line(body, drivers::encode_number(counter_at(now_ns + kFastAnswer_ns / 2), 4));
  }
  output_.push_back({now_ns + kFastAnswer_ns, drivers::encode_reply("TM1", is_adjusting_time_ ? "00" : "04", body), 0});
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
  end_stream();
  stream_ = request;
  stream_tag_ = command.tag;
  turns_to_skip_ = 0;
  return "00";
}

std::string FakeUtm30lx::stream_echo() const {
  return drivers::to_command(*stream_) + (stream_tag_.empty() ? "" : ";" + stream_tag_);
}

std::string FakeUtm30lx::describe(std::string_view symbol) {
  if (symbol == "VV") return version_lines(options_.firmware, options_.serial);
  if (symbol == "PP") return parameter_lines();
  const bool is_ill = faults_.take(SensorFault::StatTrouble);
  return state_lines(is_laser_on_, counter_at(turn_due_ns(turn_)),
                     is_ill ? "Trouble!! Error No. =[00->33] " : "Sensor works well.");
}

void FakeUtm30lx::send_scan() {
  if (faults_.take(SensorFault::LaserFault)) {
    say(drivers::encode_reply(stream_echo(), "50"));
    end_stream();
    return;
  }
  const bool is_counted = stream_->scans > 0;
  if (is_counted) --stream_->scans;
  const std::string echo = stream_echo();
  std::string message = drivers::encode_reply(echo, "99", scan_body(*stream_));
  if (faults_.take(SensorFault::WrongLength)) is_short_ = true;
  if (is_short_) message = without_last_data_line(std::move(message));
  if (faults_.take(SensorFault::BadSum)) message = with_flipped_bit(std::move(message), echo.size() + 5, turn_);
  if (faults_.take(SensorFault::LostLineFeed)) message = without_a_line_feed(std::move(message), turn_);
  if (is_overloaded()) {
    say_slowly(std::move(message));
  } else {
    say(std::move(message));
  }
  if (is_counted && stream_->scans == 0) {
    end_stream();
    is_laser_on_ = false;
  }
}

bool FakeUtm30lx::is_overloaded() const {
  return stream_->has_intensity() && stream_->skip_scan == 0 && stream_->max_values() > kMostBeamsWithIntensity;
}

void FakeUtm30lx::end_stream() {
  stream_.reset();
  is_stuck_ = false;
  is_short_ = false;
  check_turns_ = 0;
}

std::string FakeUtm30lx::scan_body(const drivers::ScanRequest& request) {
  std::vector<std::uint32_t> values(kBeams);
  measure_(turn_, turn_start_ns(turn_), values);
  const std::uint32_t largest = (1U << (6 * request.number_length())) - 1;
  drivers::RawScan scan;
  if (!faults_.take(SensorFault::RepeatedStamp)) last_stamp_ms_ = counter_at(turn_start_ns(turn_));
  scan.stamp_ms = last_stamp_ms_;
  for (int step = request.first_step; step <= request.last_step; step += request.effective_cluster()) {
    const int size = std::min(request.effective_cluster(), request.last_step - step + 1);
    const auto group = std::span{values}.subspan(static_cast<std::size_t>(step), static_cast<std::size_t>(size));
    scan.ranges_mm.push_back(std::min(nearest(group), largest));
    if (request.has_intensity()) scan.intensities.push_back(intensity_of(scan.ranges_mm.back()));
  }
  return drivers::encode_scan_data(scan, request);
}

void FakeUtm30lx::reset(bool is_clock_reset) {
  end_stream();
  is_laser_on_ = false;
  is_adjusting_time_ = false;
  if (is_clock_reset) set_counter_to_zero();
}

void FakeUtm30lx::set_counter_to_zero() {
  counter_start_ns_ = turn_start_ns(turn_);
  counter_start_ms_ = 0;
}

}  // namespace stairway::sim
