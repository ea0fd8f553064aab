// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

/// The results of run(0) .. run(count - 1), in this order whatever the number of threads.
///
/// @param run          called by several threads at once, each index once; its result must be default-constructible.
/// @param on_finished  told how many have finished, by one thread at a time; may be empty.
/// @param threads      0 takes as many as the machine has.
/// What a run throws is thrown here; runs that have not begun are then left out.
template <typename Run>
auto run_in_parallel(std::size_t count, const Run& run, const std::function<void(std::size_t)>& on_finished = {},
                     unsigned threads = 0) {
  std::vector<decltype(run(std::size_t{}))> results(count);
  std::atomic<std::size_t> next{0};
  std::size_t finished = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        results[i] = run(i);
        const std::scoped_lock lock(mutex);
        if (on_finished) on_finished(++finished);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  const std::size_t wanted = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(wanted, count); ++i) helpers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

/// The same, telling the request how far it has come.
/// @param name_of  of a run, for a person; called with the number of those that have finished.
template <typename Run, typename Name>
auto run_with_progress(const Request& request, std::size_t count, const Run& run, const Name& name_of) {
  const auto tell = [&](std::size_t finished) {
    if (request.progress && finished < count)
      request.progress(static_cast<double>(finished) / static_cast<double>(count), name_of(finished));
  };
  tell(0);
  return run_in_parallel(count, run, tell);
}

}  // namespace stairway::evaluation
