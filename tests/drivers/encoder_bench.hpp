// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "drivers/disk_encoder.hpp"
#include "tools/sim/fake_encoder_lines.hpp"

namespace stairway::test {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// A disk with a simulated encoder, read by a DiskEncoder in simulated time.
class EncoderBench {
 public:
  explicit EncoderBench(const drivers::EncoderOptions& options = {}, double start_angle_rad = -0.1,
                        double speed_rad_s = 1.0)
      : motion(1'000'000'000, start_angle_rad, speed_rad_s),
        lines(motion, 1'000'000'000, options.counts_per_turn),
        encoder_(
            {[this]() -> tl::expected<std::unique_ptr<drivers::EdgePort>, std::string> {
               ++openings;
               if (!is_plugged) return tl::unexpected(std::string("no such chip"));
               return std::make_unique<Port>(*this);
             },
             [this](std::chrono::nanoseconds timeout) {
               now_ns += timeout.count();
               lines.take(motion, now_ns);
               return false;
             }},
            [this] { return now_ns; }, options) {}

  /// Lets the time go on, and keeps what the encoder tells.
  void run(double duration_s) {
    const drivers::HostStamp end_ns = now_ns + std::llround(1e9 * duration_s);
    while (now_ns < end_ns) {
      const drivers::HostStamp before_ns = now_ns;
      for (const drivers::EncoderEvent& event : encoder_.poll(std::chrono::nanoseconds(end_ns - now_ns))) keep(event);
      if (now_ns == before_ns) ++now_ns;
    }
  }

  std::uint64_t count(drivers::EncoderTrouble trouble) const { return encoder_.session().counters().count(trouble); }
  const drivers::EncoderSession& session() const { return encoder_.session(); }

  /// The greatest difference between the valid samples and the truth, whole turns aside, in counts.
  double worst_error_counts() const {
    double worst = 0.0;
    for (const drivers::AngleSample& sample : samples) {
      if (!sample.valid) continue;
      const double error = std::remainder(sample.angle_rad - motion.angle_at(sample.stamp_ns), kTurn_rad);
      worst = std::max(worst, std::abs(error) / kTurn_rad * session().options().counts_per_turn);
    }
    return worst;
  }

  drivers::HostStamp now_ns = 1'000'000'000;
  sim::DiskMotion motion;
  sim::FakeEncoderLines lines;
  bool is_plugged = true;
  int openings = 0;
  std::vector<drivers::AngleSample> samples;
  std::vector<drivers::EncoderState> states;
  std::vector<std::string> details;

 private:
  class Port : public drivers::EdgePort {
   public:
    explicit Port(EncoderBench& bench) : bench_(bench) {}
    tl::expected<drivers::EdgeBatch, drivers::PortError> read(std::chrono::nanoseconds timeout) override {
      if (!bench_.is_plugged) return tl::unexpected(drivers::PortError::Closed);
      const drivers::HostStamp end_ns = bench_.now_ns + timeout.count();
      bench_.now_ns = std::max(bench_.now_ns, std::min(end_ns, bench_.lines.next_due_ns(bench_.motion)));
      return bench_.lines.take(bench_.motion, bench_.now_ns);
    }
    tl::expected<drivers::LineLevels, drivers::PortError> levels() override {
      if (!bench_.is_plugged) return tl::unexpected(drivers::PortError::Closed);
      return bench_.lines.levels();
    }
    int queued_edges() const override { return 16; }

   private:
    EncoderBench& bench_;
  };

  void keep(const drivers::EncoderEvent& event) {
    if (const auto* more = std::get_if<std::vector<drivers::AngleSample>>(&event))
      samples.insert(samples.end(), more->begin(), more->end());
    if (const auto* state = std::get_if<drivers::EncoderStateEvent>(&event)) states.push_back(state->state);
    if (const auto* trouble = std::get_if<drivers::EncoderTroubleEvent>(&event)) details.push_back(trouble->detail);
  }

  drivers::DiskEncoder encoder_;
};

}  // namespace stairway::test
