// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stairway::evaluation {
namespace {

constexpr std::size_t kNoteWidth = 110;

std::string cell_text(const Cell& cell, int digits) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const auto* number = std::get_if<double>(&cell);
  if (number == nullptr || !std::isfinite(*number)) return "-";
  // Rounded to what is printed, so that no "-0.0" appears.
  const double scale = std::pow(10.0, digits);
  return fmt::format("{:.{}f}", std::round(*number * scale) / scale + 0.0, digits);
}

/// One column as it is printed.
struct Strip {
  std::vector<std::string> words;  // name, unit, cells
  std::size_t width = 0;
  bool is_text = false;
};

// Terminals show one column per character, not per byte.
std::size_t shown_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

Strip make_strip(const Table& table, std::size_t index) {
  const Column& column = table.columns[index];
  Strip strip;
  strip.words.push_back(column.name);
  std::replace(strip.words.back().begin(), strip.words.back().end(), '_', ' ');
  strip.words.push_back(column.unit.empty() ? "" : "[" + column.unit + "]");
  for (const auto& row : table.rows) {
    const Cell& cell = row.at(index);
    strip.is_text = strip.is_text || std::holds_alternative<std::string>(cell);
    strip.words.push_back(cell_text(cell, column.digits));
  }
  for (const std::string& word : strip.words) strip.width = std::max(strip.width, shown_width(word));
  return strip;
}

std::string line(const std::vector<Strip>& strips, std::size_t index) {
  std::string out;
  for (const Strip& strip : strips) {
    const std::string& word = strip.words[index];
    const std::string padding(strip.width - shown_width(word), ' ');
    out += "  " + (strip.is_text ? word + padding : padding + word);
  }
  out.erase(out.find_last_not_of(' ') + 1);
  return out + '\n';
}

std::string wrapped(const std::string& text) {
  std::string out = "- ";
  std::size_t column = 2;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column > 2 && column + 1 + end - begin > kNoteWidth) {
      out += "\n  ";
      column = 2;
    } else if (column > 2) {
      out += ' ';
      ++column;
    }
    out.append(text, begin, end - begin);
    column += end - begin;
    begin = end + 1;
  }
  return out + '\n';
}

}  // namespace

std::string table_text(const Table& table) {
  std::vector<Strip> strips;
  bool has_units = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    strips.push_back(make_strip(table, i));
    has_units = has_units || !table.columns[i].unit.empty();
  }
  std::size_t width = 0;
  for (const Strip& strip : strips) width += strip.width + 2;
  std::string out = table.title + '\n' + line(strips, 0);
  if (has_units) out += line(strips, 1);
  out += "  " + std::string(width < 2 ? 0 : width - 2, '-') + '\n';
  for (std::size_t row = 0; row < table.rows.size(); ++row) out += line(strips, row + 2);
  return out;
}

std::string result_text(const Result& result) {
  std::string out;
  for (const Table& table : result.tables) out += table_text(table) + '\n';
  for (const std::string& note : result.notes) out += wrapped(note);
  return out;
}

}  // namespace stairway::evaluation
