// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_replies.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <utility>

namespace stairway::drivers {
namespace {

constexpr std::size_t kStatusLineLength = 3;
constexpr int kStampLength = 4;

// Calls `visit` for each KEY:value line; the first bad line ends it.
template <typename Visitor>
tl::expected<void, ScipError> for_each_key_value(std::string_view data, Visitor visit) {
  while (!data.empty()) {
    const auto entry = parse_key_value(take_line(data));
    if (!entry) return tl::unexpected(entry.error());
    visit(*entry);
  }
  return {};
}

template <typename Number>
std::optional<Number> parse_whole_number(std::string_view text, int base = 10) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_consistent(const SensorParameters& p) {
  return p.min_range_mm >= 0 && p.min_range_mm < p.max_range_mm && p.steps_per_turn > 0 && p.steps_per_turn <= 100000 &&
         p.first_step >= 0 && p.first_step < p.last_step && p.last_step - p.first_step < p.steps_per_turn &&
         p.last_step <= 9999 && p.front_step >= p.first_step && p.front_step <= p.last_step && p.scan_speed_rpm > 0 &&
         p.scan_speed_rpm <= 100000;
}

// The sum does not see the upper two bits of a character.
bool is_status_character(char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); }

bool contains_ignoring_case(std::string_view text, std::string_view lower_case) {
  const auto is_same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + ('a' - 'A') : a) == b; };
  return std::search(text.begin(), text.end(), lower_case.begin(), lower_case.end(), is_same) != text.end();
}

// Data characters and their place in the current line, values straddling line ends.
class DataReader {
 public:
  explicit DataReader(std::string_view data) : data_(data) {}

  bool is_at_end() const { return line_.empty() && data_.empty(); }

  tl::expected<std::uint32_t, ScipError> take_number(int chars) {
    if (line_.size() < static_cast<std::size_t>(chars)) return take_straddling_number(chars);
    const std::string_view text = line_.substr(0, static_cast<std::size_t>(chars));
    line_.remove_prefix(text.size());
    return decode_number(text);
  }

  tl::expected<std::string_view, ScipError> take_stamp_line() { return checked_body(take_line(data_)); }

 private:
  tl::expected<std::uint32_t, ScipError> take_straddling_number(int chars) {
    std::array<char, 4> text{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(chars); ++i) {
      if (line_.empty()) {
        if (data_.empty()) return tl::unexpected(ScipError::Truncated);
        if (const auto taken = take_data_line(); !taken) return tl::unexpected(taken.error());
      }
      text[i] = line_.front();
      line_.remove_prefix(1);
    }
    return decode_number(std::string_view(text.data(), static_cast<std::size_t>(chars)));
  }

  tl::expected<void, ScipError> take_data_line() {
    const auto body = checked_body(take_line(data_));
    if (!body) return tl::unexpected(body.error());
    // A lost LF joins two lines, and one in 64 of those has a sum that fits.
    const bool is_last = data_.empty();
    if (body->size() > kDataLineLength || (!is_last && body->size() < kDataLineLength)) {
      return tl::unexpected(ScipError::BadForm);
    }
    line_ = *body;
    return {};
  }

  std::string_view data_;
  std::string_view line_;
};

}  // namespace

tl::expected<ScipReply, ScipError> parse_reply(std::string_view message) {
  ScipReply reply;
  reply.echo = take_line(message);
  const std::string_view status_line = take_line(message);
  if (reply.echo.empty() || status_line.empty()) return tl::unexpected(ScipError::Truncated);
  if (status_line.size() != kStatusLineLength) return tl::unexpected(ScipError::BadForm);
  const auto status = checked_body(status_line);
  if (!status) return tl::unexpected(status.error());
  if (!std::ranges::all_of(*status, is_status_character)) return tl::unexpected(ScipError::BadCharacter);
  reply.status = *status;
  reply.data = message;
  return reply;
}

tl::expected<ScipReply, ScipError> find_reply(std::string_view text, std::string_view echo) {
  const std::string wanted = std::string(echo) + "\n";
  for (std::size_t at = text.rfind(wanted); at != std::string_view::npos; at = text.rfind(wanted, at - 1)) {
    if (auto reply = parse_reply(text.substr(at))) return reply;
    if (at == 0) break;
  }
  return tl::unexpected(ScipError::BadForm);
}

std::string encode_reply(std::string_view echo, std::string_view status, std::string_view data_lines) {
  std::string out(echo);
  out.push_back('\n');
  append_line(out, status);
  out.append(data_lines).push_back('\n');
  return out;
}

bool SensorState::is_healthy() const { return !contains_ignoring_case(status, "trouble"); }

