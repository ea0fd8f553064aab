// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/source.hpp"

#include <fmt/format.h>

#include <exception>

#include "ipc/cloud_file.hpp"
#include "tools/common/stage_timer.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::tools {
namespace {

constexpr std::string_view kSimulated = "sim:";

tl::unexpected<SourceError> refusal(std::string text) { return tl::unexpected(SourceError{std::move(text)}); }

tl::expected<Source, SourceError> simulate(const std::string& name, const config::Settings& settings) {
  StageTimer timer;
  auto scene = open_scene(name);
  if (!scene) return tl::unexpected(scene.error());
  const sim::SweepOptions sweep{.disk_period_s = settings.disk.period_s};
  Source source{.name = name, .truth = std::move(scene->truths)};
  source.cloud = simulate_sweep(*scene, scene->mount.value_or(settings.mount), {}, sweep,
                                static_cast<std::uint64_t>(settings.simulate.seed));
  timer.stop();
  source.timings = {{"simulate", timer.total_ms()}};
  return source;
}

tl::expected<Source, SourceError> read(const std::string& name) {
  StageTimer timer;
  auto loaded = ipc::read_cloud_file(name);
  if (!loaded) return refusal(std::move(loaded.error().text));
  timer.stop();
  return Source{.name = name,
                .cloud = std::move(loaded->cloud),
                .dropped_points = loaded->dropped_points,
                .timings = {{"read", timer.total_ms()}},
                .truth = {}};
}

}  // namespace

tl::expected<Source, SourceError> open_source(const std::string& name, const config::Settings& settings) {
  if (name.starts_with(kSimulated)) return simulate(name, settings);
  return read(name);
}

tl::expected<sim::Scene, SourceError> open_scene(const std::string& name) {
  const std::string scene = name.starts_with(kSimulated) ? name.substr(kSimulated.size()) : name;
  try {
    return sim::build_scene(sim::load_scene(scene));
  } catch (const std::exception& error) {
    return refusal(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace stairway::tools
