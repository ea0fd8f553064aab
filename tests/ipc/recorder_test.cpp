// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/recording/recorder.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <set>
#include <string>
#include <thread>

#include "ipc/message_codec.hpp"
#include "ipc/recording/event_log_reader.hpp"
#include "ipc/recording/recording_files.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway::ipc {
namespace {

using namespace std::chrono_literals;
using Time = RecordingFiles::Time;

const Channels kChannels;

RecordOptions options_in(const test::TemporaryFolder& folder, RecordMode mode = RecordMode::Continuous) {
  RecordOptions options;
  options.mode = mode;
  options.folder = folder.path();
  options.min_free_mb = 0;
  options.max_file_mb = 1;
  options.max_total_mb = 3;
  return options;
}

StoredEvent event_of(std::size_t bytes, const std::string& channel = kChannels.scan) {
  return {1'700'000'000'000'000, channel, std::vector<std::uint8_t>(bytes, 7)};
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  const std::set<std::filesystem::path> sorted(std::filesystem::directory_iterator{folder}, {});
  return {sorted.begin(), sorted.end()};
}

std::vector<StoredEvent> read_all(const std::filesystem::path& path) {
  std::vector<StoredEvent> events;
  auto reader = EventLogReader::open(path);
  if (!reader) return events;
  while (const auto event = reader->next())
    events.push_back({event->utime_us, std::string(event->channel), {event->bytes.begin(), event->bytes.end()}});
  EXPECT_EQ(describe(reader->damage()), "");
  return events;
}

TEST(RecordingFiles, large_file_is_continued_in_a_new_one_that_begins_with_the_settings) {
  const test::TemporaryFolder folder;
  RecordingFiles files(options_in(folder), "stairway");
  files.set_preamble(event_of(50, kChannels.settings));
  for (int i = 0; i < 15; ++i) EXPECT_TRUE(files.write(event_of(100'000).view(), Time{}));
  files.end_file();
  const auto paths = files_in(folder.path());
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths.front().filename(), "stairway-000001-20231114T221320Z.lcm");
  std::size_t scans = 0;
  for (const auto& path : paths) {
    EXPECT_LE(std::filesystem::file_size(path), 1'000'000u);
    const auto events = read_all(path);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().channel, kChannels.settings);
    scans += events.size() - 1;
  }
  EXPECT_EQ(scans, 15u);
  EXPECT_EQ(files.events(), 17u);
  EXPECT_EQ(files.lost_events(), 0u);
}

TEST(RecordingFiles, old_file_is_continued_in_a_new_one) {
  const test::TemporaryFolder folder;
  RecordOptions options = options_in(folder);
  options.max_file_s = 10.0;
  RecordingFiles files(options, "stairway");
  for (int s = 0; s < 25; ++s) files.write(event_of(10).view(), Time{} + std::chrono::seconds(s));
  EXPECT_EQ(files_in(folder.path()).size(), 3u);
}

TEST(RecordingFiles, oldest_recordings_go_and_other_files_stay) {
  const test::TemporaryFolder folder;
  test::write_text(folder.path("notes.txt"), std::string(5'000'000, 'x'));
  test::write_text(folder.path("stairway-mine.lcm"), "x");
  test::write_text(folder.path("stairway-000041-20200101T000000Z.lcm"), std::string(900'000, 'x'));
  RecordingFiles files(options_in(folder), "stairway");
  for (int i = 0; i < 60; ++i) {
    EXPECT_TRUE(files.write(event_of(100'000).view(), Time{}));
    std::uintmax_t bytes = 0;
    for (const auto& path : files_in(folder.path()))
      if (path.filename().string().starts_with("stairway-0")) bytes += std::filesystem::file_size(path);
    ASSERT_LE(bytes, 3'000'000u);
  }
  const auto paths = files_in(folder.path());
  ASSERT_EQ(paths.size(), 5u);
  EXPECT_EQ(paths[0].filename(), "notes.txt");
  EXPECT_TRUE(paths[1].filename().string().starts_with("stairway-000046-")) << paths[1];
  EXPECT_EQ(paths[4].filename(), "stairway-mine.lcm");
}

TEST(RecordingFiles, folder_that_cannot_be_made_is_told_and_tried_again) {
  const test::TemporaryFolder folder;
  test::write_text(folder.path("recordings"), "a file in the way");
  RecordOptions options = options_in(folder);
  options.folder = folder.path("recordings");
  RecordingFiles files(options, "stairway");
  EXPECT_FALSE(files.write(event_of(10).view(), Time{} + 1s));
  EXPECT_NE(files.trouble().find(options.folder), std::string::npos);
  std::filesystem::remove(options.folder);
  EXPECT_FALSE(files.write(event_of(10).view(), Time{} + 3s)) << "it waits before it tries again";
  EXPECT_TRUE(files.write(event_of(10).view(), Time{} + 7s));
  EXPECT_EQ(files.trouble(), "");
  EXPECT_EQ(files.lost_events(), 2u);
}

TEST(RecordingFiles, disk_with_too_little_space_left_is_not_filled_up) {
  const test::TemporaryFolder folder;
  RecordOptions options = options_in(folder);
  options.min_free_mb = 1'000'000'000;
  RecordingFiles files(options, "stairway");
  EXPECT_FALSE(files.write(event_of(10).view(), Time{} + 1s));
  EXPECT_NE(files.trouble().find("less than 1000000000 MB left"), std::string::npos) << files.trouble();
  EXPECT_TRUE(files_in(folder.path()).empty());
}

// Seen by this process alone, and gone with it.
bool mount_small_disk(const std::filesystem::path& path) {
  return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", path.c_str(), "tmpfs", 0, "size=1m") == 0;
}

TEST(RecordingFiles, full_disk_leaves_whole_events_and_recording_goes_on_when_there_is_room) {
  const test::TemporaryFolder folder;
  if (!mount_small_disk(folder.path())) GTEST_SKIP() << "needs root, to mount";
  {
    test::write_text(folder.path("ballast"), std::string(600'000, 'x'));
    RecordingFiles files(options_in(folder), "stairway");
    Time now = Time{} + 1s;
    int lost = 0;
    for (int i = 0; i < 100; ++i) {
      lost += files.write(event_of(10'000).view(), now) ? 0 : 1;
      files.keep_up(now);
    }
    EXPECT_GT(lost, 50);
    EXPECT_NE(files.trouble().find("No space left on device"), std::string::npos) << files.trouble();
    const auto full = files.path();
    const std::size_t whole = read_all(full).size();
    EXPECT_GT(whole, 20u);
    EXPECT_EQ(files.events(), whole);
    EXPECT_EQ(files.lost_events(), 100 - whole);

    std::filesystem::remove(folder.path("ballast"));
    now += 10s;
    EXPECT_TRUE(files.write(event_of(10'000).view(), now));
    files.end_file();
    EXPECT_EQ(files.trouble(), "");
    EXPECT_NE(files.path(), full);
    EXPECT_EQ(read_all(files.path()).size(), 1u);
  }
  ::umount(folder.path().c_str());
}

template <class Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

TEST(Recorder, everything_is_in_the_file_in_its_order_without_closing) {
  const test::TemporaryFolder folder;
  Recorder recorder(options_in(folder), kChannels);
  for (int i = 0; i < 500; ++i) recorder.add(i % 10 == 0 ? kChannels.disk : kChannels.scan, event_of(200).bytes, i);
  ASSERT_TRUE(comes_true([&] { return recorder.status().events == 500; }));
  const auto events = read_all(recorder.status().file);
  ASSERT_EQ(events.size(), 500u);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(events[static_cast<std::size_t>(i)].utime_us, i);
  EXPECT_EQ(recorder.status().lost_events, 0u);
}

TEST(Recorder, bytes_of_devices_are_recorded_only_when_asked_for) {
  for (const bool raw : {false, true}) {
    const test::TemporaryFolder folder;
    RecordOptions options = options_in(folder);
    options.raw = raw;
    Recorder recorder(options, kChannels);
    recorder.add(kChannels.raw, event_of(10).bytes, 1);
    recorder.add(kChannels.scan, event_of(10).bytes, 2);
    recorder.close();
    EXPECT_EQ(recorder.status().events, raw ? 2u : 1u);
  }
}

TEST(Recorder, a_disk_in_trouble_keeps_nobody_waiting_and_what_is_lost_is_counted) {
  const test::TemporaryFolder folder;
  test::write_text(folder.path("recordings"), "a file in the way");
  RecordOptions options = options_in(folder);
  options.folder = folder.path("recordings");
  Recorder recorder(options, kChannels);
  for (int i = 0; i < 50; ++i) recorder.add(kChannels.scan, event_of(1'000'000).bytes, i);
  EXPECT_TRUE(comes_true([&] { return recorder.status().lost_events == 50; }));
  EXPECT_NE(recorder.status().trouble, "");
}

// Scans of a sweep that lasts a second, then a preview and its answer.
void add_sweep(Recorder& recorder, std::int64_t sweep) {
  const std::int64_t start_us = 1'000'000 * (sweep + 1);
  for (int i = 0; i < 40; ++i) {
    ScanMessage scan;
    scan.utime_us = start_us + 25'000 * i;
    recorder.add(kChannels.scan, encode(scan), scan.utime_us);
  }
  StairwaysMessage answer;
  answer.sweep = sweep;
  answer.sweep_start_utime_us = start_us;
  answer.is_final = false;
  recorder.add(kChannels.stairways, encode(answer), start_us + 500'000);
  answer.is_final = true;
  answer.utime_us = start_us + 1'000'000;
  recorder.add(kChannels.stairways, encode(answer), answer.utime_us);
}

TEST(Recorder, snapshot_holds_the_settings_and_the_last_sweeps) {
  const test::TemporaryFolder folder;
  RecordOptions options = options_in(folder, RecordMode::Snapshot);
  options.snapshot_sweeps = 2;
  Recorder recorder(options, kChannels);
  recorder.add(kChannels.settings, encode(SettingsMessage{1, "1", "x"}), 1);
  for (std::int64_t sweep = 0; sweep < 5; ++sweep) add_sweep(recorder, sweep);
  // What is kept reaches back as far as the angles that the oldest scans need.
  ASSERT_TRUE(comes_true([&] { return recorder.status().events == 2 * 42 + 8 + 2; }));
  EXPECT_TRUE(files_in(folder.path()).empty());
  ASSERT_TRUE(recorder.request_snapshot());
  ASSERT_TRUE(comes_true([&] { return recorder.status().snapshots == 1; }));
  const auto events = read_all(recorder.status().file);
  ASSERT_EQ(events.size(), 2u * 42 + 8 + 2 + 1);
  EXPECT_EQ(events.front().channel, kChannels.settings);
  EXPECT_EQ(decode<StairwaysMessage>(events.back().bytes)->sweep, 4);
  EXPECT_TRUE(recorder.status().file.filename().string().starts_with("snapshot-000001-"));
}

TEST(Recorder, snapshot_is_bounded_in_memory_even_if_no_sweep_ends) {
  SnapshotRing ring(kChannels, 3, 100'000);
  for (int i = 0; i < 1000; ++i) ring.add(event_of(1000));
  EXPECT_LE(ring.bytes(), 100'000u);
  EXPECT_GT(ring.events().size(), 90u);
}

TEST(Recorder, everything_is_recorded_already_when_there_is_no_snapshot_to_take) {
  const test::TemporaryFolder folder;
  Recorder recorder(options_in(folder), kChannels);
  EXPECT_FALSE(recorder.request_snapshot());
}

}  // namespace
}  // namespace stairway::ipc
