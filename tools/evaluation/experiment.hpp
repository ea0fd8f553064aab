// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/settings.hpp"

namespace stairway::evaluation {

/// A column of a table: reals are shown with `digits` behind the point.
struct Column {
  std::string name;  ///< machine-readable, e.g. "step_height"; for a person "_" becomes a blank
  std::string unit;  ///< "" for plain numbers and names
  int digits = 2;
};

/// Empty where there is nothing to tell: a figure the paper does not state, a mean over nothing.
using Cell = std::variant<std::monostate, double, std::string>;

struct Table {
  std::string name;   ///< machine-readable, unique in its result, e.g. "series-I"
  std::string title;  ///< for a person
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// One line of points, or one colour of bars.
struct Curve {
  std::string name;
  std::vector<double> x;       ///< for bars: the index of the category
  std::vector<double> y;       ///< not finite where nothing is known; a line is interrupted there
  std::vector<double> spread;  ///< half the height of an error bar at each point; may be empty
  bool from_paper = false;     ///< drawn apart from what was measured here

  /// A further point. All points of a curve have an error bar, or none has.
  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
  void add(double at, double value, double half_bar) {
    add(at, value);
    spread.push_back(half_bar);
  }
};

struct Chart {
  std::string name;  ///< stem of its file, e.g. "series-height-error"
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> categories;  ///< bars when not empty, else points joined by lines
  std::vector<Curve> curves;
  bool logarithmic = false;  ///< both axes; of bars, the vertical one. Values of 0 and below are left out
};

struct Result {
  std::vector<Table> tables;
  std::vector<Chart> charts;
  std::vector<std::string> notes;  ///< what a reader must know to read the figures
};

/// How an experiment is to be run.
struct Request {
  config::Settings settings;    ///< detector, mount; the simulated noise is that of sim::ScannerOptions
  std::uint64_t seed = 1;       ///< the same seed gives the same figures, times apart
  double share = 1.0;           ///< of the runs that the experiment makes by default, in (0, 1]; at least one each
  int scenes = 0;               ///< per case, for experiments that draw scenes; 0 leaves it to `share`
  std::filesystem::path data;   ///< recorded data for experiments that can use them; may be empty
  std::filesystem::path model;  ///< STL of a stairway for experiments that can use one; may be empty
  /// Told what part is done, 0 to 1, and what comes next; may be empty. Called by one thread at a time.
  std::function<void(double done, std::string_view next)> progress;
};

/// How many of `count` runs are made for this share: at least one.
int shared_count(int count, double share);

/// One experiment of the paper, repeated on simulated ground truth.
struct Experiment {
  std::string_view name;  ///< as on the command line, e.g. "series"
  std::string_view summary;
  Result (*run)(const Request& request);
};

/// All experiments, in the order of the paper.
std::span<const Experiment> experiments();

}  // namespace stairway::evaluation
