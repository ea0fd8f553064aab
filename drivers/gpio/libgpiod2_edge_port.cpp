// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>

#include "drivers/gpio/edge_merger.hpp"
#include "drivers/gpio/libgpiod_edge_port.hpp"
#include "drivers/gpio/line_wait.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

constexpr std::size_t kEventsPerRead = 64;

template <class T, void (*release)(T*)>
struct Releaser {
  void operator()(T* object) const { release(object); }
};
template <class T, void (*release)(T*)>
using Owned = std::unique_ptr<T, Releaser<T, release>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using LineSettings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using Request = Owned<gpiod_line_request, gpiod_line_request_release>;
using EventBuffer = Owned<gpiod_edge_event_buffer, gpiod_edge_event_buffer_free>;

gpiod_line_bias bias_of(LineBias bias) {
  if (bias == LineBias::PullUp) return GPIOD_LINE_BIAS_PULL_UP;
  if (bias == LineBias::PullDown) return GPIOD_LINE_BIAS_PULL_DOWN;
  return GPIOD_LINE_BIAS_AS_IS;
}

class Libgpiod2EdgePort : public EdgePort {
 public:
  Libgpiod2EdgePort(Request request, EventBuffer buffer, std::vector<unsigned> offsets, int event_buffer)
      : request_(std::move(request)),
        buffer_(std::move(buffer)),
        offsets_(std::move(offsets)),
        queued_edges_(event_buffer / static_cast<int>(offsets_.size())) {}

  tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds timeout) override {
    const int fds[] = {gpiod_line_request_get_fd(request_.get())};
    if (!wait_for_lines(fds, merger_.is_empty() ? timeout : std::min(timeout, kSettlingWait)))
      return tl::unexpected(PortError::Closed);
    const HostStamp read_ns = monotonic_now_ns();
    std::uint64_t lost = 0;
    // Reading would wait where nothing is.
    while (gpiod_line_request_wait_edge_events(request_.get(), 0) == 1) {
      const int count = gpiod_line_request_read_edge_events(request_.get(), buffer_.get(), kEventsPerRead);
      if (count < 0) return tl::unexpected(PortError::Closed);
      for (int i = 0; i < count; ++i) lost += take(gpiod_edge_event_buffer_get_event(buffer_.get(), i));
    }
    EdgeBatch batch = merger_.release(read_ns);
    batch.lost_edges = lost;
    return batch;
  }

  tl::expected<LineLevels, PortError> levels() override {
    std::array<gpiod_line_value, 3> values{};
    const HostStamp asked_ns = monotonic_now_ns();
    if (gpiod_line_request_get_values(request_.get(), values.data()) != 0) return tl::unexpected(PortError::Closed);
    const auto is_high = [](gpiod_line_value value) { return value == GPIOD_LINE_VALUE_ACTIVE; };
    return LineLevels{asked_ns, monotonic_now_ns(), is_high(values[0]), is_high(values[1]), is_high(values[2])};
  }

  int queued_edges() const override { return queued_edges_; }

 private:
  std::uint64_t take(gpiod_edge_event* event) {
    // The kernel's numbers have 32 bits, whatever the library makes of them.
    const auto number = static_cast<std::uint32_t>(gpiod_edge_event_get_global_seqno(event));
    const auto lost = static_cast<std::uint32_t>(number - next_number_);
    next_number_ = number + 1;
    const auto line = std::ranges::find(offsets_, gpiod_edge_event_get_line_offset(event));
    if (line == offsets_.end()) return lost;
    merger_.add({static_cast<HostStamp>(gpiod_edge_event_get_timestamp_ns(event)),
                 static_cast<EncoderLine>(line - offsets_.begin()),
                 gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE});
    return lost;
  }

  Request request_;
  EventBuffer buffer_;
  std::vector<unsigned> offsets_;
  int queued_edges_;
  EdgeMerger merger_;
  std::uint32_t next_number_ = 1;
};

}  // namespace

tl::expected<std::unique_ptr<EdgePort>, std::string> open_libgpiod_lines(const GpioLines& lines,
                                                                         const EncoderOptions& options) {
  const Chip chip(gpiod_chip_open(lines.path.c_str()));
  const LineSettings settings(gpiod_line_settings_new());
  const LineConfig config(gpiod_line_config_new());
  const RequestConfig request_config(gpiod_request_config_new());
  EventBuffer buffer(gpiod_edge_event_buffer_new(kEventsPerRead));
  if (!chip || !settings || !config || !request_config || !buffer) return tl::unexpected(refusal_text(lines, errno));

  gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT);
  gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH);
  gpiod_line_settings_set_bias(settings.get(), bias_of(options.bias));
  gpiod_line_settings_set_event_clock(settings.get(), GPIOD_LINE_CLOCK_MONOTONIC);
  gpiod_line_settings_set_debounce_period_us(settings.get(), static_cast<unsigned long>(options.debounce_us));
  std::vector<unsigned> offsets(lines.offsets.begin(), lines.offsets.end());
  if (gpiod_line_config_add_line_settings(config.get(), offsets.data(), offsets.size(), settings.get()) != 0)
    return tl::unexpected(refusal_text(lines, errno));
  gpiod_request_config_set_consumer(request_config.get(), kConsumer);
  gpiod_request_config_set_event_buffer_size(request_config.get(), static_cast<std::size_t>(options.event_buffer));
  Request request(gpiod_chip_request_lines(chip.get(), request_config.get(), config.get()));
  if (!request) return tl::unexpected(refusal_text(lines, errno));
  return std::make_unique<Libgpiod2EdgePort>(std::move(request), std::move(buffer), std::move(offsets),
                                             options.event_buffer);
}

std::string libgpiod_name() { return std::string("libgpiod ") + gpiod_api_version(); }

}  // namespace stairway::drivers
