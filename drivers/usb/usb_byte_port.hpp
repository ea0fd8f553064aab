// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <memory>
#include <string>
#include <tl/expected.hpp>

#include "drivers/ports/byte_port.hpp"
#include "drivers/usb/acm_layout.hpp"
#include "drivers/usb/in_transfers.hpp"
#include "drivers/usb/usb_context.hpp"

namespace stairway::drivers {

/// A scanner's USB cable, its interfaces claimed. Bytes are stamped when they arrive, whether or not anybody reads; up
/// to 512 chunks wait for the reader. The kernel's tty driver, which was sent away from the interfaces, does not come
/// back when the port is closed, but with the next plugging in: nothing disturbs the next opening.
class UsbBytePort final : public BytePort {
 public:
  /// Opens a device, or tells a person why it cannot be opened.
  static tl::expected<std::unique_ptr<BytePort>, std::string> open(const std::shared_ptr<UsbContext>& context,
                                                                   libusb_device* device);

  /// As BytePort::read. A stall is cleared; a device that was unplugged, or whose errors do not end, is `Closed`.
  tl::expected<ByteChunk, PortError> read(std::chrono::nanoseconds timeout) override;
  /// Waits at most a second for the device to take the bytes.
  tl::expected<void, PortError> write(std::string_view bytes) override;

 private:
  struct Closer {
    void operator()(libusb_device_handle* device) const { libusb_close(device); }
  };
  using Handle = std::unique_ptr<libusb_device_handle, Closer>;

  UsbBytePort(std::shared_ptr<UsbContext> context, Handle device, const AcmLayout& layout);

  std::shared_ptr<UsbContext> context_;
  Handle device_;
  AcmLayout layout_;
  InTransfers in_;
};

}  // namespace stairway::drivers
