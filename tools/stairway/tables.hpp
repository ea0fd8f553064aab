// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "ipc/messages.hpp"
#include "scan_assembly/point_cloud.hpp"
#include "tools/stairway/source.hpp"

namespace stairway::tools {

/// Writes a text file line by line; what went wrong is told in the end.
class TableFile {
 public:
  explicit TableFile(std::filesystem::path path);
  ~TableFile();
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  void write(std::string_view text);
  /// Ends the file.
  tl::expected<void, SourceError> close();

 private:
  std::filesystem::path path_;
  std::FILE* file_;
  int error_ = 0;
};

/// Points as CSV: x,y,z in metres, and a label if there are any.
/// @param labels  empty, or one per point.
void write_points_csv(TableFile& file, const scan::PointCloud& cloud, std::span<const std::uint32_t> labels);
/// One object: {"points": [[x, y, z], ...]}, with "labels": [...] if there are any.
void write_points_json(TableFile& file, const scan::PointCloud& cloud, std::span<const std::uint32_t> labels);

/// The first line of a table of messages, and the lines of one message. Metres, radians, microseconds since the epoch;
/// what is not known stays empty.
std::string scans_csv_heading();
std::string csv_lines(const ipc::ScanMessage& message);  ///< a line per beam
std::string angles_csv_heading();
std::string csv_lines(const ipc::AnglesMessage& message);  ///< a line per angle
std::string stairways_csv_heading();
std::string csv_lines(const ipc::StairwaysMessage& message);  ///< a line per stairway
std::string health_csv_heading();
std::string csv_lines(const ipc::HealthMessage& message);

/// The same as JSON, an object on one line per message; of stairways that of `stairway monitor`.
std::string json_line(const ipc::ScanMessage& message);
std::string json_line(const ipc::AnglesMessage& message);
std::string json_line(const ipc::StairwaysMessage& message);
std::string json_line(const ipc::HealthMessage& message);

}  // namespace stairway::tools
