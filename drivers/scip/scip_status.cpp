// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_status.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stairway::drivers {
namespace {

constexpr std::size_t kStatusLength = 2;

struct Meaning {
  std::string_view symbols;  // two characters each; empty for every command
  std::string_view first, last;
  std::string_view text;
};

constexpr std::string_view kScans = "MDMSMEGDGSGE";
constexpr std::array kMeanings{
    Meaning{"", "00", "00", "good"},
    Meaning{"", "99", "99", "good, with a scan"},
    Meaning{"BM", "01", "01", "the laser does not work"},
    Meaning{"BM", "02", "02", "the laser is on already"},
    Meaning{"TM", "01", "01", "not a time command"},
    Meaning{"TM", "02", "02", "in time adjustment already"},
    Meaning{"TM", "03", "03", "not in time adjustment"},
    Meaning{"TM", "04", "04", "asked for the time outside of time adjustment"},
    Meaning{kScans, "01", "01", "first step is not a number"},
    Meaning{kScans, "02", "02", "last step is not a number"},
    Meaning{kScans, "03", "03", "cluster is not a number"},
    Meaning{kScans, "04", "04", "last step out of range"},
    Meaning{kScans, "05", "05", "last step below the first"},
    Meaning{kScans, "06", "06", "scans to skip are not a number"},
    Meaning{kScans, "07", "07", "number of scans is not a number"},
    Meaning{"GDGSGE", "10", "10", "the laser is off"},
    Meaning{kScans, "21", "49", "the sensor checks itself"},
    Meaning{kScans, "50", "97", "the laser or the motor is out of order"},
    Meaning{kScans, "98", "98", "the sensor has checked itself"},
    Meaning{"CR", "04", "04", "this sensor cannot change its motor's speed"},
    Meaning{"HS", "03", "03", "this sensor has no high sensitivity"},
    Meaning{"SS", "03", "03", "has this bit rate already"},
    Meaning{"SS", "04", "04", "this sensor does not have this bit rate"},
    Meaning{"RB", "01", "01", "asked once of twice"},
    Meaning{"", "10", "10", "not in this state"},
    Meaning{"", "0A", "0A", "the sensor could not make a reply"},
    Meaning{"", "0B", "0B", "the sensor's buffer is full, or the command was repeated"},
    Meaning{"", "0C", "0C", "parameters missing"},
    Meaning{"", "0D", "0D", "not defined, or too long"},
    Meaning{"", "0E", "0E", "unknown command"},
    Meaning{"", "0F", "0F", "parameters missing"},
    Meaning{"", "0G", "0G", "string too long"},
    Meaning{"", "0H", "0H", "bad character in the string"},
    Meaning{"", "0I", "0I", "firmware is being updated"},
    Meaning{"", "0L", "0L", "abnormal state"},
};

bool concerns(const Meaning& meaning, std::string_view symbol) {
  if (meaning.symbols.empty()) return true;
  if (symbol.size() < 2) return false;
  for (std::size_t at = 0; at < meaning.symbols.size(); at += 2) {
    if (meaning.symbols.substr(at, 2) == symbol.substr(0, 2)) return true;
  }
  return false;
}

bool is_between(std::string_view status, std::string_view low, std::string_view high) {
  return status.size() == kStatusLength && status >= low && status <= high;
}

}  // namespace

StatusKind status_kind(std::string_view symbol, std::string_view status) {
  if (status == "00" || status == "99") return StatusKind::Ok;
  if (status == "0D" || status == "0E") return StatusKind::Unknown;
  if (symbol.starts_with("BM")) return status == "01" ? StatusKind::Fault : StatusKind::Refused;
  if (!symbol.starts_with('M')) return StatusKind::Refused;
  if (is_between(status, "21", "49")) return StatusKind::SelfCheck;
  if (is_between(status, "50", "97")) return StatusKind::Fault;
  return status == "98" ? StatusKind::Resumed : StatusKind::Refused;
}

std::string describe_status(std::string_view symbol, std::string_view status) {
  const std::string name(status.substr(0, kStatusLength));
  const auto meaning = std::ranges::find_if(
      kMeanings, [&](const Meaning& one) { return is_between(status, one.first, one.last) && concerns(one, symbol); });
  return meaning == kMeanings.end() ? name : name + " (" + std::string(meaning->text) + ")";
}

}  // namespace stairway::drivers
