// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace stairway::detect {

/// Calls `work(first, last)` for consecutive ranges that make up 0 .. count - 1, each on a thread of its own, one of
/// them the caller's. Where every element is worked on alone, the result does not depend on the number of threads.
///
/// A range holds at least `fewest` elements, for which a thread is worth its start of some 20 us. What the work throws
/// is thrown here when all have ended; where the system gives no thread, the caller does the work.
/// @pre  threads >= 1, fewest >= 1
template <class Work>
void for_ranges(std::size_t count, int threads, std::size_t fewest, const Work& work) {
  const std::size_t parts = std::clamp<std::size_t>(count / fewest, 1, static_cast<std::size_t>(threads));
  const auto begin_of = [&](std::size_t part) { return count * part / parts; };
  std::vector<std::exception_ptr> thrown(parts);
  const auto run = [&](std::size_t part) {
    try {
      work(begin_of(part), begin_of(part + 1));
    } catch (...) {
      thrown[part] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    others.reserve(parts - 1);
    for (std::size_t part = 1; part < parts; ++part) {
      try {
        others.emplace_back(run, part);
      } catch (const std::system_error&) {
        run(part);
      }
    }
    run(0);
  }
  for (const std::exception_ptr& what : thrown)
    if (what) std::rethrow_exception(what);
}

}  // namespace stairway::detect
