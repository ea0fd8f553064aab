// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>

#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tools/doctor/lcm.hpp"

namespace stairway::doctor {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::string_view kUdpm = "udpm://";
constexpr auto kStep = milliseconds(100);

template <typename Number>
bool read_number(std::string_view text, Number min, Number max, Number& value, int base = 10) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
}

/// Takes what stands before `mark` off the text; all of it when there is none.
std::string_view take_until(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return taken;
}

bool take_option(std::string_view option, UdpmUrl& url) {
  const std::string_view key = take_until(option, '=');
  if (key == "ttl") return read_number(option, 0, 255, url.ttl);
  constexpr std::int64_t kMaxBuffer = std::int64_t{1} << 31;
  if (key == "recv_buf_size") return read_number(option, std::int64_t{0}, kMaxBuffer, url.receive_buffer_bytes);
  return true;
}

std::optional<std::uint32_t> ipv4(const std::string& address) {
  in_addr parsed{};
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1) return std::nullopt;
  return parsed.s_addr;
}

/// The interface of the longest prefix in /proc/net/route that holds the address.
std::optional<std::string> find_route(const Machine& machine, std::uint32_t address) {
  std::optional<std::string> best;
  std::uint32_t best_mask = 0;
  for (const std::string& line : machine.lines("/proc/net/route")) {
    std::istringstream words(line);
    std::array<std::string, 8> columns;
    for (std::string& column : columns) words >> column;
    std::uint32_t target = 0, mask = 0;
    const auto read_hex = [](const std::string& text, std::uint32_t& value) {
      return read_number<std::uint32_t>(text, 0, UINT32_MAX, value, 16);
    };
    if (!read_hex(columns[1], target) || !read_hex(columns[7], mask) || (address & mask) != target) continue;
    if (best && ntohl(mask) < ntohl(best_mask)) continue;
    best = columns[0];
    best_mask = mask;
  }
  return best;
}

}  // namespace

bool UdpmUrl::is_multicast() const {
  const auto bits = ipv4(address);
  return bits && (ntohl(*bits) >> 28) == 0xE;
}

std::optional<UdpmUrl> parse_udpm_url(std::string_view text) {
  if (!text.starts_with(kUdpm)) return std::nullopt;
  text.remove_prefix(kUdpm.size());
  std::string_view place = take_until(text, '?');
  UdpmUrl url;
  const std::string_view address = take_until(place, ':');
  if (!address.empty()) url.address = address;
  if (!place.empty() && !read_number(place, 1, 65535, url.port)) return std::nullopt;
  while (!text.empty()) {
    if (!take_option(take_until(text, '&'), url)) return std::nullopt;
  }
  return ipv4(url.address) ? std::optional(url) : std::nullopt;
}

LcmFacts look_at_lcm(const Machine& machine, const std::string& url) {
  LcmFacts facts{.url = url};
  if (const auto udpm = parse_udpm_url(url)) facts.route = find_route(machine, *ipv4(udpm->address));
  facts.default_buffer_bytes = machine.number("/proc/sys/net/core/rmem_default");
  facts.max_buffer_bytes = machine.number("/proc/sys/net/core/rmem_max");
  return facts;
}

BusFacts listen_on_bus(const ipc::BusOptions& options, milliseconds patience) {
  BusFacts facts;
  const auto bus = ipc::LcmBus::open(options.url);
  const std::string own_channel = options.channel_prefix + "DOCTOR";
  const auto on_own = [&](const ipc::BusMessage&) { facts.is_own_message_heard = true; };
  const auto on_health = [&](const ipc::BusMessage& message) {
    auto health = ipc::decode<ipc::HealthMessage>(message.bytes);
    if (health) facts.health = std::move(*health);
    if (!health) ++facts.undecodable;
  };
  const auto note = [&](const tl::expected<void, ipc::BusError>& done) {
    if (!done) facts.error = done.error().text;
    return done.has_value();
  };
  if (!bus) {
    facts.error = bus.error().text;
    return facts;
  }
  constexpr std::array<std::uint8_t, 8> kMessage{};
  if (!note((*bus)->subscribe(own_channel, on_own)) ||
      !note((*bus)->subscribe(ipc::Channels(options.channel_prefix).health, on_health)) ||
      !note((*bus)->publish(own_channel, kMessage))) {
    return facts;
  }
  for (const auto end = Clock::now() + patience; Clock::now() < end;) {
    if (facts.is_own_message_heard && facts.health) break;
    const auto handled = (*bus)->handle(kStep);
    if (!handled) break;
  }
  return facts;
}

}  // namespace stairway::doctor
