// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <linux/gpio.h>
#include <sys/ioctl.h>

#include <cstring>

#include "drivers/gpio/gpio_lines.hpp"
#include "tools/doctor/encoder.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

template <std::size_t Size>
std::string text_of(const char (&text)[Size]) {
  return {text, ::strnlen(text, Size)};
}

LineFacts look_at_line(int chip, const char* signal, std::uint32_t offset) {
  gpio_v2_line_info info{};
  info.offset = offset;
  LineFacts facts{.signal = signal, .offset = static_cast<int>(offset)};
  if (::ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &info) != 0) return facts;
  facts.name = text_of(info.name);
  facts.consumer = text_of(info.consumer);
  facts.is_used = (info.flags & GPIO_V2_LINE_FLAG_USED) != 0;
  return facts;
}

}  // namespace

EncoderFacts look_at_encoder(const Machine& machine, const EncoderOptions& options) {
  EncoderFacts facts;
  for (const std::string& name : machine.names("/dev")) {
    if (name.starts_with("gpiochip")) facts.chips.push_back(name);
  }
  facts.node = look_at_node(machine, options.chip.starts_with('/') ? options.chip : "/dev/" + options.chip);
  const auto lines = find_gpio_lines(options, machine.path("/dev"));
  if (!lines) {
    facts.refusal = lines.error();
    return facts;
  }
  if (!facts.node.exists) facts.node = look_at_node(machine, "/dev/" + lines->path.filename().string());
  constexpr const char* kSignals[] = {"A", "B", "index"};
  for (std::size_t i = 0; i < lines->offsets.size(); ++i)
    facts.lines.push_back(look_at_line(lines->chip.get(), kSignals[i], lines->offsets[i]));
  return facts;
}

CountFacts count_edges(EdgePort& port, std::chrono::nanoseconds duration, const std::function<HostStamp()>& now) {
  CountFacts facts;
  const auto levels = port.levels();
  if (levels) facts.levels = *levels;
  facts.is_broken = !levels;
  const HostStamp start_ns = now(), end_ns = start_ns + duration.count();
  HostStamp at_ns = start_ns;
  for (; at_ns < end_ns && !facts.is_broken; at_ns = now()) {
    const auto batch = port.read(std::chrono::nanoseconds(end_ns - at_ns));
    facts.is_broken = !batch;
    if (!batch) break;
    facts.lost_edges += batch->lost_edges;
    for (const Edge& edge : batch->edges) {
      if (edge.line == EncoderLine::A) ++facts.a_edges;
      if (edge.line == EncoderLine::B) ++facts.b_edges;
      if (edge.line == EncoderLine::Index) ++facts.index_edges;
    }
  }
  facts.duration_s = static_cast<double>(at_ns - start_ns) * 1e-9;
  return facts;
}

}  // namespace stairway::doctor
