// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpio/line_wait.hpp"

#include <poll.h>

#include <algorithm>
#include <array>

namespace stairway::drivers {

bool wait_for_lines(std::span<const int> fds, std::chrono::nanoseconds timeout) {
  std::array<pollfd, 8> waits{};
  const std::size_t count = std::min(fds.size(), waits.size());
  for (std::size_t i = 0; i < count; ++i) waits[i] = {fds[i], POLLIN | POLLPRI, 0};
  const auto wait_ns = std::max<std::chrono::nanoseconds::rep>(0, timeout.count());
  const timespec limit{wait_ns / 1'000'000'000, wait_ns % 1'000'000'000};
  // Interrupted by a signal is as good as waited: whoever reads then finds what there is.
  if (::ppoll(waits.data(), count, &limit, nullptr) <= 0) return true;
  return std::ranges::none_of(std::span(waits).first(count),
                              [](const pollfd& wait) { return (wait.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0; });
}

}  // namespace stairway::drivers
