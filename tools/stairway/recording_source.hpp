// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "tools/recording/recorded_sweeps.hpp"
#include "tools/stairway/arguments.hpp"
#include "tools/stairway/source.hpp"

namespace stairway::tools {

/// Whether a SOURCE is a recording, by its name.
inline bool is_recording(std::string_view name) { return name.ends_with(".lcm"); }

/// A recording and the settings it is looked at with.
struct OpenRecording {
  std::string name;
  RecordingFacts facts;
  config::Settings settings;
};

/// The settings are those that the recording tells, changed by --set; or those of --config or --profile if there is
/// any. What the recording says and this version does not know is told on stderr.
tl::expected<OpenRecording, SourceError> open_recording(const std::string& name, const SettingsArguments& arguments);

/// Its sweeps from the first on.
tl::expected<RecordedSweeps, SourceError> open_sweeps(const OpenRecording& recording);

/// Tells on stderr what is wrong with a recording that was read to its end.
void report_flaws(const std::string& name, const RecordedMeasurements& measurements);

}  // namespace stairway::tools
