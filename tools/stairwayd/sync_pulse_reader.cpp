// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/sync_pulse_reader.hpp"

#include <utility>

namespace stairway::daemon {
namespace {

using drivers::BytePort;
using drivers::PortError;
using std::chrono::nanoseconds;

constexpr drivers::HostStamp kRetry_ns = 10'000'000'000;

class PulsedPort final : public BytePort {
 public:
  PulsedPort(std::unique_ptr<BytePort> port, std::shared_ptr<SyncPulseReader> pulses)
      : port_(std::move(port)), pulses_(std::move(pulses)) {}

  tl::expected<drivers::ByteChunk, PortError> read(nanoseconds timeout) override {
    auto chunk = port_->read(timeout);
    pulses_->drain();
    return chunk;
  }
  tl::expected<void, PortError> write(std::string_view bytes) override { return port_->write(bytes); }

 private:
  std::unique_ptr<BytePort> port_;
  std::shared_ptr<SyncPulseReader> pulses_;
};

}  // namespace

SyncPulseReader::SyncPulseReader(drivers::PortOpener<drivers::EdgePort> opener, Clock now_ns, Sink sink,
                                 Problem problem)
    : opener_(std::move(opener)), now_ns_(std::move(now_ns)), sink_(std::move(sink)), problem_(std::move(problem)) {}

void SyncPulseReader::drain() {
  if (!port_) open();
  if (!port_) return;
  const auto batch = port_->read(nanoseconds::zero());
  if (!batch) {
    port_.reset();
    return problem_("the line of the scanner's sync pulses went away");
  }
  for (const drivers::Edge& edge : batch->edges) {
    if (edge.line == drivers::EncoderLine::A && !edge.is_rising) sink_(edge.stamp_ns);
  }
}

void SyncPulseReader::open() {
  const drivers::HostStamp now_ns = now_ns_();
  if (retry_ns_ && now_ns < *retry_ns_) return;
  retry_ns_ = now_ns + kRetry_ns;
  auto port = opener_.open();
  if (!port) return problem_("the line of the scanner's sync pulses cannot be opened: " + port.error());
  port_ = std::move(*port);
}

drivers::PortOpener<BytePort> with_sync_pulses(drivers::PortOpener<BytePort> scanner,
                                               std::shared_ptr<SyncPulseReader> pulses) {
  auto open = [open_scanner = std::move(scanner.open),
               pulses = std::move(pulses)]() -> tl::expected<std::unique_ptr<BytePort>, std::string> {
    auto port = open_scanner();
    if (!port) return tl::unexpected(port.error());
    return std::make_unique<PulsedPort>(std::move(*port), pulses);
  };
  return {std::move(open), std::move(scanner.wait)};
}

}  // namespace stairway::daemon
