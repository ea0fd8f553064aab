// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/nearest_key.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace stairway::config {
namespace {

constexpr std::size_t kMaxKeyLength = 100;  // bounds the work for texts that are no key at all

/// Levenshtein's distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }

}  // namespace

std::string nearest_key(std::string_view key, const std::vector<Entry>& table) {
  if (key.size() > kMaxKeyLength) return {};
  std::string nearest;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  const std::size_t allowed = std::max<std::size_t>(2, last_part(key).size() / 3);
  for (const Entry& entry : table) {
    const std::size_t elsewhere = edits(last_part(key), last_part(entry.key)) + 1;  // so that the own section wins
    const std::size_t distance = std::min(edits(key, entry.key), elsewhere);
    if (distance > allowed || distance >= fewest) continue;
    nearest = entry.key;
    fewest = distance;
  }
  return nearest;
}

}  // namespace stairway::config
