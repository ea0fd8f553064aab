// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/depth_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "config/load_settings.hpp"
#include "tools/evaluation/depth_frame.hpp"
#include "tools/evaluation/error_quantity.hpp"
#include "tools/evaluation/parallel_runs.hpp"

namespace stairway::evaluation {
namespace {

constexpr int kStairImages = 89;
constexpr int kOtherImages = 58;
constexpr std::size_t kStepPositions = 10;
constexpr std::size_t kPaperAscending = 5;  // steps that the paper says were always found; its curves are pictures only
constexpr std::size_t kPaperDescending = 4;

constexpr std::array kDirections{std::pair{FrameLabel::Ascending, "ascending"},
                                 std::pair{FrameLabel::Descending, "descending"}};

config::Settings usable_settings(const config::Settings& settings) {
  if (settings.profile != config::Settings{}.profile) return settings;
  const auto loaded = config::load_settings({.files = {}, .assignments = {"profile=depth-camera"}});
  if (!loaded) throw std::runtime_error(loaded.error().text);
  config::Settings result = loaded->settings;
  result.input = settings.input;
  return result;
}

std::vector<DepthFrame> frames_of(const Request& request) {
  const config::Settings settings = usable_settings(request.settings);
  const auto in_parallel = [&](std::size_t count, const auto& run) {
    return run_in_parallel(count, run, [&](std::size_t done) {
      if (request.progress) request.progress(static_cast<double>(done) / static_cast<double>(count), "next frame");
    });
  };
  if (!request.data.empty()) {
    const std::vector<LabelledFrame> labelled = read_labels(request.data);
    return in_parallel(labelled.size(), [&](std::size_t i) { return recorded_depth_frame(labelled[i], settings); });
  }
  const auto stairs = static_cast<std::size_t>(shared_count(kStairImages, request.share));
  const auto others = static_cast<std::size_t>(shared_count(kOtherImages, request.share));
  return in_parallel(stairs + others, [&](std::size_t i) {
    const auto subject = i >= stairs  ? sim::HelmetSubject::Nothing
                         : i % 2 == 0 ? sim::HelmetSubject::Ascending
                                      : sim::HelmetSubject::Descending;
    return simulated_depth_frame(subject, request.seed + i, settings.detector);
  });
}

Cell percentage(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::monostate{};
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

template <typename Predicate>
std::size_t count(const std::vector<DepthFrame>& frames, const Predicate& predicate) {
  return static_cast<std::size_t>(std::count_if(frames.begin(), frames.end(), predicate));
}

std::vector<Cell> rates_row(const std::string& what, const std::vector<DepthFrame>& frames) {
  const auto has_stairs = [](const DepthFrame& f) { return f.label != FrameLabel::None; };
  const std::size_t stairs = count(frames, has_stairs);
  const std::size_t found = count(frames, [](const DepthFrame& f) { return f.is_found; });
  const std::size_t clean = count(frames, [&](const DepthFrame& f) { return !has_stairs(f) && f.others == 0; });
  const std::size_t extra = count(frames, [&](const DepthFrame& f) { return has_stairs(f) && f.others > 0; });
  return {what,
          static_cast<double>(stairs),
          static_cast<double>(frames.size() - stairs),
          percentage(found, stairs),
          percentage(clean, frames.size() - stairs),
          static_cast<double>(extra)};
}

Table rates_table(const std::vector<DepthFrame>& frames, bool is_simulated) {
  Table table{"depth-camera-rates",
              "Frames with stairs found (TPR) and frames without stairs left alone (TNR)",
              {{"method", "", 0},
               {"with_stairs", "", 0},
               {"without", "", 0},
               {"tpr", "%", 2},
               {"tnr", "%", 2},
               {"with_false_ones_beside", "", 0}},
              {}};
  const std::string data = is_simulated ? "simulated" : "recorded";
  table.rows.push_back(rates_row("this, " + data, frames));
  for (const auto& [label, name] : kDirections) {
    std::vector<DepthFrame> some;
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(some),
                 [l = label](const DepthFrame& f) { return f.label == l; });
    if (!some.empty()) table.rows.push_back(rates_row(std::string("  of these, ") + name, some));
  }
  const std::monostate none;
  const double stairs = kStairImages;
  const double others = kOtherImages;
  table.rows.push_back({"paper, Monash set", stairs, others, 100.0, 100.0, none});
  table.rows.push_back({"Perez-Yus 2014, Monash set", stairs, others, 100.0, 100.0, none});
  table.rows.push_back({"Vlaminck 2013, Monash set", stairs, others, 100.0, 96.55, none});
  table.rows.push_back({"Tang 2012, its own split", none, none, 94.93, 98.98, none});
  return table;
}

// Of the frames that show step `position`, how many detections have it.
struct StepRate {
  std::size_t shown = 0, found = 0;
};

StepRate step_rate(const std::vector<DepthFrame>& frames, FrameLabel label, std::size_t position) {
  StepRate rate;
  for (const DepthFrame& frame : frames) {
    if (frame.label != label || position >= frame.in_view.size() || !frame.in_view[position]) continue;
    ++rate.shown;
    rate.found += frame.is_step_found[position] ? 1 : 0;
  }
  return rate;
}

void add_steps(const std::vector<DepthFrame>& frames, Result& result) {
  Table table{"depth-camera-steps",
              "Steps found, by their position from the sensor (Fig 22)",
              {{"step", "", 0},
               {"shown_ascending", "", 0},
               {"found_ascending", "%", 1},
               {"paper_ascending", "%", 1},
               {"shown_descending", "", 0},
               {"found_descending", "%", 1},
               {"paper_descending", "%", 1}},
              {}};
  Chart chart{
      .name = "depth-camera-steps",
      .title = "Detection rate by step position",
      .x_label = "step, counted from the sensor",
      .y_label = "found [%]",
      .curves = {
          {.name = kDirections[0].second},
          {.name = kDirections[1].second},
          {.name = "paper, ascending", .x = {1, 2, 3, 4, 5}, .y = {100, 100, 100, 100, 100}, .from_paper = true}}};
  for (std::size_t position = 0; position < kStepPositions; ++position) {
    std::vector<Cell> row{static_cast<double>(position + 1)};
    for (std::size_t i = 0; i < kDirections.size(); ++i) {
      const FrameLabel label = kDirections[i].first;
      const StepRate rate = step_rate(frames, label, position);
      const Cell share = percentage(rate.found, rate.shown);
      const bool does_paper_tell = position < (label == FrameLabel::Ascending ? kPaperAscending : kPaperDescending);
      row.insert(row.end(), {static_cast<double>(rate.shown), share, does_paper_tell ? Cell{100.0} : Cell{}});
      if (rate.shown > 0) chart.curves[i].add(static_cast<double>(position + 1), std::get<double>(share));
    }
    table.rows.push_back(std::move(row));
  }
  result.tables.push_back(std::move(table));
  result.charts.push_back(std::move(chart));
}

// The deviation is that of all values, not of a sample as in spread_of().
Spread spread(const std::vector<double>& values) {
  Spread result;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  for (const double value : values) result.deviation += (value - result.mean) * (value - result.mean) / n;
  result.deviation = std::sqrt(result.deviation);
  return result;
}

Table errors_table(const std::vector<DepthFrame>& frames) {
  Table table{"depth-camera-errors",
              "Absolute errors of the stairways found, mean and standard deviation",
              {{"direction", "", 0},
               {"found", "", 0},
               {"height", "mm", 1},
               {"height_sd", "mm", 1},
               {"depth", "mm", 1},
               {"depth_sd", "mm", 1},
               {"heading", "deg", 2},
               {"heading_sd", "deg", 2}},
              {}};
  for (const auto& [label, name] : kDirections) {
    std::vector<double> height, depth, heading;
    for (const DepthFrame& frame : frames) {
      if (frame.label != label || !frame.is_found) continue;
      height.push_back(kMillimetres * std::abs(*frame.height_error_m));
      depth.push_back(kMillimetres * std::abs(*frame.depth_error_m));
      heading.push_back(kDegrees * std::abs(*frame.heading_error_rad));
    }
    std::vector<Cell> row{std::string(name), static_cast<double>(height.size())};
    for (const auto* values : {&height, &depth, &heading}) {
      if (values->empty()) {
        row.insert(row.end(), {std::monostate{}, std::monostate{}});
        continue;
      }
      const Spread s = spread(*values);
      row.insert(row.end(), {s.mean, s.deviation});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> simulation_notes() {
  return {
      "Simulated frames in the manner of the Monash set, which is not at hand: Kinect v1, 640 x 480 pixels, 0.5 to "
      "4.5 m, noise of 1.2 mm + 1.9 mm (z - 0.4 m)^2 after Nguyen 2012, disparities of 1/8 pixel, missing pixels at "
      "edges and where surfaces are seen flat; gravity known to 1 degree, which alone turns a step height by 5 mm.",
      "Every frame with stairs shows the middles of four nosings within 4.2 m. A step counts as shown where its "
      "nosing's middle lies in the frame, hidden or not.",
      "The paper's curve in the chart is what its text says: the first five steps going up always, and the first four "
      "in either direction."};
}

}  // namespace

Result run_depth_camera(const Request& request) {
  const std::vector<DepthFrame> frames = frames_of(request);
  const bool is_simulated = request.data.empty();
  Result result;
  result.tables.push_back(rates_table(frames, is_simulated));
  if (!is_simulated) {
    result.notes = {"Recorded frames: any stairway on a frame with stairs counts as theirs, for labels tell no more."};
    return result;
  }
  add_steps(frames, result);
  result.tables.push_back(errors_table(frames));
  result.notes = simulation_notes();
  return result;
}

}  // namespace stairway::evaluation
