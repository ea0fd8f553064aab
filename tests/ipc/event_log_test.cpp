// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include "ipc/recording/event_log_reader.hpp"
#include "ipc/recording/event_log_writer.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway::ipc {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kEvents = 8;

StoredEvent sample(int i) {
  StoredEvent event{1'000'000 + 25'000 * i, i % 2 == 0 ? "STAIRWAY_SCAN" : "STAIRWAY_DISK", {}};
  for (int k = 0; k < 40 + 3 * i; ++k) event.bytes.push_back(static_cast<std::uint8_t>(17 * k + i));
  return event;
}

// The offsets where events begin, and the end.
struct Log {
  Bytes bytes;
  std::vector<std::size_t> offsets;
};

Log sample_log() {
  Log log;
  for (int i = 0; i < kEvents; ++i) {
    log.offsets.push_back(log.bytes.size());
    append_log_event(log.bytes, sample(i).view(i));
  }
  log.offsets.push_back(log.bytes.size());
  return log;
}

struct Parsed {
  std::vector<std::int64_t> whole;  // the numbers of the events that came out as they went in
  std::size_t changed = 0;
  LogDamage damage;
};

Parsed parse(std::span<const std::uint8_t> bytes, std::size_t piece = 7) {
  EventLogParser parser;
  Parsed parsed;
  const auto take_all = [&] {
    while (const auto event = parser.next()) {
      const StoredEvent sent = sample(static_cast<int>(std::clamp<std::int64_t>(event->number, 0, kEvents)));
      const bool is_whole = event->channel == sent.channel && std::ranges::equal(event->bytes, sent.bytes) &&
                            event->utime_us == sent.utime_us;
      if (is_whole) parsed.whole.push_back(event->number);
      parsed.changed += is_whole ? 0 : 1;
    }
  };
  for (std::size_t i = 0; i < bytes.size(); i += piece) {
    parser.feed(bytes.subspan(i, std::min(piece, bytes.size() - i)));
    take_all();
  }
  parser.end();
  take_all();
  parsed.damage = parser.damage();
  return parsed;
}

std::vector<std::int64_t> up_to(int events) {
  std::vector<std::int64_t> numbers;
  for (int i = 0; i < events; ++i) numbers.push_back(i);
  return numbers;
}

TEST(EventLog, event_stands_in_the_file_as_lcm_documents_it) {
  Bytes bytes;
  const std::string text = "0123456789";
  append_log_event(bytes, {0, 0x000660db3d37503a, "CHAN", {reinterpret_cast<const std::uint8_t*>(text.data()), 10}});
  const Bytes wanted{0xed, 0xa1, 0xda, 0x01, 0,    0,    0,   0,   0,   0,   0,   0,   0,   0x06,
                     0x60, 0xdb, 0x3d, 0x37, 0x50, 0x3a, 0,   0,   0,   4,   0,   0,   0,   10,
                     'C',  'H',  'A',  'N',  '0',  '1',  '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(bytes, wanted);
}

TEST(EventLog, pieces_of_any_size_give_the_same_events) {
  const Log log = sample_log();
  for (const std::size_t piece : {std::size_t{1}, std::size_t{28}, std::size_t{64}, log.bytes.size()}) {
    SCOPED_TRACE(piece);
    const Parsed parsed = parse(log.bytes, piece);
    EXPECT_EQ(parsed.whole, up_to(kEvents));
    EXPECT_FALSE(parsed.damage.is_any());
  }
}

TEST(EventLog, cut_anywhere_it_is_read_up_to_the_last_whole_event_and_the_tear_is_told) {
  const Log log = sample_log();
  for (std::size_t size = log.offsets[kEvents - 2]; size <= log.bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const Parsed parsed = parse(std::span(log.bytes).first(size));
    const auto whole = std::ranges::upper_bound(log.offsets, size) - log.offsets.begin() - 1;
    EXPECT_EQ(parsed.whole, up_to(static_cast<int>(whole)));
    EXPECT_EQ(parsed.changed, 0u);
    EXPECT_EQ(parsed.damage.torn_bytes, size - log.offsets[static_cast<std::size_t>(whole)]);
    EXPECT_EQ(parsed.damage.places, 0u);
  }
}

TEST(EventLog, tail_of_zeros_as_after_a_power_loss_is_a_tear) {
  Log log = sample_log();
  log.bytes.resize(log.bytes.size() + 5000, 0);
  const Parsed parsed = parse(log.bytes);
  EXPECT_EQ(parsed.whole, up_to(kEvents));
  EXPECT_EQ(parsed.damage.torn_bytes, 5000u);
}

TEST(EventLog, changed_byte_costs_the_event_it_is_in_and_no_other) {
  const Log log = sample_log();
  for (std::size_t place = 0; place < log.bytes.size(); ++place) {
    for (const int flip : {0x01, 0x40, 0xff}) {
      SCOPED_TRACE(testing::Message() << "byte " << place << " flip " << flip);
      Bytes bytes = log.bytes;
      bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ flip);
      const Parsed parsed = parse(bytes);
      const auto damaged = std::ranges::upper_bound(log.offsets, place) - log.offsets.begin() - 1;
      for (int i = 0; i < kEvents; ++i) {
        if (i != damaged) {
          EXPECT_TRUE(std::ranges::count(parsed.whole, i) == 1) << "event " << i;
        }
      }
      EXPECT_LE(parsed.changed, 1u);
    }
  }
}

TEST(EventLog, damaged_head_is_passed_over_and_counted) {
  const Log log = sample_log();
  Bytes bytes = log.bytes;
  bytes[log.offsets[3]] ^= 0xff;
  bytes[log.offsets[5] + 25] ^= 0x10;  // a length of over a megabyte
  const Parsed parsed = parse(bytes);
  EXPECT_EQ(parsed.whole, (std::vector<std::int64_t>{0, 1, 2, 4, 6, 7}));
  EXPECT_EQ(parsed.damage.places, 2u);
  EXPECT_EQ(parsed.damage.lost_events, 2u);
  EXPECT_EQ(parsed.damage.skipped_bytes, log.offsets[4] - log.offsets[3] + log.offsets[6] - log.offsets[5]);
}

TEST(EventLog, numbers_of_any_size_are_no_gap) {
  Bytes bytes;
  for (const std::int64_t number : {std::numeric_limits<std::int64_t>::min(), std::int64_t{2},
                                    std::numeric_limits<std::int64_t>::max(), std::int64_t{-1}})
    append_log_event(bytes, sample(0).view(number));
  EventLogParser parser;
  parser.feed(bytes);
  parser.end();
  int events = 0;
  while (parser.next()) ++events;
  EXPECT_EQ(events, 4);
  EXPECT_EQ(parser.damage().lost_events, 0u);
}

TEST(EventLog, bytes_without_any_event_give_none) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{27}, std::size_t{5000}}) {
    const Bytes bytes(size, 0xED);
    const Parsed parsed = parse(bytes);
    EXPECT_TRUE(parsed.whole.empty());
    EXPECT_EQ(parsed.damage.torn_bytes, size);
  }
}

