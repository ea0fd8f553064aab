// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_framer.hpp"

namespace stairway::drivers {

void ScipFramer::add(std::string_view bytes, HostStamp arrival_ns,
                     const std::function<void(const ScipBlock&)>& on_block) {
  bool is_first = true;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::string_view piece = bytes.substr(0, end == std::string_view::npos ? end : end + 1);
    add_piece(piece, arrival_ns, is_first);
    bytes.remove_prefix(piece.size());
    is_first = false;
    if (!is_block_complete()) continue;
    pending_.pop_back();
    if (!is_skipping_ && !pending_.empty()) on_block({pending_, arrival_ns_, is_arrival_exact_});
    clear();
  }
}

void ScipFramer::clear() {
  pending_.clear();
  is_skipping_ = false;
}

void ScipFramer::add_piece(std::string_view piece, HostStamp arrival_ns, bool is_first_of_chunk) {
  if (pending_.empty()) {
    arrival_ns_ = arrival_ns;
    is_arrival_exact_ = is_first_of_chunk;
  }
  pending_.append(piece);
  if (pending_.size() <= max_block_bytes_) return;
  if (!is_skipping_) ++overflows_;
  is_skipping_ = true;
  // The last character still tells whether the next LF makes an empty line.
  pending_.erase(0, pending_.size() - 1);
}

bool ScipFramer::is_block_complete() const { return pending_ == "\n" || std::string_view(pending_).ends_with("\n\n"); }

}  // namespace stairway::drivers
