// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/pipeline.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <numbers>
#include <thread>

#include "ipc/message_codec.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kScanPeriod_ns = 25'000'000;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// A disk that turns once in 40 scans, which see a wall around the scanner.
std::vector<SourceEvent> turning_events(int scans, std::size_t beams = 100) {
  std::vector<SourceEvent> events{SourceState{Device::Scanner, Condition::Good, "playing"}};
  for (int i = 0; i <= scans; ++i) {
    const std::int64_t stamp_ns = i * kScanPeriod_ns;
    events.emplace_back(std::vector{drivers::AngleSample{stamp_ns, kTurn_rad * i / 40.0, true}});
    if (i == scans) break;
    drivers::LaserScan scan;
    scan.sequence = static_cast<std::uint64_t>(i);
    scan.first_beam_stamp_ns = stamp_ns;
    scan.beam_interval_ns = 24e6 / static_cast<double>(beams);
    scan.first_angle_rad = -0.5;
    scan.angle_increment_rad = 1.0 / static_cast<double>(beams);
    scan.ranges_m.assign(beams, 3.0F);
    scan.statuses.assign(beams, drivers::BeamStatus::Ok);
    events.emplace_back(std::move(scan));
  }
  return events;
}

/// Plays events, then stays silent.
class ScriptedSource final : public MeasurementSource {
 public:
  ScriptedSource(std::vector<SourceEvent> events, std::atomic<bool>& is_stopped)
      : events_(std::move(events)), is_stopped_(is_stopped) {}

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override {
    if (events_.empty()) std::this_thread::sleep_for(std::min(timeout, 5ms));
    return std::exchange(events_, {});
  }
  std::string order(const DiskOrder&) override { return "a script is played"; }
  void stop() override { is_stopped_ = true; }
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override { return 1'000'000 + stamp_ns / 1000; }

 private:
  std::vector<SourceEvent> events_;
  std::atomic<bool>& is_stopped_;
};

/// Keeps what was sent.
class Outbox {
 public:
  Publish publish() {
    return [this](const std::string& channel, std::span<const std::uint8_t> bytes) {
      const std::lock_guard lock(mutex_);
      sent_[channel].emplace_back(bytes.begin(), bytes.end());
      return true;
    };
  }

  template <class Message>
  std::vector<Message> sent(const std::string& channel) {
    const std::lock_guard lock(mutex_);
    std::vector<Message> messages;
    for (const ipc::Bytes& bytes : sent_[channel]) messages.push_back(ipc::decode<Message>(bytes).value());
    return messages;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::vector<ipc::Bytes>> sent_;
};

template <class Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

const ipc::Channels kChannels;

class PipelineTest : public testing::Test {
 protected:
  std::unique_ptr<Pipeline> start(std::vector<SourceEvent> events, Pipeline::PassListener on_pass = {},
                                  const config::Settings& settings = {}) {
    return std::make_unique<Pipeline>(settings, std::make_unique<ScriptedSource>(std::move(events), is_stopped),
                                      outbox.publish(), std::move(on_pass));
  }
  std::size_t answers() { return outbox.sent<ipc::StairwaysMessage>(kChannels.stairways).size(); }

