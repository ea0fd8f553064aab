// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/in_transfers.hpp"

#include <string>
#include <utility>

#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

constexpr int kTransferBytes = 512;
constexpr std::size_t kQueuedChunks = 512;  // two seconds of a full stream
constexpr int kMaxTroubles = 32;            // in a row, before the device is given up

// A transfer that is no multiple of the packets would overflow.
int transfer_bytes(int packet_bytes) { return (kTransferBytes + packet_bytes - 1) / packet_bytes * packet_bytes; }

}  // namespace

InTransfers::InTransfers(libusb_device_handle* device, std::uint8_t endpoint, int packet_bytes)
    : device_(device), endpoint_(endpoint), queue_(kQueuedChunks) {
  for (Transfer& transfer : transfers_) {
    transfer.buffer.resize(static_cast<std::size_t>(transfer_bytes(packet_bytes)));
    transfer.request = libusb_alloc_transfer(0);
    if (!transfer.request) {
      queue_.close();
      return;
    }
    libusb_fill_bulk_transfer(transfer.request, device_, endpoint_, transfer.buffer.data(),
                              static_cast<int>(transfer.buffer.size()), &InTransfers::on_done, this, 0);
  }
  submit_all();
}

InTransfers::~InTransfers() {
  cancel_all();
  for (const Transfer& transfer : transfers_) libusb_free_transfer(transfer.request);
}

tl::expected<ByteChunk, PortError> InTransfers::read(std::chrono::nanoseconds timeout) {
  if (is_stalled_.exchange(false)) clear_stall();
  auto chunk = queue_.pop(timeout);
  if (!chunk) return tl::unexpected(chunk.error());
  if (!*chunk) return ByteChunk{monotonic_now_ns(), {}};
  return std::move(**chunk);
}

void LIBUSB_CALL InTransfers::on_done(libusb_transfer* request) {
  static_cast<InTransfers*>(request->user_data)->take(*request);
}

void InTransfers::take(libusb_transfer& request) {
  const HostStamp now_ns = monotonic_now_ns();
  if (request.actual_length > 0) {
    troubles_ = 0;
    queue_.push({now_ns, std::string(reinterpret_cast<const char*>(request.buffer),
                                     static_cast<std::size_t>(request.actual_length))});
  }
  const bool is_good = request.status == LIBUSB_TRANSFER_COMPLETED;
  const bool is_odd = request.status == LIBUSB_TRANSFER_OVERFLOW || request.status == LIBUSB_TRANSFER_TIMED_OUT;
  const bool is_stall = request.status == LIBUSB_TRANSFER_STALL;
  const bool is_patience_over = (is_odd || is_stall) && ++troubles_ > kMaxTroubles;
  if (is_stall) {
    is_stalled_ = true;
    queue_.push({now_ns, {}});
  }
  const bool is_lost = request.status == LIBUSB_TRANSFER_ERROR || request.status == LIBUSB_TRANSFER_NO_DEVICE;
  if (is_lost || is_patience_over) queue_.close();

  const std::lock_guard lock(mutex_);
  --in_flight_;
  if ((is_good || is_odd) && !is_patience_over) submit(&request);
  if (in_flight_ == 0) all_done_.notify_all();
}

// Under the mutex, so that no transfer starts behind the back of cancel_all.
void InTransfers::submit(libusb_transfer* request) {
  if (is_cancelling_) return;
  if (libusb_submit_transfer(request) == LIBUSB_SUCCESS) {
    ++in_flight_;
  } else {
    queue_.close();
  }
}

void InTransfers::submit_all() {
  const std::lock_guard lock(mutex_);
  is_cancelling_ = false;
  for (const Transfer& transfer : transfers_) submit(transfer.request);
}

void InTransfers::cancel_all() {
  std::unique_lock lock(mutex_);
  is_cancelling_ = true;
  lock.unlock();
  for (const Transfer& transfer : transfers_) {
    if (transfer.request) libusb_cancel_transfer(transfer.request);
  }
  lock.lock();
  all_done_.wait(lock, [&] { return in_flight_ == 0; });
}

void InTransfers::clear_stall() {
  cancel_all();
  is_stalled_ = false;
  if (libusb_clear_halt(device_, endpoint_) == LIBUSB_SUCCESS) {
    submit_all();
  } else {
    queue_.close();
  }
}

}  // namespace stairway::drivers
