// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/keyboard.hpp"

#include <poll.h>
#include <unistd.h>

#include <thread>

namespace stairway::tools {

Keyboard::Keyboard() {
  termios terminal{};
  // A program in the background would be stopped for touching the terminal.
  if (::tcgetattr(STDIN_FILENO, &terminal) != 0 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) return;
  before_ = terminal;
  terminal.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  ::tcsetattr(STDIN_FILENO, TCSANOW, &terminal);
}

Keyboard::~Keyboard() {
  if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

std::optional<char> Keyboard::wait(std::chrono::milliseconds timeout) {
  if (is_closed_) {
    std::this_thread::sleep_for(timeout);
    return std::nullopt;
  }
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
  char key = 0;
  if (::read(STDIN_FILENO, &key, 1) == 1) return key;
  is_closed_ = true;
  return std::nullopt;
}

}  // namespace stairway::tools
