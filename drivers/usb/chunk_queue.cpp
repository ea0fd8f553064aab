// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/chunk_queue.hpp"

#include <utility>

namespace stairway::drivers {

void ChunkQueue::push(ByteChunk chunk) {
  {
    const std::lock_guard lock(mutex_);
    chunks_.push_back(std::move(chunk));
    if (chunks_.size() > max_chunks_) {
      lost_bytes_ += chunks_.front().bytes.size();
      chunks_.pop_front();
    }
  }
  changed_.notify_one();
}

void ChunkQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

tl::expected<std::optional<ByteChunk>, PortError> ChunkQueue::pop(std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return !chunks_.empty() || is_closed_; });
  if (chunks_.empty()) {
    if (is_closed_) return tl::unexpected(PortError::Closed);
    return std::nullopt;
  }
  ByteChunk chunk = std::move(chunks_.front());
  chunks_.pop_front();
  chunk.lost_bytes = std::exchange(lost_bytes_, 0);
  return chunk;
}

}  // namespace stairway::drivers
