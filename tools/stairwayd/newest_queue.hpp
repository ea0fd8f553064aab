// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace stairway::daemon {

/// Hands values from one thread to another; when the taker is too slow, the oldest is dropped.
template <class T>
class NewestQueue {
 public:
  /// @pre  capacity > 0.
  explicit NewestQueue(std::size_t capacity) : capacity_(capacity) {}

  /// False when an older value had to go.
  bool push(T value) {
    bool is_roomy = true;
    {
      const std::lock_guard lock(mutex_);
      is_roomy = values_.size() < capacity_;
      if (!is_roomy) values_.pop_front();
      values_.push_back(std::move(value));
    }
    arrived_.notify_one();
    return is_roomy;
  }

  /// Waits until a value can be pushed without dropping one; false when asked to stop.
  bool wait_for_room(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    return taken_.wait(lock, stop, [this] { return values_.size() < capacity_; });
  }

  bool is_empty() const {
    const std::lock_guard lock(mutex_);
    return values_.empty();
  }

  /// No more values come: the takers get those that wait, then none.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
    }
    arrived_.notify_all();
  }

  /// Waits at most so long for a value.
  std::optional<T> pop_within(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, timeout, [this] { return !values_.empty(); })) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    taken_.notify_one();
    return value;
  }

  /// Waits for a value; empty when asked to stop, or closed and empty.
  std::optional<T> pop(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, stop, [this] { return !values_.empty() || is_closed_; });
    if (stop.stop_requested() || values_.empty()) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    taken_.notify_one();
    return value;
  }

 private:
  const std::size_t capacity_;
  std::deque<T> values_;
  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::condition_variable_any taken_;
  bool is_closed_ = false;
};

}  // namespace stairway::daemon
