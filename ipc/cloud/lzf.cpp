// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/cloud/lzf.hpp"

namespace stairway::ipc::cloud {
namespace {

tl::unexpected<std::string_view> damaged(std::string_view why) { return tl::unexpected<std::string_view>(why); }

}  // namespace

tl::expected<std::string, std::string_view> expand_lzf(std::string_view packed, std::size_t size) {
  std::string out;
  out.reserve(size);
  std::size_t in = 0;
  const auto next_byte = [&] { return static_cast<unsigned char>(packed[in++]); };
  while (in < packed.size()) {
    const unsigned control = next_byte();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - in) return damaged("the compressed data end within a literal run");
      if (length > size - out.size()) return damaged("the compressed data expand beyond the declared size");
      out.append(packed, in, length);
      in += length;
      continue;
    }
    const bool is_long = control >> 5 == 7;
    if (packed.size() - in < (is_long ? 2U : 1U)) return damaged("the compressed data end within a reference");
    const std::size_t length = (control >> 5) + 2U + (is_long ? next_byte() : 0U);
    const std::size_t distance = ((control & 31U) << 8) + next_byte() + 1U;
    if (distance > out.size()) return damaged("the compressed data refer to bytes before their start");
    if (length > size - out.size()) return damaged("the compressed data expand beyond the declared size");
    // Source and target may overlap, which repeats the bytes between them.
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  }
  if (out.size() != size) return damaged("the compressed data expand to less than the declared size");
  return out;
}

}  // namespace stairway::ipc::cloud
