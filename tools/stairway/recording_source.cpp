// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/recording_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "tools/recording/recorded_settings.hpp"
#include "tools/stairway/report.hpp"

namespace stairway::tools {

tl::expected<OpenRecording, SourceError> open_recording(const std::string& name, const SettingsArguments& arguments) {
  auto facts = examine_recording(name);
  if (!facts) return tl::unexpected(SourceError{std::move(facts.error().text)});
  SettingsArguments layered = arguments;
  if (arguments.files.empty() && arguments.profile.empty()) {
    const RecordedSettings recorded = recorded_settings(facts->settings ? facts->settings->toml : "");
    layered.assignments.insert(layered.assignments.begin(), recorded.assignments.begin(), recorded.assignments.end());
    for (const std::string& key : recorded.unknown_keys)
      report_error(fmt::format("{}: this version has no setting {}", name, key));
    if (!facts->settings) report_error(fmt::format("{}: it does not tell its settings; the defaults are used", name));
  }
  auto loaded = load_settings(layered);
  if (!loaded) return tl::unexpected(SourceError{fmt::format("{}: {}", name, loaded.error().text)});
  return OpenRecording{name, std::move(*facts), std::move(loaded->settings)};
}

tl::expected<RecordedSweeps, SourceError> open_sweeps(const OpenRecording& recording) {
  auto sweeps = RecordedSweeps::open(recording.name, recording.facts, recording.settings);
  if (!sweeps) return tl::unexpected(SourceError{std::move(sweeps.error().text)});
  return std::move(*sweeps);
}

void report_flaws(const std::string& name, const RecordedMeasurements& measurements) {
  if (const std::string flaws = describe_flaws(measurements); !flaws.empty())
    report_error(fmt::format("{}: {}", name, flaws));
}

}  // namespace stairway::tools
