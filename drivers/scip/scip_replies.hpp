// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/scip/scip_codec.hpp"
#include "drivers/scip/scip_commands.hpp"

namespace stairway::drivers {

/// A message split into its parts; the views point into the message.
struct ScipReply {
  std::string_view echo;    ///< the command it answers, with tag
  std::string_view status;  ///< two characters, e.g. "00", "99", "0E"
  std::string_view data;    ///< the lines behind the status, each ended by LF; unchecked
};

/// Splits a message (as ScipFramer gives it) and checks the sum of its status line.
tl::expected<ScipReply, ScipError> parse_reply(std::string_view message);

/// The last reply inside `text` whose echo line ends with `echo`. Finds a good reply behind the remains of another one
/// whose end was lost, or behind junk on the echo line itself.
tl::expected<ScipReply, ScipError> find_reply(std::string_view text, std::string_view echo);

/// A whole reply as a sensor sends it: echo, status, `data_lines` (already with sums and LF), empty line.
std::string encode_reply(std::string_view echo, std::string_view status, std::string_view data_lines = {});

/// What VV says.
struct VersionInfo {
  std::string vendor, product, firmware, protocol, serial;
};

/// What PP says. The defaults are a UTM-30LX's.
struct SensorParameters {
  std::string model = "UTM-30LX";
  int min_range_mm = 23;      ///< DMIN: smaller values are error codes
  int max_range_mm = 60000;   ///< DMAX
  int steps_per_turn = 1440;  ///< ARES
  int first_step = 0;         ///< AMIN
  int last_step = 1080;       ///< AMAX
  int front_step = 540;       ///< AFRT
  int scan_speed_rpm = 2400;  ///< SCAN

  /// Time from one sent scan to the next, when so many turns of the mirror are left out between them [ns].
  double scan_period_ns(int skip_scan) const { return 60e9 / scan_speed_rpm * (skip_scan + 1); }
};

/// What II says.
struct SensorState {
  std::string model, laser, scan_speed, measurement_mode, bit_rate, status;
  std::uint32_t time_ms = 0;  ///< the 24-bit counter that also stamps the scans [ms]

  /// False when `status` reports a malfunction; texts that are not known count as healthy.
  bool is_healthy() const;
};

/// Each takes the data lines of a reply. Unknown keys are left out; one bad sum refuses the whole reply. PP refuses a
/// reply with a missing number (MissingField) or numbers that contradict each other (BadForm).
tl::expected<VersionInfo, ScipError> parse_version(std::string_view data);
tl::expected<SensorParameters, ScipError> parse_parameters(std::string_view data);
tl::expected<SensorState, ScipError> parse_state(std::string_view data);

/// The 24-bit counter in the data line of a reply to TM1 [ms].
tl::expected<std::uint32_t, ScipError> parse_time(std::string_view data);

/// One scan as the sensor sent it: millimetres, error codes among them.
struct RawScan {
  std::uint32_t stamp_ms = 0;              ///< 24-bit counter [ms]
  std::vector<std::uint32_t> ranges_mm;    ///< one per group of `cluster` steps, from `first_step` on
  std::vector<std::uint32_t> intensities;  ///< unit-less, same length; empty without ME/GE
};

/// Decodes the data lines of a reply with status 99 (or 00 for G commands) into `scan`, whose memory is used again.
/// On an error `scan` is unspecified. A last group that is not whole may be present or not.
tl::expected<void, ScipError> decode_scan(std::string_view data, const ScanRequest& request, RawScan& scan);

/// The data lines of `scan`: time stamp and data block.
std::string encode_scan_data(const RawScan& scan, const ScanRequest& request);

}  // namespace stairway::drivers
