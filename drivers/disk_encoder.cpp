// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk_encoder.hpp"

#include <algorithm>
#include <utility>

#include "drivers/ports/open_when_due.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kLongestRead = std::chrono::milliseconds(50);  // the period in which a rest is told
constexpr const char* kLost = "the encoder's GPIO lines went away";

}  // namespace

DiskEncoder::DiskEncoder(PortOpener<EdgePort> opener, Clock now, const EncoderOptions& options)
    : opener_(std::move(opener)), now_(std::move(now)), session_(options) {}

std::vector<EncoderEvent> DiskEncoder::poll(nanoseconds timeout) {
  if (!port_) return open(timeout);
  const auto batch = port_->read(std::min(timeout, kLongestRead));
  if (!batch) return lose_port();
  std::vector<EncoderEvent> events = session_.on_edges(*batch);
  if (!session_.wants_levels()) return events;
  const auto levels = port_->levels();
  append(events, levels ? session_.on_levels(*levels) : lose_port());
  return events;
}

std::vector<EncoderEvent> DiskEncoder::open(nanoseconds timeout) {
  std::vector<EncoderEvent> events = open_when_due(port_, opener_, session_, now_, timeout);
  if (!port_) return events;
  const auto levels = port_->levels();
  return levels ? session_.on_open(*levels, port_->queued_edges()) : lose_port();
}

std::vector<EncoderEvent> DiskEncoder::lose_port() {
  port_.reset();
  return session_.on_disconnect(now_(), kLost);
}

}  // namespace stairway::drivers
