// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::tools {

/// How a verb answers on stdout.
enum class Format { Text, Json };

/// One line on stderr, beginning with the program's name.
void report_error(std::string_view text);

/// Writes to stdout. Failures are seen by main, which looks at the stream at the end.
void print(std::string_view text);

/// Hands to the reader of stdout what was printed so far.
void flush_output();

/// Prints one JSON object and a line end, and flushes.
void print_json_line(std::string_view object);

/// A line on stderr that each text replaces; only on a terminal, and gone in the end.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool is_visible() const { return is_terminal_; }
  void show(std::string_view text);
  void clear();

 private:
  bool is_terminal_;
  bool is_drawn_ = false;
};

}  // namespace stairway::tools
