// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "ipc/health_json.hpp"
#include "tools/stairway/daemon_news.hpp"

namespace stairway::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStatuses[] = {"ok", "no-return", "too-near", "disturbed", "invalid"};

const char* status_name(drivers::BeamStatus status) { return kStatuses[static_cast<std::size_t>(status)]; }

std::string as_csv_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n'; }

// Of all beams the disk angle between those at the ends, as the mirror turns evenly.
double disk_angle_rad(const ipc::ScanMessage& message, std::size_t beam) {
  const std::size_t last = std::max<std::size_t>(2, message.scan.ranges_m.size()) - 1;
  const double share = static_cast<double>(beam) / static_cast<double>(last);
  return message.disk_angle_start_rad + share * (message.disk_angle_end_rad - message.disk_angle_start_rad);
}

}  // namespace

TableFile::TableFile(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
  if (file_ == nullptr) error_ = errno;
}

TableFile::~TableFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void TableFile::write(std::string_view text) {
  if (error_ == 0 && std::fwrite(text.data(), 1, text.size(), file_) != text.size()) error_ = errno;
}

tl::expected<void, SourceError> TableFile::close() {
  if (file_ != nullptr && std::fclose(file_) != 0 && error_ == 0) error_ = errno;
  file_ = nullptr;
  if (error_ == 0) return {};
  return tl::unexpected(SourceError{fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(error_))});
}

void write_points_csv(TableFile& file, const scan::PointCloud& cloud, std::span<const std::uint32_t> labels) {
  file.write(labels.empty() ? "x_m,y_m,z_m\n" : "x_m,y_m,z_m,label\n");
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    file.write(fmt::format("{},{},{}", p.x(), p.y(), p.z()));
    file.write(labels.empty() ? "\n" : fmt::format(",{}\n", labels[i]));
  }
}

void write_points_json(TableFile& file, const scan::PointCloud& cloud, std::span<const std::uint32_t> labels) {
  file.write("{\"points\": [");
  const char* comma = "";
  for (const Eigen::Vector3f& p : cloud.points) {
    file.write(fmt::format("{}[{},{},{}]", comma, p.x(), p.y(), p.z()));
    comma = ",";
  }
  file.write("]");
  if (!labels.empty()) file.write(fmt::format(", \"labels\": [{}]", fmt::join(labels, ",")));
  file.write("}\n");
}

std::string scans_csv_heading() {
  return "utime_us,sequence,beam,stamp_ns,beam_angle_rad,disk_angle_rad,range_m,status,intensity\n";
}

std::string csv_lines(const ipc::ScanMessage& message) {
  const drivers::LaserScan& scan = message.scan;
  fmt::memory_buffer out;
  for (std::size_t i = 0; i < scan.ranges_m.size() && i < scan.statuses.size(); ++i) {
    const auto beam = static_cast<double>(i);
    const bool is_ok = scan.statuses[i] == drivers::BeamStatus::Ok;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{:.9g},{},{},{},{}\n", message.utime_us, scan.sequence, i,
                   scan.first_beam_stamp_ns + std::llround(beam * scan.beam_interval_ns),
                   scan.first_angle_rad + beam * scan.angle_increment_rad,
                   message.disk_angle_valid ? fmt::format("{:.9g}", disk_angle_rad(message, i)) : "",
                   is_ok ? fmt::format("{}", scan.ranges_m[i]) : "", status_name(scan.statuses[i]),
                   scan.intensities.empty() ? "" : std::to_string(scan.intensities[i]));
  }
  return fmt::to_string(out);
}

std::string angles_csv_heading() { return "stamp_ns,angle_rad,valid\n"; }

std::string csv_lines(const ipc::AnglesMessage& message) {
  std::string out;
  for (const drivers::AngleSample& sample : message.samples)
    out += fmt::format("{},{},{}\n", sample.stamp_ns, sample.angle_rad, sample.valid ? 1 : 0);
  return out;
}

std::string stairways_csv_heading() {
  return "utime_us,sweep,track_id,kind,direction,steps,step_height_m,step_depth_m,width_m,pitch_rad,heading_rad,"
         "turn_per_step_rad,anchor_x_m,anchor_y_m,anchor_z_m,anchor_side,railing_left,railing_right,score,is_final\n";
}

std::string csv_lines(const ipc::StairwaysMessage& message) {
  std::string out;
  for (std::size_t i = 0; i < message.detection.stairways.size(); ++i) {
    const detect::Stairway& s = message.detection.stairways[i];
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", message.utime_us, message.sweep,
                       message.track_ids[i], to_string(s.kind), to_string(s.direction), s.nosings.size(), s.step_height,
                       s.step_depth, s.width, s.pitch(), s.heading, s.turn_per_step, s.anchor.x(), s.anchor.y(),
                       s.anchor.z(), to_string(s.anchor_side), s.railing_left ? 1 : 0, s.railing_right ? 1 : 0, s.score,
                       message.is_final ? 1 : 0);
  }
  return out;
}

std::string health_csv_heading() { return "utime_us,state,sweep,sweep_progress,scan_rate_hz,disk_rate_hz,points\n"; }

std::string csv_lines(const ipc::HealthMessage& message) {
  return fmt::format("{},{},{},{},{},{},{}\n", message.utime_us, as_csv_text(message.state), message.sweep,
                     message.sweep_progress, message.scan_rate_hz, message.disk_rate_hz, message.points);
}

std::string json_line(const ipc::ScanMessage& message) {
  const drivers::LaserScan& scan = message.scan;
  Json statuses = Json::array();
  for (const drivers::BeamStatus status : scan.statuses) statuses.push_back(status_name(status));
  Json json{{"utime", message.utime_us},
            {"sequence", scan.sequence},
            {"host_stamp_ns", scan.first_beam_stamp_ns},
            {"beam_interval_ns", scan.beam_interval_ns},
            {"first_angle", scan.first_angle_rad},
            {"angle_increment", scan.angle_increment_rad},
            {"disk_angle_start", nullptr},
            {"disk_angle_end", nullptr},
            {"ranges", scan.ranges_m},
            {"statuses", std::move(statuses)}};
  if (message.disk_angle_valid) {
    json["disk_angle_start"] = message.disk_angle_start_rad;
    json["disk_angle_end"] = message.disk_angle_end_rad;
  }
  if (!scan.intensities.empty()) json["intensities"] = scan.intensities;
  return dump(json);
}

std::string json_line(const ipc::AnglesMessage& message) {
  Json angles = Json::array();
  for (const drivers::AngleSample& sample : message.samples)
    angles.push_back({{"host_stamp_ns", sample.stamp_ns}, {"angle", sample.angle_rad}, {"valid", sample.valid}});
  return dump({{"utime", message.utime_us}, {"angles", std::move(angles)}});
}

std::string json_line(const ipc::StairwaysMessage& message) { return answer_json(message) + '\n'; }

std::string json_line(const ipc::HealthMessage& message) { return ipc::health_json(message) + '\n'; }

}  // namespace stairway::tools
