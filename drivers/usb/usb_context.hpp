// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tl/expected.hpp>

namespace stairway::drivers {

/// Every Hokuyo scanner with USB carries the same numbers; VV tells which one it is.
inline constexpr std::uint16_t kHokuyoVendor = 0x15d1;
inline constexpr std::uint16_t kHokuyoProduct = 0x0000;

/// libusb, with a thread that runs the callbacks of transfers and of hotplug. Ports share it and keep it alive.
class UsbContext {
 public:
  /// Gives libusb, or why this machine has none.
  static tl::expected<std::shared_ptr<UsbContext>, std::string> make();
  /// @pre  every device handle is closed.
  ~UsbContext();
  UsbContext(const UsbContext&) = delete;
  UsbContext& operator=(const UsbContext&) = delete;

  libusb_context* get() const { return context_; }

  /// Waits at most `timeout` for a scanner to be plugged in; true when one was since the last call. Without hotplug it
  /// only waits.
  bool wait_for_arrival(std::chrono::nanoseconds timeout);

 private:
  explicit UsbContext(libusb_context* context);
  static int LIBUSB_CALL on_arrival(libusb_context*, libusb_device*, libusb_hotplug_event, void* self);
  void run();

  libusb_context* context_;
  libusb_hotplug_callback_handle hotplug_ = 0;
  bool has_hotplug_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_arrived_ = false;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace stairway::drivers
