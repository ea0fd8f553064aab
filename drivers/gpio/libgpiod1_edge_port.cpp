// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>

#include "drivers/gpio/edge_merger.hpp"
#include "drivers/gpio/libgpiod_edge_port.hpp"
#include "drivers/gpio/line_wait.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

constexpr int kQueue = 16;  // of the kernel, for each line

struct ChipCloser {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, ChipCloser>;

int flags_of(LineBias bias) {
  if (bias == LineBias::PullUp) return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  if (bias == LineBias::PullDown) return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  return 0;
}

HostStamp to_ns(const timespec& time) { return time.tv_sec * HostStamp{1'000'000'000} + time.tv_nsec; }

// Kernels before 5.7 stamp edges with the time of day.
HostStamp to_monotonic(HostStamp stamp_ns, HostStamp now_ns) {
  constexpr HostStamp kFuture_ns = 1'000'000'000;
  if (stamp_ns < now_ns + kFuture_ns) return stamp_ns;
  timespec day{};
  ::clock_gettime(CLOCK_REALTIME, &day);
  return stamp_ns - to_ns(day) + now_ns;
}

class Libgpiod1EdgePort : public EdgePort {
 public:
  Libgpiod1EdgePort(Chip chip, const gpiod_line_bulk& lines) : chip_(std::move(chip)), lines_(lines) {
    for (unsigned i = 0; i < lines_.num_lines; ++i) {
      fds_[i] = gpiod_line_event_get_fd(lines_.lines[i]);
      ::fcntl(fds_[i], F_SETFL, ::fcntl(fds_[i], F_GETFL) | O_NONBLOCK);
    }
  }
  ~Libgpiod1EdgePort() override { gpiod_line_release_bulk(&lines_); }
  Libgpiod1EdgePort(const Libgpiod1EdgePort&) = delete;
  Libgpiod1EdgePort& operator=(const Libgpiod1EdgePort&) = delete;

  tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds timeout) override {
    const auto fds = std::span(fds_).first(lines_.num_lines);
    if (!wait_for_lines(fds, merger_.is_empty() ? timeout : std::min(timeout, kSettlingWait)))
      return tl::unexpected(PortError::Closed);
    const HostStamp read_ns = monotonic_now_ns();
    for (std::size_t i = 0; i < fds.size(); ++i) {
      if (!read_line(fds[i], static_cast<EncoderLine>(i), read_ns)) return tl::unexpected(PortError::Closed);
    }
    return merger_.release(read_ns);
  }

  tl::expected<LineLevels, PortError> levels() override {
    std::array<int, 3> values{};
    const HostStamp asked_ns = monotonic_now_ns();
    if (gpiod_line_get_value_bulk(&lines_, values.data()) != 0) return tl::unexpected(PortError::Closed);
    return LineLevels{asked_ns, monotonic_now_ns(), values[0] == 1, values[1] == 1, values[2] == 1};
  }

  int queued_edges() const override { return kQueue; }

 private:
  bool read_line(int fd, EncoderLine line, HostStamp now_ns) {
    std::array<gpiod_line_event, kQueue> events;
    for (;;) {
      const int count = gpiod_line_event_read_fd_multiple(fd, events.data(), kQueue);
      if (count < 0) return errno == EAGAIN || errno == EINTR;
      for (const gpiod_line_event& event : std::span(events).first(static_cast<std::size_t>(count)))
        merger_.add({to_monotonic(to_ns(event.ts), now_ns), line, event.event_type == GPIOD_LINE_EVENT_RISING_EDGE});
      if (count < kQueue) return true;
    }
  }

  Chip chip_;
  gpiod_line_bulk lines_;
  std::array<int, 3> fds_{};
  EdgeMerger merger_;
};

}  // namespace

tl::expected<std::unique_ptr<EdgePort>, std::string> open_libgpiod_lines(const GpioLines& lines,
                                                                         const EncoderOptions& options) {
  Chip chip(gpiod_chip_open(lines.path.c_str()));
  if (!chip) return tl::unexpected(refusal_text(lines, errno));
  std::vector<unsigned> offsets(lines.offsets.begin(), lines.offsets.end());
  gpiod_line_bulk bulk = GPIOD_LINE_BULK_INITIALIZER;
  if (gpiod_chip_get_lines(chip.get(), offsets.data(), static_cast<unsigned>(offsets.size()), &bulk) != 0 ||
      gpiod_line_request_bulk_both_edges_events_flags(&bulk, kConsumer, flags_of(options.bias)) != 0)
    return tl::unexpected(refusal_text(lines, errno));
  return std::make_unique<Libgpiod1EdgePort>(std::move(chip), bulk);
}

std::string libgpiod_name() { return std::string("libgpiod ") + gpiod_version_string(); }

}  // namespace stairway::drivers
