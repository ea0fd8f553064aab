// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <vector>

#include "stairway/stairways_t.hpp"

int main() {
  stairway::stairways_t sent{};
  sent.utime = 17;
  std::vector<unsigned char> bytes(static_cast<std::size_t>(sent.getEncodedSize()));
  sent.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  stairway::stairways_t heard{};
  const bool is_heard = heard.decode(bytes.data(), 0, static_cast<int>(bytes.size())) > 0 && heard.utime == 17;
  std::puts(is_heard ? "heard" : "not heard");
  return is_heard ? 0 : 1;
}
