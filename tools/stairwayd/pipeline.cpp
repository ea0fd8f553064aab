// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/pipeline.hpp"

#include <fmt/format.h>

#include <utility>

#include "config/settings_table.hpp"
#include "ipc/message_codec.hpp"
#include "tools/common/stage_timer.hpp"
#include "tools/stairwayd/log.hpp"
#include "tools/stairwayd/this_thread.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr auto kReadTimeout = 100ms;
constexpr auto kSettingsInterval = 10s;
constexpr auto kDetectorGrace = 500ms;
constexpr std::size_t kWaitingSweeps = 1;

// Leaves a pass whose answer nobody will want any more; a stage of the detector cannot be interrupted.
struct PassAbandoned {};

std::int64_t utime_now_us() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
}

}  // namespace

Pipeline::Pipeline(const config::Settings& settings, std::unique_ptr<MeasurementSource> source, Publish publish,
                   PassListener on_pass)
    : settings_(settings),
      source_(std::move(source)),
      publish_(std::move(publish)),
      on_pass_(std::move(on_pass)),
      channels_(settings.lcm.channel_prefix),
      health_(Clock::now()),
      publisher_(
          channels_,
          [this](const std::string& channel, std::span<const std::uint8_t> bytes) { return send(channel, bytes); },
          [this](drivers::HostStamp stamp_ns) { return source_->utime_us(stamp_ns); }),
      commands_(settings),
      assembler_(scan::make_calibration(settings.mount), settings.sweep),
      previews_(settings.preview, source_->previews()),
      sweeps_(kWaitingSweeps),
      clouds_(make_cloud_sender()),
      next_settings_(Clock::now()),
      detection_([this](std::stop_token stop) { detect(stop); }),
      acquisition_([this](std::stop_token stop) { acquire(stop); }) {}

Pipeline::~Pipeline() { stop(); }

std::unique_ptr<CloudSender> Pipeline::make_cloud_sender() {
  if (!settings_.cloud.send) return nullptr;
  const auto publish = [this](const std::string& channel, std::span<const std::uint8_t> bytes) {
    return send(channel, bytes);
  };
  return std::make_unique<CloudSender>(settings_.cloud, channels_.cloud, publish);
}

bool Pipeline::stop() {
  detection_.request_stop();
  acquisition_.request_stop();
  if (!acquisition_.joinable()) return !detection_.joinable();
  acquisition_.join();
  if (clouds_) clouds_->stop();
  health_.note_stop();
  send(channels_.health, ipc::encode(health_.report(Clock::now(), utime_now_us())));
  if (!detection_ended_.try_acquire_for(kDetectorGrace)) return false;
  detection_.join();
  return true;
}

void Pipeline::acquire(std::stop_token stop) {
  name_this_thread("acquisition");
  while (!stop.stop_requested() && !source_->has_ended()) {
    obey_commands();
    Clock::duration spent{0};
    for (SourceEvent& event : source_->read(kReadTimeout)) {
      const Clock::time_point began = Clock::now();
      std::visit([this](auto& what) { take(std::move(what)); }, event);
      spent += Clock::now() - began;
      for (Job& job : std::exchange(due_, {})) hand_over(std::move(job), stop);
    }
    if (spent > Clock::duration::zero()) health_.note_stage("acquisition", spent);
    progress_.note_read();
  }
  source_->stop();
  sweeps_.close();
  progress_.note_waiting(true);
}

void Pipeline::obey_commands() {
  for (const ipc::CommandAckMessage& ack : commands_.obey(*source_, utime_now_us())) {
    const bool is_accepted = ack.result == ipc::CommandResult::Accepted;
    is_accepted ? log::info("command accepted: " + ack.text)
                : log::repeated_warning("command", "command refused: " + ack.text);
    send(channels_.command_ack, ipc::encode(ack));
  }
  health_.note(commands_.mode());
}

void Pipeline::command(ipc::CommandMessage command) {
  if (!commands_.receive(std::move(command))) health_.count("commands-dropped");
}

