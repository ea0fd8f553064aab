// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/flight_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "detector/side_surface.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kBeyond_m = 0.6;
// What an end may be off by for reasons its scatter does not show.
constexpr double kEndFloor_m = 0.004;
constexpr double kSurfaceFloor_m = 0.001;

/// A line of sight that crosses the flight's face near an end; `out_m` grows outwards.
struct Crossing {
  double out_m = 0.0;
  double spread_m = 0.0;   ///< radius of the spot along the face
  double farther_m = 0.0;  ///< than the face it went
  double share = 1.0;      ///< of the spot that the face stopped: all or nothing
  int step = 0;
};

/// Crossings near one end.
class EndSearch {
 public:
  EndSearch(double outward, const Interval& sides, const SpotOptions& spot, double reach_m)
      : outward_(outward),
        about_m_(outward > 0.0 ? sides.high : -sides.low),
        middle_m_(outward * sides.middle()),
        spot_(spot),
        reach_m_(reach_m) {}

  void add(double v, double spread_m, double farther_m, int step, double ended_v) {
    Crossing c{.out_m = outward_ * v, .spread_m = spread_m, .farther_m = farther_m, .share = 1.0, .step = step};
    if (c.out_m < middle_m_ || c.out_m > about_m_ + kBeyond_m) return;
    sights_.push_back({.crossing_m = c.out_m, .ended_m = outward_ * ended_v, .farther_m = farther_m});
    if (farther_m > -kStoppedBefore * reach_m_) {
      crossings_.push_back(c);
    } else {
      // What stands in the way; it counts once it is known to stand beyond the end.
      c.share = 0.0;
      c.farther_m = outward_ * ended_v;
      stopped_.push_back(c);
    }
  }

  std::optional<Estimate> end() {
    if (crossings_.size() < kFewest) return std::nullopt;
    if (const std::optional<Estimate> surface = find_side_surface(sights_, about_m_, reach_m_))
      return Estimate{outward_ * surface->value, std::hypot(surface->sigma, kSurfaceFloor_m)};
    for (Crossing& c : crossings_) c.share = c.farther_m < reach_m_ ? 1.0 : 0.0;
    std::optional<double> place = best_cut(crossings_);
    if (!place) return std::nullopt;
    split_half_way(*place);
    std::vector<Crossing> all = crossings_;
    for (const Crossing& c : stopped_)
      if (c.farther_m > *place - kBesideEnd_m && c.out_m > *place + c.spread_m) all.push_back(c);
    place = best_cut(all);
    if (!place) return std::nullopt;
    return refined(all, *place);
  }

 private:
  static constexpr std::size_t kFewest = 30;
  static constexpr double kBesideEnd_m = 0.02;
  static constexpr double kStoppedBefore = 3.0;  // reaches

