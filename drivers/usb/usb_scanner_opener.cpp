// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/usb_scanner_opener.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "drivers/usb/usb_byte_port.hpp"
#include "drivers/usb/usb_path.hpp"

namespace stairway::drivers {
namespace {

bool is_scanner(libusb_device* device) {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS && descriptor.idVendor == kHokuyoVendor &&
         descriptor.idProduct == kHokuyoProduct;
}

}  // namespace

UsbScannerOpener::UsbScannerOpener(const UsbOptions& options, const std::string& wanted_serial)
    : options_(options), takes_turns_(!wanted_serial.empty()) {}

tl::expected<std::unique_ptr<BytePort>, std::string> UsbScannerOpener::open() {
  // Where no udevd runs, libusb never hears of devices that come later; a new one looks for itself.
  if (is_context_doubtful_) context_.reset();
  is_context_doubtful_ = true;
  if (!context_) {
    auto context = UsbContext::make();
    if (!context) return tl::unexpected(context.error());
    context_ = std::move(*context);
  }
  std::vector<Candidate> scanners = find_scanners();
  std::string reason = why_none(scanners);
  if (!options_.port.empty()) std::erase_if(scanners, [&](const auto& one) { return one.path != options_.port; });

  // The first to try is the one that was open before, or when turns are taken the one behind it.
  const auto first = std::ranges::find_if(scanners, [&](const Candidate& one) {
    return last_path_ && (takes_turns_ ? one.path > *last_path_ : one.path >= *last_path_);
  });
  std::ranges::rotate(scanners, first);
  for (const Candidate& scanner : scanners) {
    auto port = UsbBytePort::open(context_, scanner.device.get());
    if (!port) {
      reason = std::move(port.error());
      continue;
    }
    last_path_ = scanner.path;
    is_context_doubtful_ = false;
    return std::move(*port);
  }
  return tl::unexpected(std::move(reason));
}

bool UsbScannerOpener::wait(std::chrono::nanoseconds timeout) {
  return context_ ? context_->wait_for_arrival(timeout) : sleep_without_port(timeout);
}

std::vector<UsbScannerOpener::Candidate> UsbScannerOpener::find_scanners() const {
  std::vector<Candidate> found;
  libusb_device** devices = nullptr;
  const auto count = libusb_get_device_list(context_->get(), &devices);
  for (libusb_device* device : std::span(devices, static_cast<std::size_t>(std::max<decltype(count)>(0, count)))) {
    if (!is_scanner(device)) continue;
    found.push_back({usb_path(device), std::unique_ptr<libusb_device, Unref>(libusb_ref_device(device))});
  }
  if (count >= 0) libusb_free_device_list(devices, 1);
  std::ranges::sort(found, {}, &Candidate::path);
  return found;
}

std::string UsbScannerOpener::why_none(const std::vector<Candidate>& scanners) const {
  if (scanners.empty()) return "no scanner is plugged in (USB 15d1:0000); check its cable and its 12 V supply";
  std::string places;
  for (const Candidate& scanner : scanners) places += (places.empty() ? "" : ", ") + scanner.path;
  return "no scanner at USB " + options_.port + ", where usb_port wants it; there is one at " + places;
}

PortOpener<BytePort> usb_scanner_opener(const UsbOptions& options, const std::string& wanted_serial) {
  auto opener = std::make_shared<UsbScannerOpener>(options, wanted_serial);
  return {[opener] { return opener->open(); },
          [opener](std::chrono::nanoseconds timeout) { return opener->wait(timeout); }};
}

}  // namespace stairway::drivers
