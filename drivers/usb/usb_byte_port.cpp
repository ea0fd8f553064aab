// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/usb_byte_port.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include "drivers/usb/acm_line.hpp"
#include "drivers/usb/usb_path.hpp"

namespace stairway::drivers {
namespace {

constexpr unsigned kTimeout_ms = 1000;
constexpr std::uint32_t kRate_baud = 115200;
constexpr std::uint8_t kToInterface = 0x21;
constexpr std::uint8_t kSetLineCoding = 0x20;
constexpr std::uint8_t kSetControlLineState = 0x22;
constexpr std::uint16_t kDtrAndRts = 0x03;

std::string reason(int error, const std::string& path) {
  switch (error) {
    case LIBUSB_ERROR_ACCESS:
      return "no permission for the scanner at USB " + path +
             ": install 60-stairway.rules below /etc/udev/rules.d, join the group stairway, and plug it in again";
    case LIBUSB_ERROR_BUSY:
      return "the scanner at USB " + path + " is in use by another program";
    case LIBUSB_ERROR_NO_DEVICE:
      return "the scanner at USB " + path + " was unplugged";
    default:
      return "the scanner at USB " + path + " cannot be opened: " + libusb_strerror(error);
  }
}

std::optional<AcmLayout> layout_of(libusb_device* device) {
  libusb_config_descriptor* configuration = nullptr;
  if (libusb_get_active_config_descriptor(device, &configuration) != LIBUSB_SUCCESS) return std::nullopt;
  const auto layout = find_acm_layout(*configuration);
  libusb_free_config_descriptor(configuration);
  return layout;
}

int claim(libusb_device_handle* device, int interface) {
  if (libusb_kernel_driver_active(device, interface) == 1) {
    const int error = libusb_detach_kernel_driver(device, interface);
    if (error != LIBUSB_SUCCESS && error != LIBUSB_ERROR_NOT_FOUND) return error;
  }
  return libusb_claim_interface(device, interface);
}

// The kernel's driver sends these as well, and some devices stay silent without.
std::string set_line(libusb_device_handle* device, std::uint16_t interface) {
  auto coding = line_coding(kRate_baud);
  int result = libusb_control_transfer(device, kToInterface, kSetLineCoding, 0, interface, coding.data(), coding.size(),
                                       kTimeout_ms);
  if (std::string problem = line_setting_problem(result); !problem.empty()) return problem;
  result = libusb_control_transfer(device, kToInterface, kSetControlLineState, kDtrAndRts, interface, nullptr, 0,
                                   kTimeout_ms);
  return line_setting_problem(result);
}

}  // namespace

tl::expected<std::unique_ptr<BytePort>, std::string> UsbBytePort::open(const std::shared_ptr<UsbContext>& context,
                                                                       libusb_device* device) {
  const std::string path = usb_path(device);
  const auto layout = layout_of(device);
  if (!layout) return tl::unexpected("the device at USB " + path + " has no serial line: not a scanner, or defective");
  libusb_device_handle* opened = nullptr;
  if (const int error = libusb_open(device, &opened); error != LIBUSB_SUCCESS) {
    return tl::unexpected(reason(error, path));
  }
  Handle handle(opened);
  int error = claim(opened, layout->data_interface);
  if (error == LIBUSB_SUCCESS && layout->control_interface) error = claim(opened, *layout->control_interface);
  if (error != LIBUSB_SUCCESS) return tl::unexpected(reason(error, path));
  const std::string problem = layout->control_interface ? set_line(opened, *layout->control_interface) : "";
  if (!problem.empty()) return tl::unexpected("the scanner at USB " + path + ": " + problem);
  return std::unique_ptr<BytePort>(new UsbBytePort(context, std::move(handle), *layout));
}

UsbBytePort::UsbBytePort(std::shared_ptr<UsbContext> context, Handle device, const AcmLayout& layout)
    : context_(std::move(context)),
      device_(std::move(device)),
      layout_(layout),
      in_(device_.get(), layout.endpoint_in, layout.in_packet_bytes) {}

tl::expected<ByteChunk, PortError> UsbBytePort::read(std::chrono::nanoseconds timeout) { return in_.read(timeout); }

tl::expected<void, PortError> UsbBytePort::write(std::string_view bytes) {
  std::string copy(bytes);
  int sent = 0;
  const int error =
      libusb_bulk_transfer(device_.get(), layout_.endpoint_out, reinterpret_cast<unsigned char*>(copy.data()),
                           static_cast<int>(copy.size()), &sent, kTimeout_ms);
  if (error == LIBUSB_SUCCESS && sent == static_cast<int>(copy.size())) return {};
  if (error == LIBUSB_ERROR_PIPE) libusb_clear_halt(device_.get(), layout_.endpoint_out);
  return tl::unexpected(error == LIBUSB_ERROR_NO_DEVICE ? PortError::Closed : PortError::Io);
}

}  // namespace stairway::drivers
