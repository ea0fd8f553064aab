// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace stairway::ipc::cloud {

/// No byte of LZF stands for more than this many bytes: three bytes copy at most 264.
inline constexpr std::size_t kMaxLzfRatio = 88;

/// Expands the LZF stream of a binary_compressed PCD to exactly `size` bytes; the error says in what way it is
/// damaged. Format: Marc Lehmann's liblzf.
tl::expected<std::string, std::string_view> expand_lzf(std::string_view packed, std::size_t size);

}  // namespace stairway::ipc::cloud