  // The cut with fewest beams on the wrong side of it.
  static std::optional<double> best_cut(std::vector<Crossing>& all) {
    constexpr std::ptrdiff_t kFewestEach = 8;
    std::sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.out_m < b.out_m; });
    const auto is_on = [](const Crossing& c) { return c.share > 0.5; };
    const auto ons = std::count_if(all.begin(), all.end(), is_on);
    if (ons < kFewestEach || static_cast<std::ptrdiff_t>(all.size()) - ons < kFewestEach) return std::nullopt;
    std::ptrdiff_t wrong = ons;  // when all lie beyond the cut
    std::ptrdiff_t fewest = wrong;
    std::size_t best = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      wrong += is_on(all[i]) ? -1 : 1;
      if (wrong >= fewest) continue;
      fewest = wrong;
      best = i + 1;
    }
    if (best == 0 || best == all.size()) return std::nullopt;
    return 0.5 * (all[best - 1].out_m + all[best].out_m);
  }

  // Of a spot that the end cuts in half, the range is half way to what lies near behind the face, too.
  void split_half_way(double place) {
    constexpr double kNextToEnd_m = 0.03;
    std::map<int, std::vector<double>> behind;
    for (const Crossing& c : crossings_)
      if (c.out_m > place + c.spread_m && c.out_m < place + c.spread_m + kNextToEnd_m)
        behind[c.step].push_back(c.farther_m);
    for (Crossing& c : crossings_) {
      const auto found = behind.find(c.step);
      if (found == behind.end()) continue;
      const double gap = outer_quartile(found->second, false);
      c.share = c.farther_m < std::clamp(0.5 * gap, reach_m_, 0.5 * spot_.pulse_separation_m) ? 1.0 : 0.0;
    }
  }

  // Least squares between the shares seen and those of a spot that the end cuts.
  std::optional<Estimate> refined(const std::vector<Crossing>& all, double place) const {
    constexpr int kRounds = 8;
    constexpr double kStep_m = 1e-4;
    constexpr double kWild = 0.75;
    constexpr double kLeastSpread_m = 2e-3;
    const auto share = [&](const Crossing& c, double end) {
      return share_below_chord((end - c.out_m) / std::max(c.spread_m, kLeastSpread_m));
    };
    double information = 0.0;
    double chi2 = 0.0;
    double count = 0.0;
    for (int round = 0; round < kRounds; ++round) {
      double pull = 0.0;
      information = chi2 = count = 0.0;
      for (const Crossing& c : all) {
        const double slope = (share(c, place + kStep_m) - share(c, place - kStep_m)) / (2.0 * kStep_m);
        if (slope == 0.0) continue;
        const double off = c.share - share(c, place);
        if (std::abs(off) > kWild) continue;
        information += slope * slope;
        pull += slope * off;
        chi2 += off * off;
        count += 1.0;
      }
      if (!(information > 0.0)) return std::nullopt;
      place += std::clamp(pull / information, -0.01, 0.01);
    }
    const double sigma = std::sqrt(chi2 / std::max(1.0, count - 1.0) / information);
    return Estimate{outward_ * place, std::hypot(sigma, kEndFloor_m)};
  }

  double outward_;
  double about_m_;
  double middle_m_;
  SpotOptions spot_;
  double reach_m_;  // a beam ended on the face when it went no farther beyond it than this
  std::vector<Crossing> crossings_;
  std::vector<Crossing> stopped_;
  std::vector<SideSight> sights_;
};

}  // namespace

FlightEnds find_flight_ends(const StairCorridor& corridor, const StepFrame& frame, const StepPoint& sensor,
                            std::span<const VisibleFace> faces, const Interval& sides, const SpotOptions& spot,
                            double range_sigma_m, int floor_step) {
  constexpr double kReach_sigmas = 1.5;  // a flank begins where the face ends
  constexpr double kAlongNosing = 0.2;
  const Backdrop unknown{.inverse_per_m = std::numeric_limits<double>::quiet_NaN()};
  EndSearch right(-1.0, sides, spot, kReach_sigmas * range_sigma_m);
  EndSearch left(+1.0, sides, spot, kReach_sigmas * range_sigma_m);
  for (const Eigen::Vector3d& point : corridor.points()) {
    const StepPoint p = frame.to_step(point);
    const Eigen::Vector3d beam(p.u - sensor.u, p.v - sensor.v, p.z - sensor.z);
    const double plane_m = std::hypot(beam.x(), beam.z());
    const double scale = beam.norm() / plane_m;
    if (plane_m < kAlongNosing * beam.norm()) continue;
    const double elevation = std::atan2(beam.z(), beam.x());
    const SpotEcho echo = echo_of(faces, elevation, spot.radius_rad * scale, unknown, spot.pulse_separation_m / scale);
    if (!echo.is_known || echo.is_split) continue;
    const auto face = std::lower_bound(faces.begin(), faces.end(), elevation,
                                       [](const VisibleFace& f, double at) { return f.end_rad < at; });
    if (face->kind == VisibleFace::Kind::Level && face->step == floor_step) continue;
    const double v = sensor.v + beam.y() * echo.range_m / plane_m;
    const double spread_m = spot.radius_rad * echo.range_m * scale * scale;
    for (EndSearch* end : {&right, &left}) end->add(v, spread_m, (plane_m - echo.range_m) * scale, face->step, p.v);
  }
  return {.right = right.end(), .left = left.end()};
}

}  // namespace stairway::detect
