// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/doctor/encoder.hpp"

namespace stairway::doctor {
namespace {

Check judge_chip(const EncoderFacts& facts) {
  constexpr const char* kName = "encoder";
  if (facts.node.exists) return ok(kName, facts.node.path);
  if (facts.chips.empty()) {
    return failure(kName, "no GPIO chip on this machine (/dev/gpiochip*)",
                   "load the driver of the board's GPIO, or set disk.angle_source to drive");
  }
  return failure(kName, facts.refusal, "change encoder.chip; gpiodetect lists chips and their labels");
}

Check judge_access(const EncoderFacts& facts, const Caller& caller) {
  constexpr const char* kName = "encoder-access";
  const NodeFacts& node = facts.node;
  if (node.group != "gpio" || !node.is_open_to_group) {
    return failure(kName, fmt::format("{} belongs to group {}, not gpio", node.path, node.group),
                   "install 60-stairway.rules, then udevadm control --reload && udevadm trigger");
  }
  if (!node.is_usable && !caller.is_root) {
    return warning(kName,
                   fmt::format("{} is open to group gpio, which you are {}", node.path,
                               caller.is_in("gpio") ? "in, but may not use it" : "not in"),
                   "stairwayd may use it; for yourself: usermod -aG gpio USER, then log in again");
  }
  return ok(kName, node.path + " is open to group gpio");
}

Check judge_lines(const EncoderFacts& facts, bool has_daemon) {
  constexpr const char* kName = "encoder-lines";
  if (!facts.refusal.empty()) {
    return failure(kName, facts.refusal, "change encoder.line_a, line_b or line_index; gpioinfo lists the lines");
  }
  std::string text;
  for (const LineFacts& line : facts.lines) {
    if (line.is_used && !(has_daemon && line.consumer == "stairwayd")) {
      return failure(kName,
                     fmt::format("line {} ({}) is taken by {}", line.offset, line.signal,
                                 line.consumer.empty() ? "the kernel" : line.consumer),
                     "end that program, or remove that driver or overlay from the board's set-up");
    }
    text += fmt::format("{}{} on {}", text.empty() ? "" : ", ", line.signal, line.offset);
    if (!line.name.empty()) text += fmt::format(" ({})", line.name);
  }
  return ok(kName, text);
}

}  // namespace

std::vector<Check> judge(const EncoderFacts& facts, const Caller& caller, bool has_daemon) {
  std::vector<Check> checks{judge_chip(facts)};
  if (!facts.node.exists) return checks;
  checks.push_back(judge_access(facts, caller));
  checks.push_back(judge_lines(facts, has_daemon));
  return checks;
}

Check judge(const CountFacts& facts) {
  constexpr const char* kName = "encoder-counts";
  const std::string text =
      fmt::format("A {} ({} edges), B {} ({} edges), index {} edges in {:.1f} s", facts.levels.a ? "high" : "low",
                  facts.a_edges, facts.levels.b ? "high" : "low", facts.b_edges, facts.index_edges, facts.duration_s);
  if (facts.is_broken) return failure(kName, text + ", then the lines failed", "look at dmesg");
  if (facts.lost_edges > 0) {
    return warning(kName, fmt::format("{}, {} lost", text, facts.lost_edges),
                   "turn slower, or use the kernel's larger queue (see the rates in docs/hardware.md)");
  }
  const std::uint64_t fewer = std::min(facts.a_edges, facts.b_edges), more = std::max(facts.a_edges, facts.b_edges);
  // Half a turn of noise on one line is as good as none on the other.
  if (more >= 8 && fewer * 4 < more) {
    return failure(kName, text, "one of A and B does not follow: check its wire, its level and the line's number");
  }
  if (!facts.rate_problem.empty()) {
    return warning(kName, fmt::format("{}; at the speed of disk.period_s, {}", text, facts.rate_problem),
                   "see the rates in docs/hardware.md");
  }
  if (more == 0) return ok(kName, text + "; turn the disk by hand to see them count");
  return ok(kName, text);
}

}  // namespace stairway::doctor
