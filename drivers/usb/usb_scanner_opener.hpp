// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "drivers/usb/usb_context.hpp"
#include "drivers/usb/usb_options.hpp"

namespace stairway::drivers {

/// Finds Hokuyo scanners on USB and opens one. Not thread-safe.
class UsbScannerOpener {
 public:
  /// @param wanted_serial  when not empty, each opening takes the next of several scanners in turn, until the session
  ///                       finds the right one; when empty, the one that was open before is preferred.
  UsbScannerOpener(const UsbOptions& options, const std::string& wanted_serial);

  /// As PortOpener::open. The reasons: none plugged in, none at the wanted port, no permission, in use by another
  /// program, no USB on this machine.
  tl::expected<std::unique_ptr<BytePort>, std::string> open();
  /// As PortOpener::wait: true when a scanner is plugged in. Without libusb's hotplug it only waits.
  bool wait(std::chrono::nanoseconds timeout);

 private:
  struct Unref {
    void operator()(libusb_device* device) const { libusb_unref_device(device); }
  };
  struct Candidate {
    std::string path;
    std::unique_ptr<libusb_device, Unref> device;
  };

  std::vector<Candidate> find_scanners() const;
  std::string why_none(const std::vector<Candidate>& scanners) const;

  UsbOptions options_;
  bool takes_turns_;
  std::shared_ptr<UsbContext> context_;
  bool is_context_doubtful_ = false;
  std::optional<std::string> last_path_;
};

/// The same as functions, for Utm30lx.
PortOpener<BytePort> usb_scanner_opener(const UsbOptions& options, const std::string& wanted_serial);

}  // namespace stairway::drivers
