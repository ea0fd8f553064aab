// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/usb/chunk_queue.hpp"

namespace stairway::drivers {

/// Keeps bulk transfers waiting for a device's bytes, so that none waits for the host, and stamps them in the callback
/// of the transfer. The callbacks run in the thread of the UsbContext, all else in the reader's.
class InTransfers {
 public:
  /// Begins to receive.
  /// @param packet_bytes  largest packet of the endpoint.
  InTransfers(libusb_device_handle* device, std::uint8_t endpoint, int packet_bytes);
  /// Waits until every callback has run.
  ~InTransfers();
  InTransfers(const InTransfers&) = delete;
  InTransfers& operator=(const InTransfers&) = delete;

  /// What one transfer brought, as in BytePort::read. `Closed` when the device is gone or its errors do not end.
  tl::expected<ByteChunk, PortError> read(std::chrono::nanoseconds timeout);

 private:
  static constexpr std::size_t kTransfers = 8;
  struct Transfer {
    libusb_transfer* request = nullptr;
    std::vector<unsigned char> buffer;
  };

  static void LIBUSB_CALL on_done(libusb_transfer* request);
  void take(libusb_transfer& request);
  void submit(libusb_transfer* request);
  void submit_all();
  void cancel_all();
  void clear_stall();

  libusb_device_handle* device_;
  std::uint8_t endpoint_;
  std::array<Transfer, kTransfers> transfers_;
  ChunkQueue queue_;
  std::atomic<bool> is_stalled_{false};
  std::atomic<int> troubles_{0};  // since bytes came last

  std::mutex mutex_;
  std::condition_variable all_done_;
  bool is_cancelling_ = false;
  int in_flight_ = 0;
};

}  // namespace stairway::drivers