void Pipeline::take(drivers::LaserScan scan) {
  health_.note_scan(scan);
  publisher_.add(scan, assembler_.angle_track());
  assembler_.add(std::move(scan));
  follow_sweeps();
}

void Pipeline::take(const std::vector<drivers::AngleSample>& samples) {
  // One at a time: how far a preview reaches must not depend on how many came together.
  for (const drivers::AngleSample& sample : samples) {
    assembler_.add(std::span(&sample, 1));
    publisher_.add(std::span(&sample, 1), assembler_.angle_track());
    follow_sweeps();
  }
  health_.note_angles(samples.size(), assembler_.angle_track());
}

void Pipeline::take(const SourceState& state) {
  const std::string text = fmt::format("{}: {}", to_string(state.device), state.text);
  // Why a device has failed was said with its trouble.
  state.condition == Condition::Good ? log::info(text) : log::debug(text);
  health_.note(state);
  publisher_.note(state, assembler_.angle_track());
}

void Pipeline::take(const SourceSign& sign) { health_.note(sign, Clock::now()); }

void Pipeline::take(const SourceNote& note) { log::info(note.text); }

void Pipeline::take(RawBytes raw) {
  const ipc::RawMessage message{source_->utime_us(raw.stamp_ns), raw.stamp_ns, to_string(raw.device), raw.is_sent,
                                std::move(raw.bytes)};
  send(channels_.raw, ipc::encode(message));
}

void Pipeline::take(const drivers::ClockQuality& quality) { health_.note(quality); }

void Pipeline::take(const SourceTrouble& trouble) {
  log::repeated_warning(trouble.name, fmt::format("{}: {}", trouble.name, trouble.detail));
  health_.count_trouble(trouble);
}

void Pipeline::follow_sweeps() {
  while (auto sweep = assembler_.take_sweep()) {
    commands_.note_sweep(*sweep, *source_);
    health_.note_sweep(*sweep, Clock::now());
    due_.push_back(make_job(std::move(*sweep), false));
  }
  const scan::Sweep* under_way = assembler_.sweep_under_way();
  if (under_way == nullptr || !may_preview()) return;
  if (previews_.take_due(*under_way, publisher_.utime_us(under_way->end_ns)))
    due_.push_back(make_job(*under_way, true));
}

// What the devices measure goes on while the detector works, so it looks at the sweep when it has time for that.
bool Pipeline::may_preview() const { return source_->waits_for_detector() || (due_.empty() && unanswered_ == 0); }

Pipeline::Job Pipeline::make_job(scan::Sweep sweep, bool is_preview) {
  const std::int64_t begin_utime_us = publisher_.utime_us(sweep.begin_ns);
  const std::int64_t end_utime_us = publisher_.utime_us(sweep.end_ns);
  return {std::move(sweep), is_preview, begin_utime_us, end_utime_us, Clock::now()};
}

void Pipeline::hand_over(Job job, const std::stop_token& stop) {
  if (source_->waits_for_detector()) {
    progress_.note_waiting(true);
    const bool has_room = sweeps_.wait_for_room(stop);
    progress_.note_waiting(false);
    if (!has_room) return;
    job.queued = Clock::now();
  }
  const bool is_preview_waiting = std::exchange(is_newest_a_preview_, job.is_preview);
  ++unanswered_;
  if (sweeps_.push(std::move(job))) return;
  --unanswered_;
  if (is_preview_waiting) return;
  health_.count("unseen-sweeps");
  log::repeated_warning("unseen sweeps", "the detector is slower than the disk; a sweep was left out");
}

void Pipeline::detect(std::stop_token stop) {
  name_this_thread("detection");
  // It computes for seconds; the devices and the robot's controller cannot wait.
  let_others_go_first();
  while (auto job = sweeps_.pop(stop)) {
    if (!job->is_preview) health_.note_stage("waiting", Clock::now() - job->queued);
    progress_.begin_pass(Clock::now());
    try {
      tell(answer(*job, stop));
    } catch (const PassAbandoned&) {
      if (stop.stop_requested()) break;
    }
    progress_.end_pass();
    if (!job->is_preview) send_cloud(std::move(*job), stop);
    --unanswered_;
  }
  if (clouds_ && !stop.stop_requested()) clouds_->finish(stop);
  has_ended_ = !stop.stop_requested();
  detection_ended_.release();
}

