// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "ipc/cloud/formats.hpp"
#include "ipc/cloud/lzf.hpp"
#include "ipc/cloud/points.hpp"
#include "ipc/cloud/text_lines.hpp"

namespace stairway::ipc::cloud {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files hold the numbers of a little-endian machine");

// Bounds that no real file comes near, so that sizes multiply without overflow.
constexpr std::size_t kMaxFields = 1000;
constexpr std::uint64_t kMaxCount = 1'000'000;
constexpr std::uint64_t kMaxPoints = (std::uint64_t{1} << 32) - 1;

struct Field {
  std::string_view name;
  std::uint64_t size = 0;
  char type = 'F';
  std::uint64_t count = 1;

  std::uint64_t bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  std::optional<std::uint64_t> width, height, points;
  std::array<float, 3> viewpoint{};
  std::string_view data;
  std::size_t data_line = 0;
};

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
  Words words;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
  return words;
}

/// The number behind a key, or the reason why there is none.
tl::expected<std::uint64_t, std::string> whole_number(std::string_view word, std::uint64_t min, std::uint64_t max) {
  std::uint64_t value = 0;
  if (parse_number(word, value) != std::errc{} || value < min || value > max) {
    return tl::unexpected(fmt::format("expected a whole number from {} to {}, found {}", min, max, quoted(word)));
  }
  return value;
}

std::string set_per_field(std::vector<Field>& fields, const Words& words, std::uint64_t Field::*member,
                          std::uint64_t max) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = whole_number(words[i + 1], 1, max);
    if (!value) return value.error();
    fields[i].*member = *value;
  }
  return {};
}

std::string set_types(std::vector<Field>& fields, const Words& words) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    if (word != "F" && word != "I" && word != "U") {
      return fmt::format("expected a type F, I or U, found {}", quoted(word));
    }
    fields[i].type = word[0];
  }
  return {};
}

std::string set_viewpoint(Header& header, const Words& words) {
  if (words.size() != 8) return "expected tx ty tz qw qx qy qz";
  for (std::size_t i = 0; i < 3; ++i) {
    double value = 0.0;
    if (parse_number(words[i + 1], value) != std::errc{}) {
      return fmt::format("expected a number, found {}", quoted(words[i + 1]));
    }
    header.viewpoint[i] = to_float(value);
  }
  return {};
}

/// Takes one header line; answers what is wrong with it, nothing if it is fine.
std::string set_entry(Header& header, const Words& words) {
  const std::string_view key = words[0];
  if (key == "VERSION") return {};
  if (key == "VIEWPOINT") return set_viewpoint(header, words);
  if (key == "FIELDS" || key == "COLUMNS") {
    if (words.size() - 1 > kMaxFields) return fmt::format("more than {} fields", kMaxFields);
    header.fields.clear();
    for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({.name = words[i]});
    return {};
  }
  if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
    if (words.size() != header.fields.size() + 1) {
      return fmt::format("expected {} values, one per field, found {}", header.fields.size(), words.size() - 1);
    }
    if (key == "SIZE") return set_per_field(header.fields, words, &Field::size, 8);
    if (key == "COUNT") return set_per_field(header.fields, words, &Field::count, kMaxCount);
    return set_types(header.fields, words);
  }
  if (words.size() != 2) return fmt::format("expected one value behind it, found {}", words.size() - 1);
  if (key == "DATA") {
    header.data = words[1];
    return {};
  }
  const auto number = whole_number(words[1], 0, kMaxPoints);
  if (!number) return number.error();
  (key == "WIDTH" ? header.width : key == "HEIGHT" ? header.height : header.points) = *number;
  return {};
}

