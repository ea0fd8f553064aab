// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/cloud_sender.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "ipc/message_codec.hpp"
#include "tools/stairwayd/pause.hpp"
#include "tools/stairwayd/this_thread.hpp"

namespace stairway::daemon {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kWaitingClouds = 1;  // some 18 MB each

std::size_t slice_points(const ipc::CloudOptions& options) {
  const std::size_t empty_slice = ipc::encode(ipc::CloudSliceMessage{}).size();
  return (static_cast<std::size_t>(options.slice_bytes) - empty_slice) / ipc::kCloudPointBytes;
}

}  // namespace

CloudSender::CloudSender(const ipc::CloudOptions& options, std::string channel, Publish publish)
    : slice_points_(slice_points(options)),
      rate_bytes_s_(1e6 * options.rate_mb_s),
      channel_(std::move(channel)),
      publish_(std::move(publish)),
      clouds_(kWaitingClouds),
      thread_([this](std::stop_token stop) { run(std::move(stop)); }) {}

void CloudSender::finish(const std::stop_token& stop) {
  clouds_.close();
  const std::stop_callback leave(stop, [this] { thread_.request_stop(); });
  thread_.join();
}

void CloudSender::run(std::stop_token stop) {
  name_this_thread("cloud");
  while (const auto cloud = clouds_.pop(stop)) send_slices(*cloud, stop);
}

void CloudSender::send_slices(const SweepCloud& cloud, const std::stop_token& stop) {
  const std::size_t points = cloud.points.size();
  const std::size_t slices = std::max<std::size_t>(1, (points + slice_points_ - 1) / slice_points_);
  ipc::CloudSliceMessage message{cloud.utime_us, cloud.sweep_start_utime_us, cloud.sweep, 0, 0, 0, 0, {}};
  message.slices = static_cast<std::int32_t>(slices);
  message.sweep_points = static_cast<std::int32_t>(points);
  Clock::time_point due = Clock::now();
  for (std::size_t i = 0; i < slices && !stop.stop_requested(); ++i) {
    const std::size_t begin = i * slice_points_, end = std::min(points, begin + slice_points_);
    message.slice = static_cast<std::int32_t>(i);
    message.first_point = static_cast<std::int32_t>(begin);
    message.points.assign(cloud.points.begin() + static_cast<std::ptrdiff_t>(begin),
                          cloud.points.begin() + static_cast<std::ptrdiff_t>(end));
    const ipc::Bytes bytes = ipc::encode(message);
    publish_(channel_, bytes);
    // Time lost by a busy computer is not made up for by a burst.
    due = std::max(due, Clock::now()) + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                                            static_cast<double>(bytes.size()) / rate_bytes_s_));
    pause_until(due, stop);
  }
}

}  // namespace stairway::daemon
