// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/doctor/lcm.hpp"

namespace stairway::doctor {
namespace {

// Half a second of scans and of everything else; the kernel counts its own bookkeeping, too.
constexpr std::int64_t kEnoughBytes = 1'000'000;
constexpr const char* kRouteRemedy =
    "without a network: ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo";

Check judge_url(const LcmFacts& facts, const std::optional<UdpmUrl>& url) {
  constexpr const char* kName = "lcm-url";
  constexpr const char* kExample = "expected e.g. udpm://239.255.76.67:7667?ttl=0";
  if (!facts.url.starts_with("udpm://")) return ok(kName, facts.url);
  if (!url) return failure(kName, facts.url + " cannot be read", kExample);
  if (!url->is_multicast()) return failure(kName, url->address + " is no multicast address", kExample);
  const std::string reach = url->ttl == 0 ? "stays on this host" : fmt::format("crosses {} networks", url->ttl);
  return ok(kName, fmt::format("{}, {}", facts.url, reach));
}

Check judge_route(const LcmFacts& facts, const UdpmUrl& url) {
  if (facts.route) return ok("lcm-route", fmt::format("{} by {}", url.address, *facts.route));
  return failure("lcm-route", "no route to " + url.address, kRouteRemedy);
}

Check judge_buffers(const LcmFacts& facts, const UdpmUrl& url) {
  constexpr const char* kName = "lcm-buffers";
  if (!facts.max_buffer_bytes || !facts.default_buffer_bytes) {
    return skipped(kName, "the kernel does not tell net.core.rmem_max");
  }
  const std::int64_t max_bytes = *facts.max_buffer_bytes;
  const std::string remedy = "install 60-stairway.conf into sysctl.d, or sysctl -w net.core.rmem_max=8388608";
  if (url.receive_buffer_bytes > max_bytes) {
    return warning(
        kName,
        fmt::format("recv_buf_size={} in lcm.url, but net.core.rmem_max={}", url.receive_buffer_bytes, max_bytes),
        remedy);
  }
  if (max_bytes < kEnoughBytes) {
    return warning(kName, fmt::format("net.core.rmem_max={}: listeners lose bursts of messages", max_bytes), remedy);
  }
  return ok(kName, fmt::format("listeners may ask for {} bytes (recv_buf_size in their URL)", max_bytes));
}

Check judge_self_test(const BusFacts& facts) {
  constexpr const char* kName = "lcm-self-test";
  if (!facts.error.empty()) return failure(kName, facts.error, "see lcm-url and lcm-route above");
  if (facts.is_own_message_heard) return ok(kName, "a message came back");
  return failure(kName, "a message did not come back", "does a firewall block multicast? nft list ruleset shows it");
}

std::string dropped(const ipc::HealthMessage& health) {
  std::string text;
  for (const auto& [reason, count] : health.drops) {
    if (count > 0) text += fmt::format(", {} {}", reason, count);
  }
  return text;
}

/// "daemon", then one check for every device that does not do what it is for.
std::vector<Check> judge_health(const ipc::HealthMessage& health) {
  constexpr const char* kRemedy = "journalctl -u stairwayd says since when and why; stairway monitor shows it live";
  const std::string text = fmt::format("{}, {:.1f} scans/s, {:.0f} disk angles/s{}", health.state, health.scan_rate_hz,
                                       health.disk_rate_hz, dropped(health));
  std::vector<Check> checks{health.reasons.empty() ? ok("daemon", text) : warning("daemon", text, kRemedy)};
  for (const ipc::DeviceHealth& device : health.devices) {
    if (device.is_ok) continue;
    std::string name = "daemon-" + device.name;
    std::ranges::replace(name, ' ', '-');
    const std::string age =
        device.data_age_s < 0.0 ? "no data yet" : fmt::format("last data {:.0f} s ago", device.data_age_s);
    checks.push_back(warning(std::move(name),
                             fmt::format("{} ({}), {}, {} troubles", device.state, device.reason, age, device.troubles),
                             kRemedy));
  }
  return checks;
}

Check judge_silence(const BusFacts& facts, const std::vector<ProcessFacts>& daemons) {
  constexpr const char* kName = "daemon";
  if (facts.undecodable > 0) {
    return failure(kName, "its health cannot be read", "have the same version of stairway and stairwayd installed");
  }
  if (daemons.empty()) return skipped(kName, "no stairwayd is running");
  if (!facts.error.empty()) return skipped(kName, to_string(daemons.front()) + " runs, LCM does not");
  return failure(kName, to_string(daemons.front()) + " tells no health",
                 "is its lcm.url the one used here? journalctl -u stairwayd says more");
}

}  // namespace

std::vector<Check> judge(const LcmFacts& facts) {
  const auto url = parse_udpm_url(facts.url);
  std::vector<Check> checks{judge_url(facts, url)};
  if (url && url->is_multicast()) {
    checks.push_back(judge_route(facts, *url));
    checks.push_back(judge_buffers(facts, *url));
  }
  return checks;
}

std::vector<Check> judge(const BusFacts& facts, const std::vector<ProcessFacts>& daemons) {
  std::vector<Check> checks = facts.health ? judge_health(*facts.health) : std::vector{judge_silence(facts, daemons)};
  checks.insert(checks.begin(), judge_self_test(facts));
  return checks;
}

}  // namespace stairway::doctor
