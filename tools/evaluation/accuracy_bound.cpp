// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/accuracy_bound.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/sim/bvh.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::evaluation {
namespace {

using Eigen::Vector3d;

enum Parameter { kHeight, kDepth, kHeading, kAlong, kUp, kRightEnd, kLeftEnd, kOverhang, kThickness, kParameters };
using Gradient = Eigen::Matrix<double, kParameters, 1>;

constexpr double kOnFace_m = 2e-3;
constexpr double kJump_m = 0.05;       // beams that leave an edge go at least this much farther
constexpr double kUnobserved_m = 0.3;  // a sigma beyond this says nothing
constexpr double kMaxRange_m = 30.0;

enum class Face { None, Tread, Underside, Riser, Lip };

/// Where a beam ended; places in the axes of the lowest nosing: u along the ascent, v to the left, z up.
struct Echo {
  Vector3d from = Vector3d::Zero();
  Vector3d direction = Vector3d::UnitX();
  Vector3d at = Vector3d::Zero();
  double range_m = 0.0;
  std::uint32_t surface = sim::kNoSurface;
  Face face = Face::None;
  int step = 0;
};

class FlightInformation {
 public:
  FlightInformation(const sim::Scene& scene, std::size_t flight, const BoundOptions& options)
      : options_(options), spec_(scene.stairs[flight]), bvh_(scene.mesh) {
    const detect::Nosing& lowest = scene.truths[flight].nosings.front();
    const Vector3d left = (lowest.left - lowest.right).normalized();
    axes_.row(0) = left.cross(Vector3d::UnitZ());
    axes_.row(1) = left;
    axes_.row(2) = Vector3d::UnitZ();
    origin_ = lowest.middle();
    // Weak knowledge of everything keeps what no beam measures solvable and recognisable.
    information_.setIdentity();
    if (spec_.overhang_m == 0.0) information_(kOverhang, kOverhang) = 1e12;  // there is none to be found
  }

  void add_turn(const scan::Calibration& calibration, double start_rad, double end_rad, double weight) {
    Echo before;
    for (int beam = 0; beam < sim::kBeams; ++beam) {
      const double share = static_cast<double>(beam + sim::kStepsBeforeFirstBeam) / sim::kStepsPerTurn;
      const Eigen::Isometry3d T = calibration.T_base_lidar(start_rad + (end_rad - start_rad) * share);
      const double angle = 2 * std::numbers::pi * (beam - sim::kFrontBeam) / sim::kStepsPerTurn;
      const Echo echo = cast(T, angle);
      if (echo.face != Face::None && is_clean(T, angle, echo.surface)) add_point(echo, weight);
      if (beam > 0) {
        add_edges(before, echo, weight);
        add_edges(echo, before, weight);
      }
      before = echo;
    }
  }

  std::optional<AccuracyBound> bound() const {
    const Eigen::Matrix<double, kParameters, kParameters> covariance = information_.inverse();
    const auto sigma = [&](const Gradient& of) { return std::sqrt(of.dot(covariance * of)); };
    const auto sigma_of = [&](Parameter p) { return sigma(Gradient::Unit(p)); };
    const AccuracyBound bound{
        .height_m = sigma_of(kHeight),
        .depth_m = sigma_of(kDepth),
        .heading_rad = sigma_of(kHeading),
        .width_m = sigma(Gradient::Unit(kLeftEnd) - Gradient::Unit(kRightEnd)),
        .along_m = sigma_of(kAlong),
        .across_m = sigma(0.5 * (Gradient::Unit(kLeftEnd) + Gradient::Unit(kRightEnd))),
        .up_m = sigma_of(kUp),
    };
    for (const double sigma_m : {bound.height_m, bound.depth_m, bound.width_m, bound.along_m})
      if (!(sigma_m < kUnobserved_m)) return std::nullopt;
    return bound;
  }

