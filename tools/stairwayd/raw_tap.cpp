// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/raw_tap.hpp"

#include <memory>
#include <string>
#include <utility>

namespace stairway::daemon {
namespace {

using drivers::BytePort;
using drivers::PortError;

class TappedPort final : public BytePort {
 public:
  TappedPort(std::unique_ptr<BytePort> port, std::function<drivers::HostStamp()> now_ns,
             std::function<void(RawBytes)> sink)
      : port_(std::move(port)), now_ns_(std::move(now_ns)), sink_(std::move(sink)) {}

  tl::expected<drivers::ByteChunk, PortError> read(std::chrono::nanoseconds timeout) override {
    auto chunk = port_->read(timeout);
    if (chunk && !chunk->bytes.empty()) sink_({Device::Scanner, false, chunk->arrival_ns, chunk->bytes});
    return chunk;
  }

  tl::expected<void, PortError> write(std::string_view bytes) override {
    auto written = port_->write(bytes);
    if (written) sink_({Device::Scanner, true, now_ns_(), std::string(bytes)});
    return written;
  }

 private:
  std::unique_ptr<BytePort> port_;
  std::function<drivers::HostStamp()> now_ns_;
  std::function<void(RawBytes)> sink_;
};

}  // namespace

bool is_raw_wanted(const config::Settings& settings) {
  return settings.lcm.raw || (settings.record.raw && settings.record.mode != ipc::RecordMode::Off);
}

drivers::PortOpener<BytePort> with_raw_tap(drivers::PortOpener<BytePort> scanner,
                                           std::function<drivers::HostStamp()> now_ns,
                                           std::function<void(RawBytes)> sink) {
  auto open = [open_scanner = std::move(scanner.open), now_ns = std::move(now_ns),
               sink = std::move(sink)]() -> tl::expected<std::unique_ptr<BytePort>, std::string> {
    auto port = open_scanner();
    if (!port) return tl::unexpected(port.error());
    return std::make_unique<TappedPort>(std::move(*port), now_ns, sink);
  };
  return {std::move(open), std::move(scanner.wait)};
}

}  // namespace stairway::daemon