TEST(EventLogFile, what_is_written_is_read_by_lcm_and_by_us) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.lcm";
  {
    auto writer = EventLogWriter::create(path);
    ASSERT_TRUE(writer) << writer.error().text;
    for (int i = 0; i < kEvents; ++i) ASSERT_TRUE(writer->append(sample(i).view(999)));
    ASSERT_TRUE(writer->sync());
    EXPECT_EQ(writer->bytes(), std::filesystem::file_size(path));
  }
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  ASSERT_NE(log, nullptr);
  for (int i = 0; i < kEvents; ++i) {
    lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log);
    ASSERT_NE(event, nullptr) << i;
    EXPECT_EQ(event->eventnum, i);
    EXPECT_EQ(event->timestamp, sample(i).utime_us);
    EXPECT_EQ(std::string(event->channel), sample(i).channel);
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);

  auto reader = EventLogReader::open(path);
  ASSERT_TRUE(reader);
  int events = 0;
  while (const auto event = reader->next()) {
    EXPECT_EQ(event->number, events);
    EXPECT_TRUE(std::ranges::equal(event->bytes, sample(events).bytes));
    ++events;
  }
  EXPECT_EQ(events, kEvents);
  EXPECT_EQ(describe(reader->damage()), "");
}

TEST(EventLogFile, impossible_events_are_refused_and_the_others_stay) {
  const test::TemporaryFolder folder;
  auto writer = EventLogWriter::create(folder.path() / "a.lcm");
  ASSERT_TRUE(writer);
  EXPECT_FALSE(writer->append({0, 0, "", {}}));
  EXPECT_FALSE(writer->append({0, 0, std::string(64, 'A'), {}}));
  EXPECT_TRUE(writer->append({0, 0, "A", {}}));
  EXPECT_EQ(writer->events(), 1);
}

TEST(EventLogFile, missing_file_and_folder_are_errors_that_name_them) {
  const test::TemporaryFolder folder;
  const auto missing = EventLogReader::open(folder.path() / "none.lcm");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().text.find("none.lcm"), std::string::npos);
  EXPECT_FALSE(EventLogReader::open(folder.path()));
  EXPECT_FALSE(EventLogWriter::create(folder.path() / "none" / "a.lcm"));
  ASSERT_TRUE(EventLogWriter::create(folder.path() / "a.lcm"));
  EXPECT_FALSE(EventLogWriter::create(folder.path() / "a.lcm")) << "an existing file is not written over";
}

}  // namespace
}  // namespace stairway::ipc
