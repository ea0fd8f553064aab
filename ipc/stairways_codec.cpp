// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <stairway/nosing_t.hpp>
#include <stairway/rejection_t.hpp>
#include <stairway/stairway_t.hpp>
#include <stairway/stairways_t.hpp>
#include <stairway/step_t.hpp>

#include "ipc/message_codec.hpp"
#include "ipc/message_walker.hpp"
#include "ipc/wire_message.hpp"

namespace stairway::ipc {
namespace {

using wire::enumerator;
using wire::from_bytes;
using wire::kFingerprint;
using wire::kWord;
using wire::to_bytes;

static_assert(stairway_t::SPIRAL == static_cast<int>(detect::StairwayKind::Spiral));
static_assert(stairway_t::DESCENDING == static_cast<int>(detect::StairwayDirection::Descending));
static_assert(stairway_t::MIDDLE == static_cast<int>(detect::AnchorSide::Middle));
static_assert(stairway_t::RIGHT == static_cast<int>(detect::AnchorSide::Right));

void walk_stairway(MessageWalker& walker) {
  walker.skip(2 * kWord + 2 + 13 * kWord + 3);
  const std::size_t nosings = walker.count();
  walker.skip(nosings * 6 * kWord + 1);
  const std::size_t steps = walker.count();
  walker.skip(steps * 4 * kWord + kWord);
}

void walk_rejection(MessageWalker& walker) {
  walker.text().text();
  const std::size_t figures = walker.count();
  walker.texts(figures).skip(figures * kWord);
}

bool is_stairways(std::span<const std::uint8_t> bytes) {
  MessageWalker walker(bytes);
  walker.skip(kFingerprint + 3 * kWord + 1);
  const std::size_t stairways = walker.count();
  for (std::size_t i = 0; i < stairways && walker.fits(); ++i) walk_stairway(walker);
  const std::size_t rejected = walker.count();
  for (std::size_t i = 0; i < rejected && walker.fits(); ++i) walk_rejection(walker);
  return walker.ends_here();
}

stairway_t to_wire(const detect::Stairway& stairway, std::int64_t utime_us, std::int64_t track_id) {
  stairway_t wire{};
  wire.utime = utime_us;
  wire.track_id = track_id;
  wire.kind = static_cast<std::int8_t>(stairway.kind);
  wire.direction = static_cast<std::int8_t>(stairway.direction);
  wire.step_height_m = stairway.step_height;
  wire.step_depth_m = stairway.step_depth;
  wire.width_m = stairway.width;
  wire.pitch_rad = stairway.pitch();
  wire.heading_rad = stairway.heading;
  wire.turn_per_step_rad = stairway.turn_per_step;
  wire.step_height_sigma_m = stairway.step_height_sigma;
  wire.step_depth_sigma_m = stairway.step_depth_sigma;
  wire.width_sigma_m = stairway.width_sigma;
  wire.heading_sigma_rad = stairway.heading_sigma;
  std::copy_n(stairway.anchor.data(), 3, wire.anchor_m);
  wire.anchor_side = static_cast<std::int8_t>(stairway.anchor_side);
  wire.railing_left = stairway.railing_left;
  wire.railing_right = stairway.railing_right;
  wire.num_nosings = static_cast<std::int32_t>(stairway.nosings.size());
  for (const detect::Nosing& nosing : stairway.nosings) {
    nosing_t& edge = wire.nosings.emplace_back();
    std::copy_n(nosing.left.data(), 3, edge.left_m);
    std::copy_n(nosing.right.data(), 3, edge.right_m);
  }
  wire.is_irregular = stairway.is_irregular;
  wire.num_steps = static_cast<std::int32_t>(stairway.step_sizes.size());
  for (const detect::StepSize& size : stairway.step_sizes) {
    step_t& step = wire.steps.emplace_back();
    step.height_m = size.height;
    step.depth_m = size.depth;
    step.height_sigma_m = size.height_sigma;
    step.depth_sigma_m = size.depth_sigma;
  }
  wire.score = stairway.score;
  return wire;
}

std::optional<detect::Stairway> from_wire(const stairway_t& wire) {
  const auto kind = enumerator(wire.kind, detect::StairwayKind::Spiral);
  const auto direction = enumerator(wire.direction, detect::StairwayDirection::Descending);
  const auto anchor_side = enumerator(wire.anchor_side, detect::AnchorSide::Right);
  if (!kind || !direction || !anchor_side) return std::nullopt;
  detect::Stairway stairway;
  stairway.kind = *kind;
  stairway.direction = *direction;
  stairway.step_height = wire.step_height_m;
  stairway.step_depth = wire.step_depth_m;
  stairway.width = wire.width_m;
  stairway.heading = wire.heading_rad;
  stairway.turn_per_step = wire.turn_per_step_rad;
  stairway.step_height_sigma = wire.step_height_sigma_m;
  stairway.step_depth_sigma = wire.step_depth_sigma_m;
  stairway.width_sigma = wire.width_sigma_m;
  stairway.heading_sigma = wire.heading_sigma_rad;
  stairway.anchor = Eigen::Vector3d(wire.anchor_m);
  stairway.anchor_side = *anchor_side;
  stairway.railing_left = wire.railing_left != 0;
  stairway.railing_right = wire.railing_right != 0;
  for (const nosing_t& nosing : wire.nosings) {
    stairway.nosings.push_back({Eigen::Vector3d(nosing.left_m), Eigen::Vector3d(nosing.right_m)});
  }
  stairway.is_irregular = wire.is_irregular != 0;
  for (const step_t& step : wire.steps)
    stairway.step_sizes.push_back({.height = step.height_m,
                                   .height_sigma = step.height_sigma_m,
                                   .depth = step.depth_m,
                                   .depth_sigma = step.depth_sigma_m});
  stairway.score = wire.score;
  return stairway;
}

rejection_t to_wire(const detect::Rejection& rejection) {
  rejection_t wire{};
  wire.reason = rejection.reason;
  wire.detail = rejection.detail;
  wire.num_figures = static_cast<std::int32_t>(rejection.figures.size());
  for (const auto& [name, value] : rejection.figures) {
    wire.figure_names.push_back(name);
    wire.figure_values.push_back(value);
  }
  return wire;
}

detect::Rejection from_wire(const rejection_t& wire) {
  detect::Rejection rejection{wire.reason, wire.detail, {}};
  for (std::size_t i = 0; i < wire.figure_names.size(); ++i) {
    rejection.figures.emplace_back(wire.figure_names[i], wire.figure_values[i]);
  }
  return rejection;
}

}  // namespace

Bytes encode(const StairwaysMessage& message) {
  stairways_t wire{};
  wire.utime = message.utime_us;
  wire.sweep_start_utime = message.sweep_start_utime_us;
  wire.sweep = message.sweep;
  wire.is_final = message.is_final;
  const auto& stairways = message.detection.stairways;
  wire.num_stairways = static_cast<std::int32_t>(stairways.size());
  for (std::size_t i = 0; i < stairways.size(); ++i) {
    const std::int64_t track_id = i < message.track_ids.size() ? message.track_ids[i] : 0;
    const auto& seen_us = message.seen_utimes_us;
    wire.stairways.push_back(to_wire(stairways[i], i < seen_us.size() ? seen_us[i] : message.utime_us, track_id));
  }
  wire.num_rejected = static_cast<std::int32_t>(message.detection.rejected.size());
  for (const detect::Rejection& rejection : message.detection.rejected) wire.rejected.push_back(to_wire(rejection));
  return to_bytes(wire);
}

template <>
tl::expected<StairwaysMessage, MessageFault> decode<StairwaysMessage>(std::span<const std::uint8_t> bytes) {
  const auto wire = from_bytes<stairways_t>(bytes, is_stairways);
  if (!wire) return tl::unexpected(wire.error());
  StairwaysMessage message;
  message.utime_us = wire->utime;
  message.sweep_start_utime_us = wire->sweep_start_utime;
  message.sweep = wire->sweep;
  message.is_final = wire->is_final != 0;
  for (const stairway_t& entry : wire->stairways) {
    auto stairway = from_wire(entry);
    if (!stairway) return tl::unexpected(MessageFault::ImpossibleValue);
    message.detection.stairways.push_back(std::move(*stairway));
    message.track_ids.push_back(entry.track_id);
    message.seen_utimes_us.push_back(entry.utime);
  }
  for (const rejection_t& entry : wire->rejected) message.detection.rejected.push_back(from_wire(entry));
  return message;
}

}  // namespace stairway::ipc
