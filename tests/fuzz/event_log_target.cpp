// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "ipc/recording/event_log_parser.hpp"
#include "tests/fuzz/targets.hpp"

namespace stairway::fuzz {
namespace {

struct Parsed {
  std::vector<std::vector<std::uint8_t>> events;  // as they would be written
  ipc::LogDamage damage;
};

Parsed parse(std::span<const std::uint8_t> bytes, std::size_t piece) {
  ipc::EventLogParser parser;
  Parsed parsed;
  const auto take = [&] {
    while (const auto event = parser.next()) append_log_event(parsed.events.emplace_back(), *event);
  };
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size()))) {
    parser.feed(bytes.first(std::min(piece, bytes.size())));
    take();
  }
  parser.end();
  take();
  parsed.damage = parser.damage();
  require(!parser.next(), "an ended log gives nothing more");
  return parsed;
}

std::size_t accounted_bytes(const Parsed& parsed) {
  std::size_t bytes = parsed.damage.skipped_bytes + parsed.damage.torn_bytes;
  for (const auto& event : parsed.events) bytes += event.size();
  return bytes;
}

Seed log_of(int events) {
  Seed bytes;
  for (int i = 0; i < events; ++i) {
    const std::vector<std::uint8_t> message(static_cast<std::size_t>(8 + i), static_cast<std::uint8_t>(i));
    ipc::append_log_event(bytes, {i, 1'000'000 + i, "STAIRWAY_SCAN", message});
  }
  return bytes;
}

}  // namespace

void run_event_log(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  const std::size_t piece = 1 + bytes.front();
  const auto log = bytes.subspan(1);
  const Parsed whole = parse(log, std::max<std::size_t>(1, log.size()));
  require(accounted_bytes(whole) == log.size(), "every byte is in an event, passed over, or torn");
  const Parsed pieces = parse(log, piece);
  require(pieces.events == whole.events, "the events do not depend on the pieces");
  require(pieces.damage.places == whole.damage.places && pieces.damage.torn_bytes == whole.damage.torn_bytes,
          "nor does the damage");
}

std::vector<Seed> event_log_seeds() {
  std::vector<Seed> seeds;
  for (const int piece : {0, 27, 255}) {
    Seed seed{static_cast<std::uint8_t>(piece)};
    const Seed log = log_of(4);
    seed.insert(seed.end(), log.begin(), log.end());
    seeds.push_back(seed);
    seed[1 + log.size() / 2] = static_cast<std::uint8_t>(~seed[1 + log.size() / 2]);
    seeds.push_back(seed);
    seed.resize(seed.size() - 5);
    seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace stairway::fuzz