  std::atomic<bool> is_stopped = false;
  Outbox outbox;
};

TEST_F(PipelineTest, every_sweep_has_an_answer_even_without_stairways) {
  const auto pipeline = start(turning_events(45));
  ASSERT_TRUE(comes_true([&] { return answers() == 1; }));
  const auto answer = outbox.sent<ipc::StairwaysMessage>(kChannels.stairways).front();
  EXPECT_TRUE(answer.detection.stairways.empty());
  EXPECT_EQ(answer.sweep, 0);
  EXPECT_TRUE(answer.is_final);
  EXPECT_EQ(answer.sweep_start_utime_us, 1'000'000);
  EXPECT_NEAR(static_cast<double>(answer.utime_us), 2'000'000.0, 1000.0);
}

TEST_F(PipelineTest, scans_bear_the_disk_angles_of_their_ends) {
  const auto pipeline = start(turning_events(10));
  const auto scans = [&] { return outbox.sent<ipc::ScanMessage>(kChannels.scan); };
  ASSERT_TRUE(comes_true([&] { return scans().size() == 10; }));
  const ipc::ScanMessage scan = scans()[4];
  EXPECT_EQ(scan.scan.sequence, 4u);
  EXPECT_EQ(scan.utime_us, 1'000'000 + 4 * 25'000);
  EXPECT_TRUE(scan.disk_angle_valid);
  EXPECT_NEAR(scan.disk_angle_start_rad, kTurn_rad * 4 / 40, 1e-9);
  EXPECT_NEAR(scan.disk_angle_end_rad, kTurn_rad * (4 + 99 * 0.24 / 25) / 40, 1e-9);
}

TEST_F(PipelineTest, disk_is_told_ten_times_a_second_of_measurement_time) {
  const auto pipeline = start(turning_events(80));
  ASSERT_TRUE(comes_true([&] { return answers() >= 1; }));
  const auto disks = outbox.sent<ipc::DiskMessage>(kChannels.disk);
  ASSERT_EQ(disks.size(), 21u);
  EXPECT_EQ(disks[1].utime_us - disks[0].utime_us, 100'000);
  EXPECT_EQ(disks.front().index_count, 1);
  EXPECT_EQ(disks.back().index_count, 3);
}

TEST_F(PipelineTest, slow_detector_gets_the_newest_sweep_and_the_others_are_counted) {
  std::atomic<std::int64_t> passes = 0, last_sweep = -1;
  std::atomic<bool> is_slow = true;
  const auto pipeline = start(turning_events(40 * 6 + 5), [&](const Pass& pass) {
    ++passes;
    last_sweep = pass.message.sweep;
    while (is_slow) std::this_thread::sleep_for(1ms);
  });
  EXPECT_TRUE(comes_true([&] { return pipeline->report().sweep == 6; }));
  is_slow = false;
  EXPECT_TRUE(comes_true([&] { return last_sweep == 5; }));
  const auto listed = pipeline->report().drops;
  const std::map<std::string, std::int64_t> drops(listed.begin(), listed.end());
  EXPECT_LE(passes, 3);
  ASSERT_TRUE(drops.contains("unseen-sweeps"));
  EXPECT_EQ(drops.at("unseen-sweeps"), 6 - passes);
}

TEST_F(PipelineTest, previews_neither_replace_sweeps_nor_count_as_lost) {
  config::Settings settings;
  settings.preview.every_s = 0.2;
  std::atomic<std::int64_t> answers = 0, previews = 0;
  std::atomic<bool> is_slow = true;
  const auto on_pass = [&](const Pass& pass) {
    ++(pass.is_preview ? previews : answers);
    while (is_slow) std::this_thread::sleep_for(1ms);
  };
  const auto pipeline = start(turning_events(40 * 6 + 30, 1000), on_pass, settings);
  EXPECT_TRUE(comes_true([&] { return pipeline->report().sweep == 6; }));
  is_slow = false;
  const auto unseen = [&] {
    const auto listed = pipeline->report().drops;
    const std::map<std::string, std::int64_t> drops(listed.begin(), listed.end());
    return drops.contains("unseen-sweeps") ? drops.at("unseen-sweeps") : 0;
  };
  EXPECT_TRUE(comes_true([&] { return answers + unseen() == 6; })) << answers << " answers, " << unseen() << " unseen";
  EXPECT_LE(previews, 2);
}

TEST_F(PipelineTest, progresses_without_measurements_and_without_sweeps) {
  const auto pipeline = start({});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(comes_true([&] { return pipeline->has_progressed(); }));
}

TEST_F(PipelineTest, stuck_detector_is_no_progress_although_scans_arrive) {
  std::atomic<bool> is_stuck = true;
  const auto pipeline = start(turning_events(45), [&](const Pass&) {
    while (is_stuck) std::this_thread::sleep_for(1ms);
  });
  ASSERT_TRUE(comes_true([&] { return answers() == 1; }));
  const auto much_later = [] { return std::chrono::steady_clock::now() + ProgressWatch::kLongestPass; };
  EXPECT_TRUE(comes_true([&] { return pipeline->has_progressed(); }));
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(20ms);
    EXPECT_FALSE(pipeline->has_progressed(much_later()));
  }
  is_stuck = false;
  EXPECT_TRUE(comes_true([&] { return pipeline->has_progressed(much_later()); }));
}

TEST_F(PipelineTest, stop_ends_the_source_and_tells_it) {
  const auto pipeline = start(turning_events(10));
  EXPECT_FALSE(is_stopped);
  EXPECT_TRUE(pipeline->stop());
  EXPECT_TRUE(is_stopped);
  EXPECT_EQ(outbox.sent<ipc::HealthMessage>(kChannels.health).back().state, "stopped");
}

TEST_F(PipelineTest, fault_of_the_disk_is_told_at_once_and_with_every_angle_until_it_is_over) {
  std::vector<SourceEvent> events = turning_events(8);
  events.emplace_back(SourceState{Device::Encoder, Condition::Failed, "edges were lost", 8 * kScanPeriod_ns});
  events.emplace_back(SourceState{Device::Motor, Condition::Failed, "fault", 8 * kScanPeriod_ns});
  events.emplace_back(std::vector{drivers::AngleSample{12 * kScanPeriod_ns, 1.0, false}});
  events.emplace_back(SourceState{Device::Encoder, Condition::Good, "indexed", 13 * kScanPeriod_ns});
  events.emplace_back(SourceState{Device::Motor, Condition::Good, "running", 14 * kScanPeriod_ns});
  const auto pipeline = start(std::move(events));
  const auto disks = [&] { return outbox.sent<ipc::DiskMessage>(kChannels.disk); };
  ASSERT_TRUE(comes_true([&] { return disks().size() == 7; }));
  const auto sent = disks();
  EXPECT_EQ(sent[2].fault, ipc::DiskFault::None);
  EXPECT_EQ(sent[3].fault, ipc::DiskFault::Encoder);
  EXPECT_EQ(sent[3].fault_text, "edges were lost");
  EXPECT_EQ(sent[4].fault, ipc::DiskFault::Encoder);
  EXPECT_EQ(sent[5].fault, ipc::DiskFault::Motor);
  EXPECT_EQ(sent[6].fault, ipc::DiskFault::None);
  EXPECT_EQ(sent[6].fault_text, "");
}

TEST_F(PipelineTest, settings_go_out_with_the_first_report_and_after_a_change) {
  const auto pipeline = start({});
  for (int i = 0; i < 3; ++i) pipeline->report();
  EXPECT_EQ(outbox.sent<ipc::SettingsMessage>(kChannels.settings).size(), 1u);
  detect::DetectorOptions options;
  options.voxel_m = 0.025;
  pipeline->set_detector_options(options);
  pipeline->report();
  const auto settings = outbox.sent<ipc::SettingsMessage>(kChannels.settings);
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_NE(settings.back().toml.find("voxel_mm = 25"), std::string::npos);
}

TEST_F(PipelineTest, troubles_are_counted_by_name_and_what_cannot_be_sent_too) {
  const SourceTrouble trouble{Device::Scanner, "scanner: corrupt message", "sum"};
  std::vector<SourceEvent> events{trouble, trouble};
  const auto refuse = [](const std::string&, std::span<const std::uint8_t>) { return false; };
  Pipeline pipeline(config::Settings{}, std::make_unique<ScriptedSource>(std::move(events), is_stopped), refuse);
  EXPECT_TRUE(comes_true([&] {
    const auto listed = pipeline.report().drops;
    const std::map<std::string, std::int64_t> drops(listed.begin(), listed.end());
    return drops.contains("unsent-messages") && drops.contains("scanner:corrupt-message") &&
           drops.at("scanner:corrupt-message") == 2;
  }));
}

}  // namespace
}  // namespace stairway::daemon
