// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
//
// Listens to stairwayd and says how a robot would walk to each stairway. A program to copy from.
// Usage: walk_to_stairways [COUNT]; it ends after COUNT whole sweeps, without one never. The bus is that of the
// environment variable LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <stairway/stairways_t.hpp>

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStandOff_m = 0.5;    // where to stand before the first step
constexpr double kMaxSigma_m = 0.010;  // steps known worse than this are not stepped on
constexpr double kMaxAge_s = 60.0;     // a stairway that was seen longer ago has moved with the robot

double age_s(std::int64_t utime_us) {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return 1e-6 *
         static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count() - utime_us);
}

double degrees(double angle_rad) { return angle_rad * 180.0 / kPi; }

double tidy(double value_m) { return std::round(100.0 * value_m) / 100.0 + 0.0; }  // -0.00 is 0.00

const char* railings(const stairway::stairway_t& stairs) {
  if (stairs.railing_left && stairs.railing_right) return "railings on both sides";
  if (stairs.railing_left) return "railing left";
  return stairs.railing_right ? "railing right" : "no railing";
}

void describe(const stairway::stairway_t& stairs) {
  std::printf("stairway %lld: %s, %s, %d steps, height %.0f mm, depth %.0f mm, width %.2f m, %s\n",
              static_cast<long long>(stairs.track_id),
              stairs.kind == stairway::stairway_t::SPIRAL ? "spiral" : "straight",
              stairs.direction == stairway::stairway_t::ASCENDING ? "ascending" : "descending", stairs.num_nosings,
              1e3 * stairs.step_height_m, 1e3 * stairs.step_depth_m, stairs.width_m, railings(stairs));
}

// Where to stand, in the frame `base` of the instant stairs.utime, and what to do there.
void plan(const stairway::stairway_t& stairs) {
  const bool is_ascending = stairs.direction == stairway::stairway_t::ASCENDING;
  // heading_rad is that of ascent; a robot that goes down walks against it.
  const double walk_rad = std::remainder(stairs.heading_rad + (is_ascending ? 0.0 : kPi), 2.0 * kPi);
  const double x_m = tidy(stairs.anchor_m[0] - kStandOff_m * std::cos(walk_rad));
  const double y_m = tidy(stairs.anchor_m[1] - kStandOff_m * std::sin(walk_rad));
  const char* side = stairs.anchor_side == stairway::stairway_t::LEFT    ? "the left"
                     : stairs.anchor_side == stairway::stairway_t::RIGHT ? "the right"
                                                                         : "the middle";
  std::printf("  go to (%.2f, %.2f) m, face %ld deg, keep to %s as seen while ascending, walk %s %d steps", x_m, y_m,
              std::lround(degrees(walk_rad)), side, is_ascending ? "up" : "down", stairs.num_nosings);
  if (stairs.kind == stairway::stairway_t::SPIRAL)
    std::printf(", turning %+.0f deg a step", degrees(stairs.turn_per_step_rad));
  std::printf("\n");
}

class Walker {
 public:
  void on_stairways(const lcm::ReceiveBuffer*, const std::string&, const stairway::stairways_t* message) {
    const auto sweep = static_cast<long long>(message->sweep);
    if (age_s(message->utime) > kMaxAge_s) {
      std::printf("sweep %lld is too old to act on\n", sweep);
    } else if (!message->is_final) {
      // Enough to walk towards them; the whole sweep may show more steps, and more of their width.
      for (const stairway::stairway_t& stairs : message->stairways) {
        std::printf("so far: ");
        describe(stairs);
      }
    } else if (message->stairways.empty()) {
      std::printf("sweep %lld shows no stairway: %s\n", sweep,
                  message->rejected.empty() ? "no candidate" : message->rejected.front().reason.c_str());
    } else {
      for (const stairway::stairway_t& stairs : message->stairways) {
        describe(stairs);
        if (std::max(stairs.step_height_sigma_m, stairs.step_depth_sigma_m) <= kMaxSigma_m) {
          plan(stairs);
        } else {
          std::printf("  too uncertain to step on: go nearer and look again\n");
        }
      }
    }
    answers_ += message->is_final ? 1 : 0;
    std::fflush(stdout);
  }

  int answers() const { return answers_; }

 private:
  int answers_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 0;
  const char* url = std::getenv("LCM_DEFAULT_URL");
  lcm::LCM bus(url != nullptr ? url : "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  if (!bus.good()) {
    std::fprintf(stderr, "no LCM; without a network: ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo\n");
    return 1;
  }
  Walker walker;
  // Of answers only the newest matters.
  bus.subscribe("STAIRWAY_STAIRWAYS", &Walker::on_stairways, &walker)->setQueueCapacity(1);
  while (bus.handle() == 0) {
    if (count > 0 && walker.answers() >= count) return 0;
  }
  std::fprintf(stderr, "LCM has ended\n");
  return 1;
}
