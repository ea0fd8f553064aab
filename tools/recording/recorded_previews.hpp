// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stairway::tools {

/// How far sweeps under way had got when the recorded run told what they showed: the last beams' instants, in
/// microseconds since the epoch, in order. When a detector has time to look is not measured, but it is recorded by
/// that.
///
/// Reads the whole file.
/// @return Empty when the recording has no answers at all, so that it says nothing about it.
std::optional<std::vector<std::int64_t>> recorded_previews(const std::filesystem::path& path,
                                                           const std::string& channel_prefix);

}  // namespace stairway::tools
