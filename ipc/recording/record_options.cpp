// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/record_options.hpp"

namespace stairway::ipc {

std::string RecordOptions::problem() const {
  if (mode == RecordMode::Off) return {};
  if (folder.empty()) return "folder must name a folder";
  if (max_file_mb > max_total_mb) return "max_file_mb must not exceed max_total_mb";
  return {};
}

}  // namespace stairway::ipc
