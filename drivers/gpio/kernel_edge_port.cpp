// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpio/kernel_edge_port.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/gpio/line_wait.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

constexpr std::size_t kEventsPerRead = 64;

std::uint64_t flags_of(LineBias bias) {
  constexpr std::uint64_t kEdges =
      GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING;
  if (bias == LineBias::PullUp) return kEdges | GPIO_V2_LINE_FLAG_BIAS_PULL_UP;
  if (bias == LineBias::PullDown) return kEdges | GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN;
  return kEdges;
}

}  // namespace

std::uint64_t take_kernel_events(std::span<const gpio_v2_line_event> events, std::span<const std::uint32_t> offsets,
                                 std::optional<std::uint32_t>& expected, EdgeMerger& merger) {
  std::uint64_t lost = 0;
  for (const gpio_v2_line_event& event : events) {
    if (expected) lost += static_cast<std::uint32_t>(event.seqno - *expected);
    expected = event.seqno + 1;
    const auto line = std::ranges::find(offsets, event.offset);
    if (line == offsets.end()) continue;
    merger.add({static_cast<HostStamp>(event.timestamp_ns), static_cast<EncoderLine>(line - offsets.begin()),
                event.id == GPIO_V2_LINE_EVENT_RISING_EDGE});
  }
  return lost;
}

KernelEdgePort::KernelEdgePort(FileDescriptor request, std::vector<std::uint32_t> offsets, int event_buffer)
    : request_(std::move(request)),
      offsets_(std::move(offsets)),
      queued_edges_(event_buffer / static_cast<int>(offsets_.size())),
      next_number_(1) {}

tl::expected<EdgeBatch, PortError> KernelEdgePort::read(std::chrono::nanoseconds timeout) {
  const int fds[] = {request_.get()};
  if (!wait_for_lines(fds, merger_.is_empty() ? timeout : std::min(timeout, kSettlingWait)))
    return tl::unexpected(PortError::Closed);
  const HostStamp read_ns = monotonic_now_ns();
  std::uint64_t lost = 0;
  if (!read_events(lost)) return tl::unexpected(PortError::Closed);
  EdgeBatch batch = merger_.release(read_ns);
  batch.lost_edges = lost;
  return batch;
}

bool KernelEdgePort::read_events(std::uint64_t& lost) {
  std::array<gpio_v2_line_event, kEventsPerRead> events;
  for (;;) {
    const ssize_t bytes = ::read(request_.get(), events.data(), sizeof(events));
    if (bytes < 0) return errno == EAGAIN || errno == EINTR;
    const std::size_t count = static_cast<std::size_t>(bytes) / sizeof(events[0]);
    lost += take_kernel_events(std::span(events).first(count), offsets_, next_number_, merger_);
    if (count < kEventsPerRead) return true;
  }
}

tl::expected<LineLevels, PortError> KernelEdgePort::levels() {
  gpio_v2_line_values values{};
  values.mask = (1U << offsets_.size()) - 1;
  const HostStamp asked_ns = monotonic_now_ns();
  if (::ioctl(request_.get(), GPIO_V2_LINE_GET_VALUES_IOCTL, &values) != 0) return tl::unexpected(PortError::Closed);
  return LineLevels{asked_ns, monotonic_now_ns(), (values.bits & 1) != 0, (values.bits & 2) != 0, (values.bits & 4) != 0};
}

tl::expected<std::unique_ptr<EdgePort>, std::string> open_kernel_lines(const GpioLines& lines,
                                                                       const EncoderOptions& options) {
  gpio_v2_line_request request{};
  request.num_lines = static_cast<std::uint32_t>(lines.offsets.size());
  std::ranges::copy(lines.offsets, request.offsets);
  std::strncpy(request.consumer, kConsumer, sizeof(request.consumer) - 1);
  request.event_buffer_size = static_cast<std::uint32_t>(options.event_buffer);
  request.config.flags = flags_of(options.bias);
  if (options.debounce_us > 0) {
    request.config.num_attrs = 1;
    request.config.attrs[0].mask = (1U << lines.offsets.size()) - 1;
    request.config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_DEBOUNCE;
    request.config.attrs[0].attr.debounce_period_us = static_cast<std::uint32_t>(options.debounce_us);
  }
  if (::ioctl(lines.chip.get(), GPIO_V2_GET_LINE_IOCTL, &request) != 0)
    return tl::unexpected(refusal_text(lines, errno));
  FileDescriptor fd(request.fd);
  ::fcntl(fd.get(), F_SETFL, ::fcntl(fd.get(), F_GETFL) | O_NONBLOCK);
  return std::make_unique<KernelEdgePort>(std::move(fd), lines.offsets, options.event_buffer);
}

bool has_kernel_lines(const GpioLines& lines) {
  gpio_v2_line_info info{};
  info.offset = lines.offsets.front();
  return ::ioctl(lines.chip.get(), GPIO_V2_GET_LINEINFO_IOCTL, &info) == 0;
}

}  // namespace stairway::drivers
