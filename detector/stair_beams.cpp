// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kUnsureSpots = 1.5;  // how far edges are taken to reach, in spots, while the model is not exact
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A beam and the faces it may have met.
struct Candidate {
  StairBeam beam;
  Elevation elevation;
  double plane_m = 0.0;  // within the plane of the profile
  double spread_rad = 0.0;

  double aside_rad() const { return std::atan2(beam.v, plane_m); }
  std::size_t first_face = 0;
  std::size_t last_face = 0;
  std::uint64_t key = 0;  // of its own, from its place alone
};

// As good as random, yet told by the place alone, of which rounding is cut off.
std::uint64_t scrambled(const Eigen::Vector3d& place) {
  constexpr double kRounded_m = 1e-5;
  std::uint64_t hash = 0;
  for (const double value : place) {
    hash ^= static_cast<std::uint64_t>(std::llround(value / kRounded_m));
    hash *= 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

/// What is seen past the flight, by the gap one looks through and the direction aside.
class Background {
 public:
  // @pre the beam meets one face. It is of use only where it passes near an edge.
  void add(const Candidate& c, std::span<const VisibleFace> faces) {
    const VisibleFace& face = faces[c.first_face];
    const double reach = (kReachSpots + kUnsureSpots) * c.spread_rad;
    if (c.elevation.rad > face.begin_rad + reach && c.elevation.rad < face.end_rad - reach) return;
    if (const auto key = key_of(c, faces)) seen_[*key].push_back({c.elevation.rad, c.plane_m});
  }

  // That of the beams whose elevation is nearest.
  Backdrop at(const Candidate& c, std::span<const VisibleFace> faces) const {
    constexpr std::size_t kNearest = 12;
    constexpr std::size_t kFewest = 6;
    const Backdrop unknown{.inverse_per_m = kNaN};
    const auto key = key_of(c, faces);
    const auto place = key ? seen_.find(*key) : seen_.end();
    if (place == seen_.end() || place->second.size() < kFewest) return unknown;
    std::vector<Seen> near = place->second;
    const auto off = [&](const Seen& s) { return std::abs(s.elevation_rad - c.elevation.rad); };
    const auto end = near.begin() + static_cast<std::ptrdiff_t>(std::min(kNearest, near.size()));
    std::partial_sort(near.begin(), end, near.end(), [&](const Seen& a, const Seen& b) { return off(a) < off(b); });
    near.erase(end, near.end());
    std::erase_if(near, [&](const Seen& s) { return off(s) > kReachSpots * c.spread_rad; });
    return near.size() < kFewest ? unknown : plane_through(near, c.elevation.rad);
  }

 private:
  static constexpr double kReachSpots = 3.0;
  static constexpr double kAside_rad = 0.02;
  static constexpr double kEven_m = 0.05;
  struct Seen {
    double elevation_rad = 0.0;
    double range_m = 0.0;
  };
  using Key = std::pair<std::size_t, int>;

  static Backdrop plane_through(const std::vector<Seen>& seen, double elevation_rad) {
    constexpr double kLeastSpread_rad = 1e-3;
    const auto n = static_cast<Eigen::Index>(seen.size());
    Eigen::ArrayXd x(n), y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      x[i] = seen[static_cast<std::size_t>(i)].elevation_rad - elevation_rad;
      y[i] = 1.0 / seen[static_cast<std::size_t>(i)].range_m;
    }
    const double spread = (x - x.mean()).square().sum();
    const double slope =
        spread > kLeastSpread_rad * kLeastSpread_rad ? ((x - x.mean()) * (y - y.mean())).sum() / spread : 0.0;
    const Backdrop plane{y.mean() - slope * x.mean(), slope, elevation_rad};
    const Eigen::ArrayXd off = 1.0 / (plane.inverse_per_m + slope * x) - 1.0 / y;
    const bool is_even = std::sqrt(off.square().mean()) < kEven_m;
    return is_even ? plane : Backdrop{.inverse_per_m = kNaN};
  }

  // The face past the flight that the spot touches.
  static std::optional<Key> key_of(const Candidate& c, std::span<const VisibleFace> faces) {
    for (std::size_t i = c.first_face; i <= c.last_face; ++i) {
      if (faces[i].kind != VisibleFace::Kind::Beyond) continue;
      return Key{i, static_cast<int>(std::floor(c.aside_rad() / kAside_rad))};
    }
    return std::nullopt;
  }

  std::map<Key, std::vector<Seen>> seen_;
};

/// About so many of all candidates, those with the smallest keys; few more are ever kept.
class Draw {
 public:
  explicit Draw(int wanted) : wanted_(static_cast<double>(wanted)) {}

  void add(const Candidate& candidate) {
    constexpr double kMost = 4.0;  // times the wanted, so that halves of them are enough
    ++seen_;
    if (candidate.key > highest_key_) return;
    kept_.push_back(candidate);
    if (static_cast<double>(kept_.size()) > kMost * wanted_) drop_above(highest_key_ / 2);
  }

  const std::vector<Candidate>& drawn() {
    constexpr double kKeys = 0x1p64;
    const double share = wanted_ / static_cast<double>(std::max<std::size_t>(1, seen_));
    if (share < 1.0) drop_above(static_cast<std::uint64_t>(share * kKeys));
    return kept_;
  }

 private:
  void drop_above(std::uint64_t key) {
    highest_key_ = std::min(highest_key_, key);
    std::erase_if(kept_, [&](const Candidate& c) { return c.key > highest_key_; });
  }

  double wanted_;
  std::uint64_t highest_key_ = std::numeric_limits<std::uint64_t>::max();
  std::size_t seen_ = 0;
  std::vector<Candidate> kept_;
};

class BeamSelection {
 public:
  BeamSelection(const StepPoint& sensor, std::span<const VisibleFace> faces, const Interval& sides,
                double spot_radius_rad, int most_on_edges, int most_on_planes)
      : sensor_(sensor),
        faces_(faces),
        sides_(sides),
        spot_radius_rad_(spot_radius_rad),
        on_edges_(most_on_edges),
        on_planes_(most_on_planes) {}

  /// @param place  of the same point, in a frame that does not change while a flight is fitted.
  void look_at(const StepPoint& p, const Eigen::Vector3d& place) {
    constexpr double kAlongNosing = 0.2;  // beams that run along the nosings tell little
    const StairBeam beam{.u = p.u - sensor_.u, .v = p.v - sensor_.v, .z = p.z - sensor_.z};
    const double plane_m = std::sqrt(beam.u * beam.u + beam.z * beam.z);
    const double range_m = std::sqrt(plane_m * plane_m + beam.v * beam.v);
    if (!(plane_m > kAlongNosing * range_m)) return;
    Candidate c{.beam = beam,
                .elevation = {beam.u, beam.z, plane_m},
                .plane_m = plane_m,
                .spread_rad = spot_radius_rad_ * range_m / plane_m};
    find_faces(c);
    const bool is_single = c.first_face == c.last_face;
    const VisibleFace::Kind kind = faces_[c.first_face].kind;
    if (is_single && kind == VisibleFace::Kind::Unknown) return;
    if (is_single && kind == VisibleFace::Kind::Beyond) return background_.add(c, faces_);
    if (is_in_the_way(c)) obstacles_.insert(cell_of(c));
    if (!passes_between_sides(c)) return;
    c.key = scrambled(place);
    (is_single ? on_planes_ : on_edges_).add(c);
  }

  std::vector<StairBeam> beams() {
    std::vector<StairBeam> beams;
    for (Draw* const draw : {&on_edges_, &on_planes_}) {
      for (const Candidate& c : draw->drawn()) {
        if (is_beside_obstacle(c)) continue;
        beams.push_back(c.beam);
        beams.back().backdrop = background_.at(c, faces_);
      }
    }
    return beams;
  }

 private:
  void find_faces(Candidate& c) const {
    const double reach = kUnsureSpots * c.spread_rad;
    const auto first =
        std::lower_bound(faces_.begin(), faces_.end(), c.elevation.rad - reach,
                         [](const VisibleFace& face, double elevation) { return face.end_rad < elevation; });
    c.first_face = std::min(static_cast<std::size_t>(first - faces_.begin()), faces_.size() - 1);
    c.last_face = c.first_face;
    while (c.last_face + 1 < faces_.size() && faces_[c.last_face + 1].begin_rad < c.elevation.rad + reach)
      ++c.last_face;
    c.beam.first_step = std::numeric_limits<int>::max();
    c.beam.last_step = std::numeric_limits<int>::min();
    for (std::size_t i = c.first_face; i <= c.last_face; ++i) {
      c.beam.first_step = std::min(c.beam.first_step, faces_[i].step);
      c.beam.last_step = std::max(c.beam.last_step, faces_[i].step);
    }
  }

  static double distance_on(const VisibleFace& face, const Candidate& c) {
    return face.distance_m(c.elevation.near_by(std::clamp(c.elevation.rad, face.begin_rad, face.end_rad)));
  }

  bool passes_between_sides(const Candidate& c) const {
    constexpr double kClear_m = 0.02;
    for (std::size_t i = c.first_face; i <= c.last_face; ++i) {
      const VisibleFace& face = faces_[i];
      if (face.kind == VisibleFace::Kind::Beyond || face.kind == VisibleFace::Kind::Unknown) continue;
      const double distance = distance_on(face, c);
      const double v = sensor_.v + c.beam.v * distance / c.plane_m;
      const double margin = kClear_m + spot_radius_rad_ * distance;
      if (v < sides_.low + margin || v > sides_.high - margin) return false;
    }
    return true;
  }

  // Shorter than anything there.
  bool is_in_the_way(const Candidate& c) const {
    constexpr double kBefore_m = 0.06;
    for (std::size_t i = c.first_face; i <= c.last_face; ++i) {
      const VisibleFace& face = faces_[i];
      if (face.kind == VisibleFace::Kind::Beyond || face.kind == VisibleFace::Kind::Unknown) continue;
      if (c.plane_m > distance_on(face, c) - kBefore_m) return false;
    }
    return true;
  }

  using Cell = std::pair<int, int>;
  Cell cell_of(const Candidate& c) const {
    const double size_rad = std::max(2.0 * spot_radius_rad_, 5e-3);
    return {static_cast<int>(std::floor(c.elevation.rad / size_rad)),
            static_cast<int>(std::floor(c.aside_rad() / size_rad))};
  }
  bool is_beside_obstacle(const Candidate& c) const {
    const Cell cell = cell_of(c);
    for (int up = -1; up <= 1; ++up)
      for (int aside = -1; aside <= 1; ++aside)
        if (obstacles_.contains({cell.first + up, cell.second + aside})) return true;
    return false;
  }

  StepPoint sensor_;
  std::span<const VisibleFace> faces_;
  Interval sides_;
  double spot_radius_rad_;
  Background background_;
  std::set<Cell> obstacles_;
  Draw on_edges_;
  Draw on_planes_;
};

}  // namespace

std::vector<StairBeam> select_beams(const StairCorridor& corridor, const StepFrame& frame, const StepPoint& sensor,
                                    std::span<const VisibleFace> faces, const Interval& sides, double spot_radius_rad,
                                    int most_on_edges, int most_on_planes) {
  if (faces.empty()) return {};
  BeamSelection selection(sensor, faces, sides, spot_radius_rad, most_on_edges, most_on_planes);
  for (const Eigen::Vector3d& point : corridor.points()) selection.look_at(frame.to_step(point), point);
  return selection.beams();
}

}  // namespace stairway::detect