bool is_header_key(std::string_view key) {
  constexpr std::array<std::string_view, 11> kKeys{"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                   "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

tl::expected<Header, CloudFileError> read_header(TextLines& lines) {
  Header header;
  while (const auto line = lines.next()) {
    const Words words = split(*line);
    if (words.empty() || words[0].front() == '#') continue;
    if (!is_header_key(words[0])) {
      return error_at_line(lines.line_number(), CloudFileFault::Malformed,
                           fmt::format("expected a PCD header line such as FIELDS or DATA, found {}", quoted(*line)));
    }
    if (const std::string problem = set_entry(header, words); !problem.empty()) {
      return error_at_line(lines.line_number(), CloudFileFault::Malformed, fmt::format("{}: {}", words[0], problem));
    }
    if (words[0] == "DATA") {
      header.data_line = lines.line_number();
      return header;
    }
  }
  return error_at_line(lines.line_number(), CloudFileFault::Truncated, "the file ends within the header, before DATA");
}

std::optional<ScalarType> scalar_type(const Field& field) {
  const bool is_signed = field.type == 'I';
  if (field.type == 'F') {
    if (field.size == 4) return ScalarType::F32;
    if (field.size == 8) return ScalarType::F64;
    return std::nullopt;
  }
  switch (field.size) {
    case 1:
      return is_signed ? ScalarType::I8 : ScalarType::U8;
    case 2:
      return is_signed ? ScalarType::I16 : ScalarType::U16;
    case 4:
      return is_signed ? ScalarType::I32 : ScalarType::U32;
    case 8:
      return is_signed ? ScalarType::I64 : ScalarType::U64;
    default:
      return std::nullopt;
  }
}

/// The fields that are x, y and z, or the reason why they cannot be used.
tl::expected<std::array<std::size_t, 3>, std::string> find_axes(const std::vector<Field>& fields) {
  std::array<std::size_t, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view name = std::string_view("xyz").substr(axis, 1);
    const auto is_named = [&](const Field& field) { return field.name == name; };
    const auto found = std::find_if(fields.begin(), fields.end(), is_named);
    if (found == fields.end()) return tl::unexpected(fmt::format("FIELDS has no {}", name));
    if (std::count_if(fields.begin(), fields.end(), is_named) > 1) {
      return tl::unexpected(fmt::format("FIELDS names {} twice", name));
    }
    if (found->count != 1) return tl::unexpected(fmt::format("COUNT of {} is {}, expected 1", name, found->count));
    if (!scalar_type(*found)) {
      return tl::unexpected(fmt::format("{} has TYPE {} and SIZE {}, expected F 4, F 8, or I or U with 1, 2, 4 or 8",
                                        name, found->type, found->size));
    }
    axes[axis] = static_cast<std::size_t>(found - fields.begin());
  }
  return axes;
}

tl::expected<std::uint64_t, std::string> point_count(const Header& header) {
  if (header.width.has_value() != header.height.has_value())
    return tl::unexpected(std::string("WIDTH or HEIGHT is missing"));
  if (!header.width) {
    if (!header.points) return tl::unexpected(std::string("neither POINTS nor WIDTH and HEIGHT are given"));
    return *header.points;
  }
  const std::uint64_t area = *header.width * *header.height;
  if (header.points && *header.points != area) {
    return tl::unexpected(fmt::format("POINTS is not WIDTH times HEIGHT ({} times {})", *header.width, *header.height));
  }
  return area;
}

std::uint64_t bytes_per_point(const Header& header) {
  std::uint64_t bytes = 0;
  for (const Field& field : header.fields) bytes += field.bytes();
  return bytes;
}

struct Body {
  std::string_view bytes;
  std::size_t offset = 0;  ///< of `bytes` in the file
  std::uint64_t points = 0;
};

/// Locates the three axes in data of `stride` bytes per point (or, `by_field`, one field of all points after another).
std::array<Column, 3> columns(const Header& header, const std::array<std::size_t, 3>& axes, const Body& body,
                              bool by_field) {
  const std::uint64_t stride = bytes_per_point(header);
  std::array<Column, 3> xyz;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < axes[axis]; ++i) offset += header.fields[i].bytes();
    const Field& field = header.fields[axes[axis]];
    xyz[axis] = Column{.first = body.bytes.data() + offset * (by_field ? body.points : 1),
                       .stride = by_field ? field.size : stride,
                       .type = scalar_type(field).value_or(ScalarType::F32),
                       .big_endian = false};
  }
  return xyz;
}

tl::expected<LoadedCloud, CloudFileError> read_binary(const Header& header, const std::array<std::size_t, 3>& axes,
                                                      const Body& body) {
  const std::uint64_t stride = bytes_per_point(header);
  if (body.points > body.bytes.size() / stride) {
    return error_at_byte(body.offset, CloudFileFault::Truncated,
                         fmt::format("the header declares {} points of {} bytes, but only {} bytes follow", body.points,
                                     stride, body.bytes.size()));
  }
  return gather_points(columns(header, axes, body, false), body.points);
}