 private:
  Echo cast(const Eigen::Isometry3d& T, double angle) const {
    Echo echo;
    const Vector3d direction = T.linear() * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const sim::Hit hit =
        bvh_.cast(T.translation().cast<float>(), direction.cast<float>(), static_cast<float>(kMaxRange_m));
    echo.range_m = std::min(static_cast<double>(hit.range_m), kMaxRange_m);
    echo.surface = hit.surface;
    echo.from = axes_ * (T.translation() - origin_);
    echo.direction = axes_ * direction;
    echo.at = echo.from + echo.range_m * echo.direction;
    if (hit.surface != sim::kNoSurface) classify(echo);
    return echo;
  }

  void classify(Echo& echo) const {
    const double u = echo.at.x();
    const double z = echo.at.z();
    if (std::abs(echo.at.y()) > 0.5 * spec_.width_m + kOnFace_m) return;
    const auto is = [](double value, double place) { return std::abs(value - place) < kOnFace_m; };
    for (int j = 0; j < spec_.steps; ++j) {
      const double nosing_u = j * spec_.depth_m;
      const double nosing_z = j * spec_.height_m;
      const bool is_over_tread = u > nosing_u - kOnFace_m && u < nosing_u + spec_.depth_m + spec_.overhang_m;
      const bool is_before_front = z < nosing_z + kOnFace_m && z > nosing_z - spec_.height_m - kOnFace_m;
      echo.step = j;
      if (is_over_tread && is(z, nosing_z)) return void(echo.face = Face::Tread);
      if (is_over_tread && spec_.open_risers && is(z, nosing_z - spec_.tread_thickness_m))
        return void(echo.face = Face::Underside);
      const bool is_lip = spec_.open_risers || spec_.overhang_m > 0.0;
      if (is_lip && is_before_front && is(u, nosing_u)) return void(echo.face = Face::Lip);
      if (!spec_.open_risers && is_before_front && is(u, nosing_u + spec_.overhang_m))
        return void(echo.face = Face::Riser);
    }
  }

  // Whether the rim of the spot lies where its middle does.
  bool is_clean(const Eigen::Isometry3d& T, double angle, std::uint32_t surface) const {
    const double r = 0.5 * options_.spot_rad;
    if (r == 0.0) return true;
    for (const auto& [side, up] : {std::pair{r, 0.0}, {-r, 0.0}, {0.0, r}, {0.0, -r}}) {
      const Vector3d direction = T.linear() * Vector3d(std::cos(angle + side), std::sin(angle + side), up).normalized();
      const sim::Hit hit = bvh_.cast(T.translation().cast<float>(), direction.cast<float>(), 31.0F);
      if (hit.surface != surface) return false;
    }
    return true;
  }

  void add(const Gradient& gradient, double variance, double weight) {
    information_ += weight / variance * gradient * gradient.transpose();
  }

  void add_point(const Echo& echo, double weight) {
    Gradient g = Gradient::Zero();
    Vector3d normal = Vector3d::UnitZ();
    if (echo.face == Face::Tread || echo.face == Face::Underside) {
      g[kHeight] = echo.step;
      g[kUp] = 1.0;
      if (echo.face == Face::Underside) g[kThickness] = -1.0;
    } else {
      normal = Vector3d::UnitX();
      g[kDepth] = echo.step;
      g[kAlong] = 1.0;
      g[kHeading] = -echo.at.y();
      if (echo.face == Face::Riser) g[kOverhang] = 1.0;
    }
    const double across = std::pow(normal.dot(echo.direction), 2);
    add(g,
        across * std::pow(options_.range_sigma_m, 2) +
            (1.0 - across) * std::pow(echo.range_m * options_.angle_sigma_rad, 2),
        weight);
  }

  // `on` ends on a step, `off` passes its edge.
  void add_edges(const Echo& on, const Echo& off, double weight) {
    if (on.face == Face::None || off.range_m < on.range_m + kJump_m) return;
    if (on.face == Face::Underside) return;
    add_nosing(on, off, weight);
    add_end(on, off, weight);
  }

