// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stairway::drivers {

/// The parameters of a measurement command, named as SCIP names them.
/// MD, MS and ME start a stream; GD, GS and GE fetch the latest scan and have no `skip_scan` and `scans`.
struct ScanRequest {
  std::string symbol = "MD";
  int first_step = 0;    ///< 0..9999, within AMIN..AMAX of the sensor
  int last_step = 1080;  ///< likewise, not below `first_step`
  int cluster = 1;       ///< neighbouring steps that share one value, 0..99; 0 means 1
  int skip_scan = 0;     ///< mirror turns left out between two scans, 0..9
  int scans = 0;         ///< scans to send, 1..99; 0 = until stopped. In a data message: scans still to come

  bool is_stream() const { return !symbol.empty() && symbol.front() == 'M'; }
  bool has_intensity() const { return symbol == "ME" || symbol == "GE"; }
  int number_length() const { return symbol == "MS" || symbol == "GS" ? 2 : 3; }
  /// Values expected: whole groups and, rounded up, the last partial one (sensors differ; see decode_scan).
  int min_values() const { return (last_step - first_step + 1) / effective_cluster(); }
  int max_values() const { return (last_step - first_step + effective_cluster()) / effective_cluster(); }
  int effective_cluster() const { return cluster > 1 ? cluster : 1; }

  bool operator==(const ScanRequest&) const = default;
};

/// The command as sent, without LF: `MDssssEEEEccIss` or `GDssssEEEEcc`.
std::string to_command(const ScanRequest& request);

/// What a host sent, or what a sensor echoed; the views point into the line.
struct Command {
  std::string_view symbol;      ///< e.g. "MD", "VV", or "SCIP2.0"
  std::string_view parameters;  ///< between symbol and tag, e.g. "0000108001000"
  std::string_view tag;         ///< after `;`, empty when there is none
};

/// Splits a command line (without its end of line); empty when it is no command: shorter than two characters, a tag of
/// more than 16 characters or with others than letters, digits, space and `. _ + @`.
std::optional<Command> parse_command(std::string_view line);

/// The request in a measurement command of the M and G family; empty when the symbol is another one, the length is
/// wrong or a parameter is not a number. Ranges and order are for the caller: a sensor answers them with a status.
std::optional<ScanRequest> parse_scan_request(const Command& command);

}  // namespace stairway::drivers
