// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/full_screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "tools/stairway/report.hpp"

namespace stairway::tools {
namespace {

constexpr const char* kEnter = "\033[?1049h\033[?25l\033[2J";  // second page, no cursor, empty
constexpr const char* kLeave = "\033[?25h\033[?1049l";
constexpr const char* kHome = "\033[H";
constexpr const char* kClearLine = "\033[K";
constexpr const char* kClearBelow = "\033[J";

const char* begin_style(ScreenLine::Style style) {
  switch (style) {
    case ScreenLine::Style::Plain:
      break;
    case ScreenLine::Style::Heading:
      return "\033[1m";
    case ScreenLine::Style::Alert:
      return "\033[7m";
  }
  return "\033[0m";
}

}  // namespace

FullScreen::FullScreen() {
  has_resized();
  print(kEnter);
  flush_output();
}

FullScreen::~FullScreen() {
  print(kLeave);
  flush_output();
}

bool FullScreen::is_possible() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDOUT_FILENO) == 1 && ::isatty(STDIN_FILENO) == 1 && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

bool FullScreen::has_resized() {
  winsize size{};
  const bool is_known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0;
  const std::size_t columns = is_known ? size.ws_col : 80, rows = is_known ? size.ws_row : 25;
  const bool is_new = columns != columns_ || rows != rows_;
  columns_ = columns;
  rows_ = rows;
  return is_new;
}

void FullScreen::show(const std::vector<ScreenLine>& lines) const {
  std::string out = kHome;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) out += "\r\n";
    out.append(begin_style(lines[i].style)).append(lines[i].text).append("\033[0m").append(kClearLine);
  }
  print(out + kClearBelow);
  flush_output();
}

bool FullScreen::is_left() {
  while (const auto key = keyboard_.wait(std::chrono::milliseconds(0))) {
    if (*key == 'q') return true;
  }
  return false;
}

}  // namespace stairway::tools
