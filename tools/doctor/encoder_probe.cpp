// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

#include "tools/doctor/encoder.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

struct File {
  explicit File(const std::string& path) : fd(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {}
  ~File() {
    if (fd >= 0) ::close(fd);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int fd;
};

std::string last_error() { return std::generic_category().message(errno); }

template <std::size_t Size>
std::string text_of(const char (&text)[Size]) {
  return {text, ::strnlen(text, Size)};
}

std::optional<LineFacts> look_at_line(int fd, int offset) {
  gpio_v2_line_info info{};
  info.offset = static_cast<std::uint32_t>(offset);
  if (::ioctl(fd, GPIO_V2_GET_LINEINFO_IOCTL, &info) != 0) return std::nullopt;
  return LineFacts{offset, text_of(info.name), text_of(info.consumer), (info.flags & GPIO_V2_LINE_FLAG_USED) != 0};
}

std::optional<std::string> label_of(const std::string& place) {
  const File file(place);
  gpiochip_info info{};
  if (file.fd < 0 || ::ioctl(file.fd, GPIO_GET_CHIPINFO_IOCTL, &info) != 0) return std::nullopt;
  return text_of(info.label);
}

/// The node of a chip that is named by name, path or label.
std::string chip_path(const Machine& machine, const std::vector<std::string>& chips, const std::string& wanted) {
  if (wanted.starts_with("/")) return wanted;
  for (const std::string& chip : chips) {
    if (chip != wanted && label_of(machine.path("/dev/" + chip).string()) == wanted) return "/dev/" + chip;
  }
  return "/dev/" + wanted;
}

}  // namespace

EncoderFacts look_at_encoder(const Machine& machine, const WantedLines& wanted) {
  EncoderFacts facts;
  for (const std::string& name : machine.names("/dev")) {
    if (name.starts_with("gpiochip")) facts.chips.push_back(name);
  }
  if (wanted.chip.empty()) return facts;
  facts.node = look_at_node(machine, chip_path(machine, facts.chips, wanted.chip));
  if (!facts.node.exists) return facts;
  const File file(machine.path(facts.node.path).string());
  gpiochip_info info{};
  if (file.fd < 0 || ::ioctl(file.fd, GPIO_GET_CHIPINFO_IOCTL, &info) != 0) {
    facts.refusal = last_error();
    return facts;
  }
  facts.label = text_of(info.label);
  facts.line_count = static_cast<int>(info.lines);
  for (const int offset : {wanted.a, wanted.b, wanted.index}) {
    if (offset < 0) continue;
    if (auto line = look_at_line(file.fd, offset)) facts.lines.push_back(std::move(*line));
  }
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
