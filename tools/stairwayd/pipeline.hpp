// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <semaphore>
#include <span>
#include <stop_token>
#include <string>
#include <thread>

#include "config/settings.hpp"
#include "ipc/channels.hpp"
#include "ipc/messages.hpp"
#include "ipc/recording/recorder.hpp"
#include "ipc/stairway_json.hpp"
#include "scan_assembly/sweep_assembler.hpp"
#include "tools/stairwayd/cloud_sender.hpp"
#include "tools/stairwayd/command_desk.hpp"
#include "tools/stairwayd/health_book.hpp"
#include "tools/stairwayd/measurement_publisher.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/newest_queue.hpp"
#include "tools/stairwayd/preview_schedule.hpp"
#include "tools/stairwayd/progress_watch.hpp"
#include "tools/stairwayd/publish.hpp"
#include "tools/stairwayd/stairway_tracker.hpp"
#include "tools/stairwayd/stairways_so_far.hpp"

namespace stairway::daemon {

/// The answer for one sweep, or for a part of one.
struct Pass {
  ipc::StairwaysMessage message;
  bool is_preview = false;  ///< the sweep was still under way
  std::size_t points = 0;
  std::vector<std::string> flaws;  ///< of the sweep, for a person
  bool is_sent = false;            ///< the message went out
  ipc::Timings timings;
};

/// The whole daemon between a source of measurements and the bus, LCM or another: source -> sweeps -> stairways ->
/// messages.
///
/// One thread reads the source, sends STAIRWAY_SCAN, STAIRWAY_ANGLES and STAIRWAY_DISK and assembles sweeps; another
/// one finds stairways and sends STAIRWAY_STAIRWAYS for every sweep, also when there are none. At most one sweep waits
/// for the detector; a newer one replaces it, which is counted; only a source whose time is its own is kept waiting.
/// While the detector has nothing else to do, it looks at the sweep under way, and what that shows is sent as a
/// preview. STAIRWAY_HEALTH and STAIRWAY_SETTINGS go out with report(). What cannot be sent is counted and lost.
class Pipeline {
 public:
  /// Called by the detection thread after every pass, when its answer has been sent or was not worth it.
  using PassListener = std::function<void(const Pass&)>;

  /// Starts at once.
  /// @pre  settings.problem() is empty.
  Pipeline(const config::Settings& settings, std::unique_ptr<MeasurementSource> source, Publish publish,
           PassListener on_pass = {});
  /// Stops, and waits for the detector.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// Sends STAIRWAY_HEALTH, and every ten seconds STAIRWAY_SETTINGS, for those who begin to record; call it once a
  /// second, from one thread.
  ipc::HealthMessage report();

  /// Whether the threads got on since the last call: the source was read, or waits for the detector, and the detector
  /// did not take more than a minute. False means that something hangs; missing devices are no reason.
  bool has_progressed(ProgressWatch::Clock::time_point now = ProgressWatch::Clock::now()) {
    return progress_.has_progressed(now);
  }

  /// Whether the source has ended, and every sweep it gave has its answer.
  bool has_ended() const { return has_ended_; }

  /// How the recording of the messages is doing, for STAIRWAY_HEALTH.
  void note_recording(const ipc::RecorderStatus& status) { health_.note(status); }

  /// Why messages cannot be sent, empty when they can, for STAIRWAY_HEALTH and whoever reads its text.
  void note_bus(std::string trouble) { health_.note_bus(std::move(trouble)); }

  /// Obeys soon, and answers on STAIRWAY_COMMAND_ACK; from any thread.
  void command(ipc::CommandMessage command);

  /// Stops the source (the motor first, then scanning), leaves the pass under way at its next stage, and sends a last
  /// STAIRWAY_HEALTH. Waits at most about 9 s for the disk to stand, and half a second for the detector.
  /// @return Whether it has ended; a stage cannot be interrupted, and takes seconds for a large cloud.
  bool stop();

  /// From the next sweep on; call it from the thread of report(). Sends the settings again with the next report.
  /// @pre  options.problem() is empty.
  void set_detector_options(const detect::DetectorOptions& options);

 private:
  using Clock = std::chrono::steady_clock;
  struct Job {
    scan::Sweep sweep;
    bool is_preview = false;
    std::int64_t begin_utime_us = 0;
    std::int64_t end_utime_us = 0;
    Clock::time_point queued;
  };

  std::unique_ptr<CloudSender> make_cloud_sender();
  void acquire(std::stop_token stop);
  void obey_commands();
  void take(drivers::LaserScan scan);
  void take(const std::vector<drivers::AngleSample>& samples);
  void take(const SourceState& state);
  void take(const SourceTrouble& trouble);
  void take(const SourceSign& sign);
  void take(const SourceNote& note);
  void take(RawBytes raw);
  void take(const drivers::ClockQuality& quality);
  void follow_sweeps();
  bool may_preview() const;
  Job make_job(scan::Sweep sweep, bool is_preview);
  void hand_over(Job job, const std::stop_token& stop);
  void detect(std::stop_token stop);
  Pass answer(const Job& job, std::stop_token stop);
  void tell(Pass pass);
  bool is_overtaken(const Job& job) const;
  void send_cloud(Job job, std::stop_token stop);
  bool send(const std::string& channel, std::span<const std::uint8_t> bytes);
  bool send_settings();

  std::mutex settings_mutex_;
  config::Settings settings_;
  const std::unique_ptr<MeasurementSource> source_;
  const Publish publish_;
  const PassListener on_pass_;
  const ipc::Channels channels_;
  HealthBook health_;
  MeasurementPublisher publisher_;
  CommandDesk commands_;
  scan::SweepAssembler assembler_;
  PreviewSchedule previews_;
  std::vector<Job> due_;  // not handed over yet
  NewestQueue<Job> sweeps_;
  bool is_newest_a_preview_ = false;  // of what was handed over
  std::atomic<int> unanswered_ = 0;   // what was handed over and the detector is not done with
  StairwayTracker tracker_;
  StairwaysSoFar so_far_;

  const std::unique_ptr<CloudSender> clouds_;  // null when they are not wanted

  ProgressWatch progress_;
  Clock::time_point next_settings_;
  std::binary_semaphore detection_ended_{0};
  std::atomic<bool> has_ended_ = false;

  std::jthread detection_;
  std::jthread acquisition_;
};

}  // namespace stairway::daemon