tl::expected<VersionInfo, ScipError> parse_version(std::string_view data) {
  VersionInfo info;
  const std::array<std::pair<std::string_view, std::string*>, 5> fields{{{"VEND", &info.vendor},
                                                                         {"PROD", &info.product},
                                                                         {"FIRM", &info.firmware},
                                                                         {"PROT", &info.protocol},
                                                                         {"SERI", &info.serial}}};
  const auto done = for_each_key_value(data, [&](const KeyValue& entry) {
    for (const auto& [key, field] : fields) {
      if (key == entry.key) *field = entry.value;
    }
  });
  if (!done) return tl::unexpected(done.error());
  return info;
}

tl::expected<SensorParameters, ScipError> parse_parameters(std::string_view data) {
  SensorParameters parameters;
  const std::array<std::pair<std::string_view, int*>, 7> numbers{{{"DMIN", &parameters.min_range_mm},
                                                                  {"DMAX", &parameters.max_range_mm},
                                                                  {"ARES", &parameters.steps_per_turn},
                                                                  {"AMIN", &parameters.first_step},
                                                                  {"AMAX", &parameters.last_step},
                                                                  {"AFRT", &parameters.front_step},
                                                                  {"SCAN", &parameters.scan_speed_rpm}}};
  std::array<bool, numbers.size()> is_found{};
  bool are_numbers = true;
  const auto done = for_each_key_value(data, [&](const KeyValue& entry) {
    if (entry.key == "MODL") parameters.model = entry.value;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i].first != entry.key) continue;
      const auto value = parse_whole_number<int>(entry.value);
      are_numbers = are_numbers && value.has_value();
      *numbers[i].second = value.value_or(0);
      is_found[i] = true;
    }
  });
  if (!done) return tl::unexpected(done.error());
  if (!are_numbers) return tl::unexpected(ScipError::BadCharacter);
  if (std::ranges::find(is_found, false) != is_found.end()) return tl::unexpected(ScipError::MissingField);
  if (!is_consistent(parameters)) return tl::unexpected(ScipError::BadForm);
  return parameters;
}

tl::expected<SensorState, ScipError> parse_state(std::string_view data) {
  SensorState state;
  const std::array<std::pair<std::string_view, std::string*>, 6> fields{{{"MODL", &state.model},
                                                                         {"LASR", &state.laser},
                                                                         {"SCSP", &state.scan_speed},
                                                                         {"MESM", &state.measurement_mode},
                                                                         {"SBPS", &state.bit_rate},
                                                                         {"STAT", &state.status}}};
  const auto done = for_each_key_value(data, [&](const KeyValue& entry) {
    for (const auto& [key, field] : fields) {
      if (key == entry.key) *field = entry.value;
    }
    if (entry.key == "TIME") state.time_ms = parse_whole_number<std::uint32_t>(entry.value, 16).value_or(0);
  });
  if (!done) return tl::unexpected(done.error());
  return state;
}

tl::expected<std::uint32_t, ScipError> parse_time(std::string_view data) {
  const auto text = checked_body(take_line(data));
  if (!text) return tl::unexpected(text.error());
  if (text->size() != kStampLength || !data.empty()) return tl::unexpected(ScipError::BadForm);
  return decode_number(*text);
}

tl::expected<void, ScipError> decode_scan(std::string_view data, const ScanRequest& request, RawScan& scan) {
  scan.ranges_mm.clear();
  scan.intensities.clear();
  DataReader reader(data);
  const auto stamp_text = reader.take_stamp_line();
  if (!stamp_text) return tl::unexpected(stamp_text.error());
  if (stamp_text->size() != kStampLength) return tl::unexpected(ScipError::BadForm);
  const auto stamp = decode_number(*stamp_text);
  if (!stamp) return tl::unexpected(stamp.error());
  scan.stamp_ms = *stamp;

  const auto max_values = static_cast<std::size_t>(std::max(0, request.max_values()));
  while (!reader.is_at_end()) {
    if (scan.ranges_mm.size() == max_values) return tl::unexpected(ScipError::WrongCount);
    const auto range = reader.take_number(request.number_length());
    if (!range) return tl::unexpected(range.error());
    scan.ranges_mm.push_back(*range);
    if (!request.has_intensity()) continue;
    const auto intensity = reader.take_number(request.number_length());
    if (!intensity) return tl::unexpected(intensity.error());
    scan.intensities.push_back(*intensity);
  }
  if (static_cast<int>(scan.ranges_mm.size()) < request.min_values()) return tl::unexpected(ScipError::WrongCount);
  return {};
}

std::string encode_scan_data(const RawScan& scan, const ScanRequest& request) {
  std::string payload;
  for (std::size_t i = 0; i < scan.ranges_mm.size(); ++i) {
    append_number(payload, scan.ranges_mm[i], request.number_length());
    if (request.has_intensity()) append_number(payload, scan.intensities.at(i), request.number_length());
  }
  std::string out;
  append_line(out, encode_number(scan.stamp_ms, kStampLength));
  append_data_block(out, payload);
  return out;
}

}  // namespace stairway::drivers
