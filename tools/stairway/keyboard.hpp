// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <chrono>
#include <optional>

namespace stairway::tools {

/// Single keys from standard input, at once and unechoed if that is a terminal, which is put back as it was in the end.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Waits at most this long for a key.
  std::optional<char> wait(std::chrono::milliseconds timeout);
  /// Whether no key can come any more.
  bool is_closed() const { return is_closed_; }

 private:
  std::optional<termios> before_;
  bool is_closed_ = false;
};

}  // namespace stairway::tools
