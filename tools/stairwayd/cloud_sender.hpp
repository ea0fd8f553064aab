// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "ipc/cloud_options.hpp"
#include "tools/stairwayd/newest_queue.hpp"
#include "tools/stairwayd/publish.hpp"

namespace stairway::daemon {

/// The points of a sweep, on their way to STAIRWAY_CLOUD.
struct SweepCloud {
  std::int64_t utime_us = 0;
  std::int64_t sweep_start_utime_us = 0;
  std::int64_t sweep = 0;
  std::vector<Eigen::Vector3f> points;
};

/// Sends clouds in slices that fit a datagram each, at an even pace, by a thread of its own: LCM loses what is sent in
/// one go. A sweep without points is one empty slice. What is under way when it is destroyed stays unfinished.
class CloudSender {
 public:
  /// @pre  the options are within their ranges.
  CloudSender(const ipc::CloudOptions& options, std::string channel, Publish publish);

  /// False when a cloud that still waited was dropped for it.
  bool send(SweepCloud cloud) { return clouds_.push(std::move(cloud)); }
  /// Waits until a cloud can be sent without dropping one; false when asked to stop.
  bool wait_for_room(std::stop_token stop) { return clouds_.wait_for_room(std::move(stop)); }

  /// Sends what waits, then ends; at once when asked to stop.
  void finish(const std::stop_token& stop);
  /// Leaves what is under way; from any thread.
  void stop() { thread_.request_stop(); }

 private:
  void run(std::stop_token stop);
  void send_slices(const SweepCloud& cloud, const std::stop_token& stop);

  const std::size_t slice_points_;
  const double rate_bytes_s_;
  const std::string channel_;
  const Publish publish_;
  NewestQueue<SweepCloud> clouds_;
  std::jthread thread_;
};

}  // namespace stairway::daemon