tl::expected<LoadedCloud, CloudFileError> read_compressed(const Header& header, const std::array<std::size_t, 3>& axes,
                                                          const Body& body) {
  constexpr std::size_t kSizesBytes = 2 * sizeof(std::uint32_t);
  const auto truncated = [&](std::string_view what) {
    return error_at_byte(body.offset, CloudFileFault::Truncated, what);
  };
  if (body.bytes.size() < kSizesBytes) {
    if (body.points == 0) return LoadedCloud{};
    return truncated("the file ends within the sizes of the compressed data");
  }
  std::uint32_t packed_size = 0;
  std::uint32_t size = 0;
  std::memcpy(&packed_size, body.bytes.data(), sizeof packed_size);
  std::memcpy(&size, body.bytes.data() + sizeof packed_size, sizeof size);
  const std::string_view packed = body.bytes.substr(kSizesBytes);
  if (packed_size > packed.size()) {
    return truncated(fmt::format("{} compressed bytes are declared, but only {} follow", packed_size, packed.size()));
  }
  const std::uint64_t stride = bytes_per_point(header);
  if (body.points > size / stride || body.points * stride != size) {
    return error_at_byte(body.offset, CloudFileFault::Malformed,
                         fmt::format("{} expanded bytes are declared, but {} points of {} bytes need another number",
                                     size, body.points, stride));
  }
  if (size / kMaxLzfRatio > packed_size) {
    return truncated(fmt::format("{} compressed bytes cannot expand to {}", packed_size, size));
  }
  const auto expanded = expand_lzf(packed.substr(0, packed_size), size);
  if (!expanded) return error_at_byte(body.offset + kSizesBytes, CloudFileFault::Malformed, expanded.error());
  return gather_points(columns(header, axes, {*expanded, 0, body.points}, true), body.points);
}

tl::expected<LoadedCloud, CloudFileError> read_ascii(TextLines& lines, const Header& header,
                                                     const std::array<std::size_t, 3>& axes, std::uint64_t points) {
  std::vector<RowItem> row(header.fields.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i].repeat = header.fields[i].count;
  for (std::size_t axis = 0; axis < 3; ++axis) row[axes[axis]].axis = static_cast<int>(axis);
  return read_rows(lines, row, points);
}

}  // namespace

tl::expected<LoadedCloud, CloudFileError> decode_pcd(std::string_view bytes) {
  TextLines lines(bytes);
  const auto header = read_header(lines);
  if (!header) return tl::unexpected(header.error());
  const auto refuse = [&](std::string_view text) {
    return error_at_line(header->data_line, CloudFileFault::Malformed, text);
  };
  for (const Field& field : header->fields) {
    if (field.size == 0) return refuse("the header has no SIZE");
  }
  const auto axes = find_axes(header->fields);
  if (!axes) return refuse(axes.error());
  const auto points = point_count(*header);
  if (!points) return refuse(points.error());

  const Body body{lines.rest(), lines.offset(), *points};
  auto loaded = header->data == "ascii"               ? read_ascii(lines, *header, *axes, *points)
                : header->data == "binary"            ? read_binary(*header, *axes, body)
                : header->data == "binary_compressed" ? read_compressed(*header, *axes, body)
                                                      : refuse(fmt::format("expected DATA ascii, binary or "
                                                                           "binary_compressed, found {}",
                                                                           quoted(header->data)));
  if (!loaded) return loaded;
  const Eigen::Vector3f origin(header->viewpoint.data());
  if (origin.allFinite() && !origin.isZero(0.0F)) loaded->cloud.sensor_origin = origin;
  return loaded;
}

std::string encode_pcd(const scan::PointCloud& cloud, const PointAttributes& attributes) {
  const bool has_rgb = !attributes.colours.empty();
  const bool has_label = !attributes.labels.empty();
  const std::string_view rgb_type = has_rgb ? " U" : "";
  const std::string_view label_type = has_label ? " U" : "";
  const std::string_view rgb_4 = has_rgb ? " 4" : "";
  const std::string_view label_4 = has_label ? " 4" : "";
  const std::string_view rgb_1 = has_rgb ? " 1" : "";
  const std::string_view label_1 = has_label ? " 1" : "";
  const Eigen::Vector3f origin = cloud.sensor_origin.value_or(Eigen::Vector3f::Zero());
  const std::size_t count = cloud.points.size();
  std::string out = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z{}{}\nSIZE 4 4 4{}{}\nTYPE F F F{}{}\n"
      "COUNT 1 1 1{}{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT {} {} {} 1 0 0 0\nPOINTS {}\nDATA binary\n",
      has_rgb ? " rgb" : "", has_label ? " label" : "", rgb_4, label_4, rgb_type, label_type, rgb_1, label_1, count,
      origin.x(), origin.y(), origin.z(), count);

  out.reserve(out.size() + count * (12 + (has_rgb ? 4 : 0) + (has_label ? 4 : 0)));
  const auto append = [&out](const void* data, std::size_t size) { out.append(static_cast<const char*>(data), size); };
  for (std::size_t i = 0; i < count; ++i) {
    append(cloud.points[i].data(), 12);
    if (has_rgb) {
      const auto [red, green, blue] = attributes.colours[i];
      const std::uint32_t packed = std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | std::uint32_t{blue};
      append(&packed, sizeof packed);
    }
    if (has_label) append(&attributes.labels[i], sizeof(std::uint32_t));
  }
  return out;
}

}  // namespace stairway::ipc::cloud
