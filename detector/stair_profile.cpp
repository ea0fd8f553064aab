// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stairway::detect {
namespace {

using Kind = VisibleFace::Kind;

/// A face from `low` to `high` along its axis, relative to the sensor.
struct Segment {
  Kind kind = Kind::Upright;
  bool is_upright = true;
  double place_m = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
  int step = 0;
};

class ProfileSegments {
 public:
  ProfileSegments(const StairProfileShape& shape, const Eigen::Vector2d& sensor) : shape_(shape), sensor_(sensor) {
    for (std::size_t i = 0; i < shape.nosings.size(); ++i) {
      if (shape.open_risers) {
        add_board(i);
      } else {
        add_closed_step(i);
      }
    }
  }

  const std::vector<Segment>& segments() const { return segments_; }

 private:
  void add_upright(std::size_t step, double u, double low_z, double high_z, Kind kind = Kind::Upright) {
    if (high_z > low_z)
      segments_.push_back(
          {kind, true, u - sensor_.x(), low_z - sensor_.y(), high_z - sensor_.y(), static_cast<int>(step)});
  }
  void add_level(std::size_t step, double z, double low_u, double high_u, Kind kind = Kind::Level) {
    if (high_u > low_u)
      segments_.push_back(
          {kind, false, z - sensor_.y(), low_u - sensor_.x(), high_u - sensor_.x(), static_cast<int>(step)});
  }

  bool is_last(std::size_t i) const { return i + 1 == shape_.nosings.size(); }
  double tread_end_u(std::size_t i) const {
    return is_last(i) ? shape_.nosings[i].x() + shape_.last_tread_m : shape_.nosings[i + 1].x() + shape_.overhang_m;
  }

  void add_closed_step(std::size_t i) {
    const Eigen::Vector2d& nosing = shape_.nosings[i];
    const double foot = i == 0 ? nosing.y() - shape_.step_height_m : shape_.nosings[i - 1].y();
    const double lip = std::max(nosing.y() - shape_.thickness_m, foot);
    add_level(i, nosing.y(), nosing.x(), tread_end_u(i));
    add_upright(i, nosing.x(), lip, nosing.y());
    add_level(i, lip, nosing.x(), nosing.x() + shape_.overhang_m);
    add_upright(i, nosing.x() + shape_.overhang_m, foot, lip);
    if (i == 0) add_upright(i, nosing.x() + shape_.overhang_m, foot - kDeep_m, foot, Kind::Unknown);
  }

  // How far a board reaches back and how thick the landing is nobody knows.
  void add_board(std::size_t i) {
    constexpr double kCertain = 0.8;  // share of a board that is there
    constexpr double kReach_m = 0.06;
    const Eigen::Vector2d& nosing = shape_.nosings[i];
    const double bottom = nosing.y() - shape_.thickness_m;
    if (is_last(i)) {
      add_level(i, nosing.y(), nosing.x(), nosing.x() + shape_.last_tread_m);
      add_upright(i, nosing.x(), 0.5 * (bottom + nosing.y()), nosing.y());
      add_upright(i, nosing.x(), nosing.y() - kLandingSlab_m, 0.5 * (bottom + nosing.y()), Kind::Unknown);
      return;
    }
    const double next = shape_.nosings[i + 1].x();
    const double certain = nosing.x() + kCertain * (next - nosing.x());
    add_upright(i, nosing.x(), bottom, nosing.y());
    for (const double z : {bottom, nosing.y()}) {
      add_level(i, z, nosing.x(), certain);
      add_level(i, z, certain, next + kReach_m, Kind::Unknown);
    }
    add_upright(i, next + kReach_m, bottom, nosing.y(), Kind::Unknown);
  }

  static constexpr double kDeep_m = 10.0;
  static constexpr double kLandingSlab_m = 0.3;

  const StairProfileShape& shape_;
  const Eigen::Vector2d& sensor_;
  std::vector<Segment> segments_;
};

// The distance at which a ray meets a segment; infinite when it does not.
double hit_m(const Segment& segment, double cosine, double sine) {
  const double into = segment.is_upright ? cosine : sine;
  const double along = segment.is_upright ? sine : cosine;
  const double distance = segment.place_m / into;
  if (!(distance > 0.0) || !std::isfinite(distance)) return std::numeric_limits<double>::infinity();
  const double place = distance * along;
  return place >= segment.low_m && place <= segment.high_m ? distance : std::numeric_limits<double>::infinity();
}

std::vector<double> corner_elevations(const std::vector<Segment>& segments) {
  std::vector<double> corners{-std::numbers::pi, std::numbers::pi};
  for (const Segment& s : segments) {
    for (const double end : {s.low_m, s.high_m})
      corners.push_back(s.is_upright ? std::atan2(end, s.place_m) : std::atan2(s.place_m, end));
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

Elevation Elevation::near_by(double at_rad) const {
  constexpr double kNear_rad = 0.1;
  const double turn = at_rad - rad;
  if (!(std::abs(turn) < kNear_rad)) return {at_rad};
  const double squared = turn * turn;
  const double turn_cosine = 1.0 - squared * (1.0 / 2.0 - squared / 24.0);
  const double turn_sine = turn * (1.0 - squared * (1.0 / 6.0 - squared / 120.0));
  Elevation result = *this;
  result.rad = at_rad;
  result.cosine = cosine * turn_cosine - sine * turn_sine;
  result.sine = sine * turn_cosine + cosine * turn_sine;
  return result;
}

double VisibleFace::distance_m(const Elevation& at) const {
  return place_m / (kind == Kind::Upright ? at.cosine : at.sine);
}

std::vector<VisibleFace> visible_faces(const StairProfileShape& shape, const Eigen::Vector2d& sensor) {
  constexpr double kNarrowest_rad = 1e-9;
  const ProfileSegments profile(shape, sensor);
  const std::vector<double> corners = corner_elevations(profile.segments());
  std::vector<VisibleFace> faces;
  int edge = -1;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i] - corners[i - 1] < kNarrowest_rad) continue;
    const double middle = 0.5 * (corners[i - 1] + corners[i]);
    const double cosine = std::cos(middle);
    const double sine = std::sin(middle);
    const Segment* nearest = nullptr;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Segment& segment : profile.segments()) {
      if (const double distance = hit_m(segment, cosine, sine); distance < nearest_m) {
        nearest_m = distance;
        nearest = &segment;
      }
    }
    VisibleFace face{.begin_rad = corners[i - 1], .end_rad = corners[i], .step = edge};
    if (nearest) {
      face.kind = nearest->kind;
      face.place_m = nearest->place_m;
      face.step = edge = nearest->step;
    } else if (edge < 0 && shape.goes_on_below) {
      face.kind = Kind::Unknown;
    }
    const bool goes_on = !faces.empty() && faces.back().kind == face.kind && faces.back().step == face.step &&
                         faces.back().place_m == face.place_m;
    if (goes_on) {
      faces.back().end_rad = face.end_rad;
    } else {
      faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace stairway::detect
