// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/channels.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace stairway::ipc {
namespace {

constexpr std::size_t kMaxPrefixLength = 48;  // LCM allows 63 characters in a whole name

// Others would be taken for a pattern by subscribers.
bool is_plain(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '/';
}

}  // namespace

std::string BusOptions::problem() const {
  constexpr std::string_view kProviders[] = {"udpm://", "tcpq://", "file://", "memq://"};
  const auto starts_url = [&](std::string_view provider) { return url.starts_with(provider); };
  if (std::none_of(std::begin(kProviders), std::end(kProviders), starts_url)) {
    return "url must start with udpm://, tcpq://, file:// or memq://, e.g. udpm://239.255.76.67:7667?ttl=0";
  }
  if (channel_prefix.size() > kMaxPrefixLength) return "channel_prefix must have at most 48 characters";
  if (!std::all_of(channel_prefix.begin(), channel_prefix.end(), is_plain)) {
    return "channel_prefix may hold letters, digits, '_', '-' and '/' only";
  }
  return {};
}

}  // namespace stairway::ipc
