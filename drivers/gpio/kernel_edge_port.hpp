// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/gpio.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/gpio/edge_merger.hpp"
#include "drivers/gpio/gpio_lines.hpp"

namespace stairway::drivers {

/// What a run of events of one request says: edges, and how many are missing before each by their numbers.
/// @param offsets   of A, B and the index.
/// @param expected  number of the next event; kept up to date, empty before the first.
/// @return How many events are missing. Events of other lines are left out.
std::uint64_t take_kernel_events(std::span<const gpio_v2_line_event> events, std::span<const std::uint32_t> offsets,
                                 std::optional<std::uint32_t>& expected, EdgeMerger& merger);

/// The encoder's lines by version 2 of the kernel's own interface (Linux 5.10): one queue for all lines, of up to 1024
/// edges, and every edge numbered, so that lost ones are known. Stamps are CLOCK_MONOTONIC.
class KernelEdgePort : public EdgePort {
 public:
  /// @param request  the descriptor of a line request with edges in both directions.
  KernelEdgePort(FileDescriptor request, std::vector<std::uint32_t> offsets, int event_buffer);

  tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds timeout) override;
  tl::expected<LineLevels, PortError> levels() override;
  int queued_edges() const override { return queued_edges_; }

 private:
  bool read_events(std::uint64_t& lost);

  FileDescriptor request_;
  std::vector<std::uint32_t> offsets_;
  int queued_edges_;
  EdgeMerger merger_;
  std::optional<std::uint32_t> next_number_;
};

/// A port on the lines, or why there is none and what to do.
tl::expected<std::unique_ptr<EdgePort>, std::string> open_kernel_lines(const GpioLines& lines,
                                                                       const EncoderOptions& options);
/// Whether this kernel has version 2 of the interface.
bool has_kernel_lines(const GpioLines& lines);

}  // namespace stairway::drivers
