// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tools/stairway/keyboard.hpp"
#include "tools/stairway/monitor_screen.hpp"

namespace stairway::tools {

/// The whole terminal behind stdout, on its second page: what stood there before is back in the end. Keys are taken
/// unechoed meanwhile.
class FullScreen {
 public:
  FullScreen();
  ~FullScreen();
  FullScreen(const FullScreen&) = delete;
  FullScreen& operator=(const FullScreen&) = delete;

  /// Whether stdout and stdin are a terminal that can do this.
  static bool is_possible();

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  /// Looks at the terminal's size; true when it has changed since the last look.
  bool has_resized();
  void show(const std::vector<ScreenLine>& lines) const;
  /// Whether q was typed.
  bool is_left();

 private:
  Keyboard keyboard_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace stairway::tools
