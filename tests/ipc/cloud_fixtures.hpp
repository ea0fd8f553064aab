// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace stairway::ipc::test {

/// Appends `value` as the bytes of T.
template <class T>
void append_number(std::string& out, double value, bool big_endian = false) {
  const T number = static_cast<T>(value);
  char bytes[sizeof(T)];
  std::memcpy(bytes, &number, sizeof(T));
  if (big_endian) std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

inline void append_typed(std::string& out, std::string_view pcd_type, double value, bool big_endian = false) {
  if (pcd_type == "I1") return append_number<std::int8_t>(out, value, big_endian);
  if (pcd_type == "U1") return append_number<std::uint8_t>(out, value, big_endian);
  if (pcd_type == "I2") return append_number<std::int16_t>(out, value, big_endian);
  if (pcd_type == "U2") return append_number<std::uint16_t>(out, value, big_endian);
  if (pcd_type == "I4") return append_number<std::int32_t>(out, value, big_endian);
  if (pcd_type == "U4") return append_number<std::uint32_t>(out, value, big_endian);
  if (pcd_type == "I8") return append_number<std::int64_t>(out, value, big_endian);
  if (pcd_type == "U8") return append_number<std::uint64_t>(out, value, big_endian);
  if (pcd_type == "F4") return append_number<float>(out, value, big_endian);
  append_number<double>(out, value, big_endian);
}

struct PcdField {
  std::string name;
  std::string type;  ///< TYPE and SIZE, e.g. "F4"
  int count = 1;
};

inline std::string pcd_header(const std::vector<PcdField>& fields, std::size_t points, const std::string& data) {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const PcdField& field : fields) {
    names += " " + field.name;
    types += std::string(" ") + field.type[0];
    sizes += std::string(" ") + field.type[1];
    counts += " " + std::to_string(field.count);
  }
  const std::string n = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + names + "\n" + sizes + "\n" + types + "\n" +
         counts + "\nWIDTH " + n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

/// Compresses as liblzf would, only less well: greedy search over all distances.
inline std::string compress_lzf(std::string_view in) {
  std::string out, literals;
  const auto flush = [&] {
    for (std::size_t i = 0; i < literals.size(); i += 32) {
      const std::string run = literals.substr(i, 32);
      out += static_cast<char>(run.size() - 1);
      out += run;
    }
    literals.clear();
  };
  for (std::size_t i = 0; i < in.size();) {
    std::size_t best_length = 0, best_distance = 0;
    for (std::size_t distance = 1; distance <= std::min<std::size_t>(i, 8192); ++distance) {
      std::size_t length = 0;
      while (length < 264 && i + length < in.size() && in[i + length] == in[i + length - distance]) ++length;
      if (length > best_length) best_length = length, best_distance = distance;
    }
    if (best_length < 3) {
      literals += in[i++];
      continue;
    }
    flush();
    const std::size_t length_code = best_length - 2, distance_code = best_distance - 1;
    out += static_cast<char>(std::min<std::size_t>(length_code, 7) << 5 | distance_code >> 8);
    if (length_code >= 7) out += static_cast<char>(length_code - 7);
    out += static_cast<char>(distance_code & 255);
    i += best_length;
  }
  flush();
  return out;
}

inline std::string compressed_body(std::string_view bytes) {
  const std::string packed = compress_lzf(bytes);
  std::string out;
  append_number<std::uint32_t>(out, static_cast<double>(packed.size()));
  append_number<std::uint32_t>(out, static_cast<double>(bytes.size()));
  return out + packed;
}

}  // namespace stairway::ipc::test