  double edge_variance(double gap_m, double range_m) const {
    return gap_m * gap_m / 12.0 + std::pow(range_m * options_.edge_sigma_rad, 2);
  }

  /// Where a line of sight passes the nosing of a step: v there, and how high over it, across the line in the u-z
  /// plane.
  struct Passage {
    double v = 0.0;
    double over_m = 0.0;
    double range_m = 0.0;
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  };
  Passage pass(const Echo& echo, const Vector3d& nosing) const {
    const Eigen::Vector2d way(echo.direction.x(), echo.direction.z());
    const Eigen::Vector2d to(nosing.x() - echo.from.x(), nosing.z() - echo.from.z());
    const Eigen::Vector2d along = way.normalized();
    const double range = to.dot(along) / way.norm();
    return {.v = echo.from.y() + range * echo.direction.y(),
            .over_m = along.y() * to.x() - along.x() * to.y(),
            .range_m = range,
            .along = along};
  }

  void add_nosing(const Echo& on, const Echo& off, double weight) {
    if (on.face == Face::Riser && spec_.overhang_m > 0.0) return;  // its top is hidden below the nosing
    const Vector3d nosing(on.step * spec_.depth_m, 0.0, on.step * spec_.height_m);
    const Passage a = pass(on, nosing);
    const Passage b = pass(off, nosing);
    if (a.over_m * b.over_m >= 0.0 || std::abs(a.v) > 0.5 * spec_.width_m || off.range_m < b.range_m) return;
    Gradient g = Gradient::Zero();
    g[kHeight] = a.along.x() * on.step;
    g[kUp] = a.along.x();
    g[kDepth] = -a.along.y() * on.step;
    g[kAlong] = -a.along.y();
    g[kHeading] = a.along.y() * a.v;
    add(g, edge_variance(b.over_m - a.over_m, a.range_m), weight);
  }

  void add_end(const Echo& on, const Echo& off, double weight) {
    // Both cross the face, one inside and one beyond its end.
    const bool is_front = on.face != Face::Tread;
    const int axis = is_front ? 0 : 2;
    const double share = (on.at[axis] - off.from[axis]) / off.direction[axis];
    if (!(share > 0.0) || share > off.range_m) return;
    const Vector3d beyond = off.from + share * off.direction;
    const double side = beyond.y() > 0.0 ? 1.0 : -1.0;
    if (side * beyond.y() < 0.5 * spec_.width_m || (beyond - on.at).norm() > 0.3) return;
    if (is_front ? beyond.z() > on.step * spec_.height_m : beyond.x() < on.step * spec_.depth_m) return;
    Gradient g = Gradient::Zero();
    g[side > 0.0 ? kLeftEnd : kRightEnd] = 1.0;
    g[kHeading] = beyond.x();
    const double gap = beyond.y() - on.at.y();
    add(g, edge_variance(gap, share), weight);
  }

  const BoundOptions options_;
  const sim::StairSpec spec_;
  sim::Bvh bvh_;
  Eigen::Matrix3d axes_;
  Vector3d origin_;
  Eigen::Matrix<double, kParameters, kParameters> information_;
};

}  // namespace

std::optional<AccuracyBound> accuracy_bound(const sim::Scene& scene, const scan::MountOptions& mount,
                                            const BoundOptions& options, std::size_t flight) {
  const sim::StairSpec& spec = scene.stairs[flight];
  if (spec.turn_per_step_rad != 0.0 || !spec.height_offsets_m.empty() || !spec.depth_offsets_m.empty())
    return std::nullopt;
  FlightInformation information(scene, flight, options);
  const scan::Calibration calibration = scan::make_calibration(mount);
  const int turns = static_cast<int>(std::lround(options.disk_period_s / sim::kTurnPeriod_s));
  const double turn_rad = 2 * std::numbers::pi / turns;
  for (int turn = 0; turn < turns; turn += options.stride)
    information.add_turn(calibration, turn * turn_rad, (turn + 1) * turn_rad, options.stride);
  return information.bound();
}

}  // namespace stairway::evaluation
