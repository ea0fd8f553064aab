// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drivers/scip/scip_codec.hpp"
#include "drivers/scip/scip_session.hpp"
#include "tests/drivers/scip_samples.hpp"
#include "tests/drivers/scripted_sensor.hpp"
#include "tests/fuzz/targets.hpp"

namespace stairway::fuzz {
namespace {

using namespace drivers;

constexpr HostStamp kMs = 1'000'000;
constexpr HostStamp kPauses_ns[] = {0, kMs, 25 * kMs, 150 * kMs, 1000 * kMs, 10'000 * kMs, 3'600'000 * kMs, 77 * kMs};
constexpr HostStamp kRecovery_ns = 120'000 * kMs;
constexpr int kScansToRecover = 3;
constexpr std::size_t kMaxPieces = 64;  // of 255 bytes: more than one message may be long
constexpr std::size_t kMaxDetail = 256;
constexpr std::size_t kMaxOutput = 256;

enum Action : std::uint8_t { Raw, Summed, Usual, Damaged, Time, Disconnect, Repeat, Lost, Retry, kActions };

ScipOptions options_of(std::uint8_t choice) {
  ScipOptions options;
  options.min_angle_rad = -0.05;  // 23 beams: two lines of data
  options.max_angle_rad = 0.05;
  options.intensities = (choice & 1) != 0;
  options.cluster = (choice & 2) != 0 ? 4 : 1;
  options.skip_scan = (choice & 4) != 0 ? 2 : 0;
  options.stamp_reference = (choice & 8) != 0 ? StampReference::Step0 : StampReference::Rear;
  require(options.problem().empty(), "the options of the test are usable");
  return options;
}

/// A session between a fuzzer and a sensor in order, of which the fuzzer decides what is heard.
class Bench {
 public:
  explicit Bench(const ScipOptions& options) : session_(options) { take(session_.on_time(now_ns_)); }

  void bytes(std::string_view bytes) { take(session_.on_bytes(bytes, now_ns_)); }
  void disconnect() { take(session_.on_disconnect(now_ns_, "unplugged")); }
  void lose(std::size_t bytes) { take(session_.on_lost_bytes(bytes)); }
  void retry() { session_.retry_now(now_ns_); }

  void wait(HostStamp pause_ns) {
    if (pause_ns > 1000 * kMs) sensor_.is_streaming = false;
    now_ns_ += pause_ns;
    take(session_.on_time(now_ns_));
  }

  /// Hands on what the sensor says in the next `turns` turns of the mirror, with one byte changed.
  void listen(int turns, std::size_t damaged_byte, std::uint8_t flipped_bits) {
    for (int turn = 0; turn < turns; ++turn) {
      now_ns_ += ScriptedSensor::kPeriod_ns;
      for (auto& [at_ns, bytes] : sensor_.send(now_ns_)) {
        if (!bytes.empty()) bytes[damaged_byte % bytes.size()] ^= static_cast<char>(flipped_bits);
        take(session_.on_bytes(bytes, now_ns_));
      }
      take(session_.on_time(now_ns_));
    }
  }

  /// A sensor in order is heard again, however it was left.
  void recover() {
    const std::uint64_t enough = session_.counters().scans + kScansToRecover;
    const HostStamp end_ns = now_ns_ + kRecovery_ns;
    while (session_.counters().scans < enough && now_ns_ < end_ns) listen(1, 0, 0);
    require(session_.counters().scans >= enough, "after garbage, a sensor in order is decoded again");
  }

  const std::string& last_command() const { return last_command_; }

 private:
  void take(const std::vector<ScipEvent>& events) {
    for (const ScipEvent& event : events) std::visit([](const auto& one) { check(one); }, event);
    const std::string output = session_.take_output();
    require(output.size() <= kMaxOutput, "one step asks for a few commands at most");
    sensor_.receive(output, now_ns_);
    if (!sensor_.commands.empty()) last_command_ = sensor_.commands.back();
    sensor_.commands.clear();
  }

  static void check(const LaserScan& scan) {
    require(scan.ranges_m.size() == scan.statuses.size(), "every range has a status");
    require(scan.ranges_m.size() <= 10'000, "a scan has no more beams than the request has digits for");
    require(std::isfinite(scan.first_angle_rad) && scan.beam_interval_ns > 0.0, "angles and intervals are numbers");
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const bool is_ok = scan.statuses[i] == BeamStatus::Ok;
      require(std::isfinite(scan.ranges_m[i]) == is_ok, "a beam has a distance exactly when it is ok");
    }
  }
  static void check(const ScipTroubleEvent& event) {
    require(!event.detail.empty() && event.detail.size() <= kMaxDetail, "a trouble is told in one line");
  }
  static void check(const ScipDeviceInfo& info) {
    require(info.parameters.scan_speed_rpm > 0 && info.parameters.steps_per_turn > 0, "parameters divide");
  }
  static void check(const ScipStateEvent&) {}
  static void check(const ScipReopenEvent&) {}

  ScriptedSensor sensor_;
  ScipSession session_;
  HostStamp now_ns_ = 5'000 * kMs;
  std::string last_command_;
};

/// A reply with good sums around whatever the lines say.
std::string summed(const std::string& command, FuzzInput& input) {
  std::string status = input.text(2);
  status.resize(2, '0');
  std::string data;
  for (int lines = input.byte() % 32; lines > 0; --lines) append_line(data, input.text(input.byte() % 80));
  return encode_reply(command, status, data);
}

std::string repeated(const std::string& piece, std::size_t times) {
  std::string bytes;
  for (; times > 0; --times) bytes += piece;
  return bytes;
}

void step(Bench& bench, FuzzInput& input) {
  const std::uint8_t action = input.byte() % kActions;
  switch (action) {
    case Raw:
      return bench.bytes(input.text(input.byte()));
    case Repeat: {
      const std::size_t times = input.byte() % (kMaxPieces + 1);
      return bench.bytes(repeated(input.text(input.byte()), times));
    }
    case Summed:
      return bench.bytes(summed(bench.last_command(), input));
    case Usual:
      return bench.listen(1 + input.byte() % 16, 0, 0);
    case Damaged: {
      const auto flipped_bits = input.byte();
      const std::size_t at = input.byte() * 256U + input.byte();
      return bench.listen(1, at, flipped_bits);
    }
    case Time:
      return bench.wait(kPauses_ns[input.byte() % std::size(kPauses_ns)]);
    case Lost:
      return bench.lose(input.byte());
    case Retry:
      return bench.retry();
    default:
      return bench.disconnect();
  }
}

Seed seed_of(std::initializer_list<std::uint8_t> bytes) { return bytes; }

void append_raw(Seed& seed, std::string_view text) {
  seed.push_back(Raw);
  seed.push_back(static_cast<std::uint8_t>(text.size()));
  append(seed, text);
}

}  // namespace

void run_scip(std::span<const std::uint8_t> bytes) {
  FuzzInput input(bytes);
  Bench bench(options_of(input.byte()));
  while (!input.is_empty()) step(bench, input);
  bench.recover();
}

std::vector<Seed> scip_seeds() {
  std::vector<Seed> seeds;
  // A sensor in order, from the start to the stream; then one that is damaged, falls silent, and is unplugged.
  seeds.push_back(seed_of({0, Time, 3, Usual, 15, Usual, 15, Usual, 15, Usual, 15}));
  seeds.push_back(
      seed_of({0, Time, 3, Usual, 15, Usual, 15, Damaged, 1, 0, 40, Usual, 3, Damaged, 16, 0, 0, Usual, 3}));
  seeds.push_back(
      seed_of({0, Time, 3, Usual, 15, Usual, 15, Usual, 5, Time, 4, Time, 4, Usual, 9, Disconnect, Time, 4}));
  for (const std::string& reply : {samples::kVersion, samples::kParameters, samples::kState, samples::kMd, samples::kMe,
                                   std::string("TM1\n00P\n00?Xg\n\n"), std::string("CR00\n04T\n\n"),
                                   std::string("XX\n0Ee\n\n"), std::string("BM\n02R\n\n")}) {
    Seed seed = seed_of({0, Time, 3, Usual, 9});
    for (std::size_t at = 0; at < reply.size(); at += 200) append_raw(seed, std::string_view(reply).substr(at, 200));
    seeds.push_back(seed);
  }
  Seed lines = seed_of({0, Time, 3, Usual, 3, Summed});
  append(lines, "00");
  lines.insert(lines.end(), {2, 8});
  append(lines, "DMIN:23;");
  lines.push_back(11);
  append(lines, "DMAX:60000;");
  seeds.push_back(lines);
  Seed endless = seed_of({0, Time, 3, Usual, 15, Usual, 15, Repeat, 64, 3});
  append(endless, "MD0");
  seeds.push_back(endless);
  return seeds;
}

}  // namespace stairway::fuzz
