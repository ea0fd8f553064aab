// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <tl/expected.hpp>

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// Draws a chart for a report: round numbers on the axes, the legend above the drawing, error bars. What the paper
/// states is hollow and dashed. Curves with error bars stand a few pixels apart, so that none hides another.
/// @param path  an SVG if it ends in ".svg", else a PNG.
/// @return an error in one line that names the file.
tl::expected<void, std::string> draw_chart(const std::filesystem::path& path, const Chart& chart);

}  // namespace stairway::evaluation
