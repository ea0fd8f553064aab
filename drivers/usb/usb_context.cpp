// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/usb_context.hpp"

#include <utility>

namespace stairway::drivers {

tl::expected<std::shared_ptr<UsbContext>, std::string> UsbContext::make() {
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != LIBUSB_SUCCESS) {
    return tl::unexpected(std::string("USB is not to be had on this machine (") + libusb_strerror(error) +
                          "); is /dev/bus/usb there?");
  }
  return std::shared_ptr<UsbContext>(new UsbContext(context));
}

UsbContext::UsbContext(libusb_context* context) : context_(context), thread_([this] { run(); }) {
  if (!libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG)) return;
  has_hotplug_ = libusb_hotplug_register_callback(context_, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED, 0, kHokuyoVendor,
                                                  kHokuyoProduct, LIBUSB_HOTPLUG_MATCH_ANY, &UsbContext::on_arrival,
                                                  this, &hotplug_) == LIBUSB_SUCCESS;
}

UsbContext::~UsbContext() {
  if (has_hotplug_) libusb_hotplug_deregister_callback(context_, hotplug_);
  is_ending_ = true;
  libusb_interrupt_event_handler(context_);
  thread_.join();
  libusb_exit(context_);
}

bool UsbContext::wait_for_arrival(std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return has_arrived_; });
  return std::exchange(has_arrived_, false);
}

int LIBUSB_CALL UsbContext::on_arrival(libusb_context*, libusb_device*, libusb_hotplug_event, void* self) {
  auto& context = *static_cast<UsbContext*>(self);
  {
    const std::lock_guard lock(context.mutex_);
    context.has_arrived_ = true;
  }
  context.changed_.notify_all();
  return 0;
}

void UsbContext::run() {
  while (!is_ending_) {
    timeval limit{1, 0};
    const int result = libusb_handle_events_timeout_completed(context_, &limit, nullptr);
    // A lasting error must not eat the processor.
    if (result != LIBUSB_SUCCESS) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace stairway::drivers