void Pipeline::tell(Pass pass) {
  // An empty preview would say no more than the last message, and hide it from those who look at the newest alone.
  const bool is_news = !pass.is_preview || !pass.message.detection.stairways.empty();
  if (pass.is_preview) {
    health_.note_preview(pass.message, pass.timings, Clock::now());
    so_far_.complete(pass.message);
  } else {
    health_.note_answer(pass.message, pass.timings, Clock::now());
    so_far_.forget();
  }
  pass.is_sent = is_news && send(channels_.stairways, ipc::encode(pass.message));
  if (on_pass_) on_pass_(pass);
}

// Of devices that do not wait, nothing but a whole sweep comes while a pass is under way.
bool Pipeline::is_overtaken(const Job& job) const {
  return job.is_preview && !source_->waits_for_detector() && !sweeps_.is_empty();
}

void Pipeline::send_cloud(Job job, std::stop_token stop) {
  if (!clouds_ || (source_->waits_for_detector() && !clouds_->wait_for_room(std::move(stop)))) return;
  const bool has_room = clouds_->send({job.end_utime_us, job.begin_utime_us,
                                       static_cast<std::int64_t>(job.sweep.number), std::move(job.sweep.cloud.points)});
  if (has_room) return;
  health_.count("unsent-clouds");
  log::repeated_warning("unsent clouds", "cloud.rate_mb_s is too low for the disk's speed; a cloud was left out");
}

Pass Pipeline::answer(const Job& job, std::stop_token stop) {
  detect::DetectorOptions options;
  {
    const std::lock_guard lock(settings_mutex_);
    options = settings_.detector;
  }
  tools::StageTimer timer;
  const auto on_stage = [&](std::string_view stage) {
    if (stop.stop_requested() || is_overtaken(job)) throw PassAbandoned{};
    timer.begin(stage);
  };
  Pass pass;
  pass.message.detection = detect::detect_stairways(job.sweep.cloud, options, on_stage);
  timer.stop();
  pass.message.utime_us = job.end_utime_us;
  pass.message.sweep_start_utime_us = job.begin_utime_us;
  pass.message.sweep = static_cast<std::int64_t>(job.sweep.number);
  pass.message.is_final = !job.is_preview && job.sweep.statistics.covers_whole_turn();
  const auto& stairways = pass.message.detection.stairways;
  pass.message.track_ids = job.is_preview ? tracker_.follow_preview(stairways) : tracker_.follow(stairways);
  pass.is_preview = job.is_preview;
  pass.points = job.sweep.cloud.points.size();
  pass.flaws = job.sweep.statistics.flaws();
  pass.timings = timer.timings();
  return pass;
}

ipc::HealthMessage Pipeline::report() {
  ipc::HealthMessage health = health_.report(Clock::now(), utime_now_us());
  send(channels_.health, ipc::encode(health));
  const Clock::time_point now = Clock::now();
  if (now >= next_settings_ && send_settings()) next_settings_ = now + kSettingsInterval;
  return health;
}

void Pipeline::set_detector_options(const detect::DetectorOptions& options) {
  const std::lock_guard lock(settings_mutex_);
  settings_.detector = options;
  next_settings_ = Clock::now();
}

bool Pipeline::send(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const bool is_sent = publish_(channel, bytes);
  if (!is_sent) health_.count("unsent-messages");
  return is_sent;
}

bool Pipeline::send_settings() {
  const std::lock_guard lock(settings_mutex_);
  return send(channels_.settings,
              ipc::encode(ipc::SettingsMessage{utime_now_us(), STAIRWAY_VERSION, config::to_toml(settings_)}));
}

}  // namespace stairway::daemon
