// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpio/gpio_lines.hpp"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

namespace stairway::drivers {
namespace {

namespace fs = std::filesystem;

template <std::size_t N>
std::string text_of(const char (&field)[N]) {
  return {field, ::strnlen(field, N)};
}

std::vector<std::string> chip_names(const fs::path& devices) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(devices, ignored)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("gpiochip")) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::optional<gpiochip_info> info_of(const FileDescriptor& chip) {
  gpiochip_info info{};
  if (::ioctl(chip.get(), GPIO_GET_CHIPINFO_IOCTL, &info) != 0) return std::nullopt;
  return info;
}

std::optional<gpioline_info> info_of(const FileDescriptor& chip, std::uint32_t offset) {
  gpioline_info info{};
  info.line_offset = offset;
  if (::ioctl(chip.get(), GPIO_GET_LINEINFO_IOCTL, &info) != 0) return std::nullopt;
  return info;
}

tl::expected<FileDescriptor, std::string> open_chip(const fs::path& path) {
  FileDescriptor chip(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (chip.is_open()) return chip;
  const int error = errno;
  if (error == EACCES || error == EPERM) {
    return tl::unexpected(path.string() +
                          " may not be opened; install the udev rules (60-stairway.rules) and add the user to the "
                          "group gpio");
  }
  return tl::unexpected(path.string() + ": " + std::strerror(error));
}

// The device of the chip with that path, name or label.
tl::expected<fs::path, std::string> find_chip(const std::string& wanted, const fs::path& devices) {
  std::error_code ignored;
  if (wanted.starts_with('/')) {
    if (fs::exists(wanted, ignored)) return fs::path(wanted);
    return tl::unexpected(wanted + " does not exist");
  }
  const std::vector<std::string> names = chip_names(devices);
  if (std::ranges::find(names, wanted) != names.end()) return devices / wanted;
  for (const std::string& name : names) {
    const auto chip = open_chip(devices / name);
    const auto info = chip ? info_of(*chip) : std::nullopt;
    if (info && text_of(info->label) == wanted) return devices / name;
  }
  if (names.empty()) return tl::unexpected(std::string("this computer has no GPIO chip (encoder.chip)"));
  return tl::unexpected("no GPIO chip is called " + wanted + " (encoder.chip); there are " + joined(names));
}

tl::expected<std::uint32_t, std::string> find_line(const FileDescriptor& chip, std::uint32_t count,
                                                   const std::string& wanted, const std::string& key) {
  std::uint32_t offset = 0;
  const char* end = wanted.data() + wanted.size();
  if (const auto [rest, error] = std::from_chars(wanted.data(), end, offset); error == std::errc() && rest == end) {
    if (offset < count) return offset;
    return tl::unexpected("the chip has only " + std::to_string(count) + " lines (" + key + " = " + wanted + ")");
  }
  for (offset = 0; offset < count; ++offset) {
    const auto info = info_of(chip, offset);
    if (info && text_of(info->name) == wanted) return offset;
  }
  return tl::unexpected("no line of the chip is called " + wanted + " (" + key + ")");
}

}  // namespace

tl::expected<GpioLines, std::string> find_gpio_lines(const EncoderOptions& options, const fs::path& devices) {
  auto path = find_chip(options.chip, devices);
  if (!path) return tl::unexpected(path.error());
  auto chip = open_chip(*path);
  if (!chip) return tl::unexpected(chip.error());
  const auto info = info_of(*chip);
  if (!info) return tl::unexpected(path->string() + " is not a GPIO chip (encoder.chip)");

  GpioLines lines{std::move(*chip), std::move(*path), {}};
  const std::pair<const std::string&, const char*> wanted[] = {{options.line_a, "encoder.line_a"},
                                                               {options.line_b, "encoder.line_b"},
                                                               {options.line_index, "encoder.line_index"}};
  for (const auto& [line, key] : wanted) {
    if (line.empty()) continue;
    const auto offset = find_line(lines.chip, info->lines, line, key);
    if (!offset) return tl::unexpected(offset.error());
    lines.offsets.push_back(*offset);
  }
  return lines;
}

std::string refusal_text(const GpioLines& lines, int error) {
  const std::string chip = lines.path.string();
  for (const std::uint32_t offset : lines.offsets) {
    const auto info = info_of(lines.chip, offset);
    if (!info || (info->flags & GPIOLINE_FLAG_KERNEL) == 0) continue;
    return "line " + std::to_string(offset) + " of " + chip + " is in use by " + text_of(info->consumer) +
           "; end that program or choose other lines";
  }
  return "the lines of " + chip + " cannot be read: " + std::strerror(error);
}

}  // namespace stairway::drivers
