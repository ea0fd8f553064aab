// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>
#include <vector>

#include "ipc/cloud/formats.hpp"
#include "ipc/cloud/points.hpp"
#include "ipc/cloud/text_lines.hpp"

namespace stairway::ipc::cloud {
namespace {

struct Property {
  int axis = kSkipped;
  ScalarType type = ScalarType::F32;  ///< of the value, or of a list's values
  std::optional<ScalarType> list_length_type;
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_list() const {
    for (const Property& property : properties) {
      if (property.list_length_type) return true;
    }
    return false;
  }
  std::size_t stride() const {  ///< bytes of one; only without lists
    std::size_t bytes = 0;
    for (const Property& property : properties) bytes += size_of(property.type);
    return bytes;
  }
};

enum class Encoding { Ascii, LittleEndian, BigEndian };

struct Header {
  std::optional<Encoding> encoding;
  std::vector<Element> elements;
  std::size_t end_line = 0;
};

std::optional<ScalarType> scalar_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, ScalarType>, 20> kTypes{{
      {"char", ScalarType::I8},     {"int8", ScalarType::I8},     {"uchar", ScalarType::U8},
      {"uint8", ScalarType::U8},    {"short", ScalarType::I16},   {"int16", ScalarType::I16},
      {"ushort", ScalarType::U16},  {"uint16", ScalarType::U16},  {"int", ScalarType::I32},
      {"int32", ScalarType::I32},   {"uint", ScalarType::U32},    {"uint32", ScalarType::U32},
      {"float", ScalarType::F32},   {"float32", ScalarType::F32}, {"double", ScalarType::F64},
      {"float64", ScalarType::F64}, {"int64", ScalarType::I64},   {"uint64", ScalarType::U64},
      {"long", ScalarType::I64},    {"ulong", ScalarType::U64},
  }};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::string set_format(Header& header, std::string_view rest) {
  const std::string_view name = take_word(rest);
  if (name == "ascii") {
    header.encoding = Encoding::Ascii;
  } else if (name == "binary_little_endian") {
    header.encoding = Encoding::LittleEndian;
  } else if (name == "binary_big_endian") {
    header.encoding = Encoding::BigEndian;
  } else {
    return fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", quoted(name));
  }
  return {};
}

std::string add_element(Header& header, std::string_view rest) {
  Element element;
  element.name = take_word(rest);
  const std::string_view count = take_word(rest);
  if (element.name.empty() || parse_number(count, element.count) != std::errc{}) {
    return fmt::format("expected a name and a count, found {}", quoted(count));
  }
  header.elements.push_back(element);
  return {};
}

int axis_of(const Element& element, std::string_view name) {
  if (element.name != "vertex" || name.size() != 1) return kSkipped;
  const std::size_t axis = std::string_view("xyz").find(name);
  return axis == std::string_view::npos ? kSkipped : static_cast<int>(axis);
}

std::string add_property(Header& header, std::string_view rest) {
  if (header.elements.empty()) return "stands before the first element";
  Element& element = header.elements.back();
  Property property;
  std::string_view type_name = take_word(rest);
  if (type_name == "list") {
    property.list_length_type = scalar_type(take_word(rest));
    if (!property.list_length_type || *property.list_length_type >= ScalarType::F32) {
      return "the length of a list must be of an integer type";
    }
    type_name = take_word(rest);
  }
  const auto type = scalar_type(type_name);
  if (!type) return fmt::format("expected a type such as float or uchar, found {}", quoted(type_name));
  property.type = *type;
  const std::string_view name = take_word(rest);
  if (name.empty()) return "has no name";
  property.axis = axis_of(element, name);
  if (property.axis != kSkipped && property.list_length_type) return fmt::format("{} must not be a list", name);
  for (const Property& other : element.properties) {
    if (property.axis != kSkipped && other.axis == property.axis) return fmt::format("names {} twice", name);
  }
  element.properties.push_back(property);
  return {};
}

tl::expected<Header, CloudFileError> read_header(TextLines& lines) {
  Header header;
  lines.next();  // "ply": whoever called has seen it
  while (const auto line = lines.next()) {
    std::string_view rest = *line;
    const std::string_view key = take_word(rest);
    if (key.empty() || key == "comment" || key == "obj_info") continue;
    if (key == "end_header") {
      header.end_line = lines.line_number();
      return header;
    }
    const std::string problem = key == "format"     ? set_format(header, rest)
                                : key == "element"  ? add_element(header, rest)
                                : key == "property" ? add_property(header, rest)
                                                    : "expected format, comment, element, property or end_header";
    if (!problem.empty()) {
      return error_at_line(lines.line_number(), CloudFileFault::Malformed, fmt::format("{}: {}", quoted(key), problem));
    }
  }
  return error_at_line(lines.line_number(), CloudFileFault::Truncated,
                       "the file ends within the header, before end_header");
}

/// Walks through binary elements; every step checks that its bytes are there.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::size_t file_offset, bool big_endian)
      : bytes_(bytes), file_offset_(file_offset), big_endian_(big_endian) {}

  tl::expected<void, CloudFileError> skip(const Element& element) {
    if (element.properties.empty()) return {};
    if (!element.has_list()) return skip_records(element);
    Eigen::Vector3f ignored;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (auto walked = walk(element, i, ignored); !walked) return walked;
    }
    return {};
  }

  tl::expected<LoadedCloud, CloudFileError> read_vertices(const Element& element) {
    if (!element.has_list()) {
      const std::size_t first = position_;
      if (auto skipped = skip_records(element); !skipped) return tl::unexpected(skipped.error());
      return gather_points(columns(element, first), element.count);
    }
    LoadedCloud loaded;
    Eigen::Vector3f point;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (auto walked = walk(element, i, point); !walked) return tl::unexpected(walked.error());
      add_point(loaded, point);
    }
    return loaded;
  }

 private:
  std::size_t left() const { return bytes_.size() - position_; }

  tl::expected<void, CloudFileError> skip_records(const Element& element) {
    const std::size_t stride = element.stride();
    if (element.count > left() / stride) {
      return error_at_byte(file_offset_ + position_, CloudFileFault::Truncated,
                           fmt::format("the header declares {} {} elements of {} bytes, but only {} bytes follow",
                                       element.count, quoted(element.name), stride, left()));
    }
    position_ += element.count * stride;
    return {};
  }

  std::array<Column, 3> columns(const Element& element, std::size_t first) const {
    std::array<Column, 3> xyz;
    std::size_t offset = first;
    for (const Property& property : element.properties) {
      if (property.axis != kSkipped) {
        xyz[static_cast<std::size_t>(property.axis)] = {bytes_.data() + offset, element.stride(), property.type,
                                                        big_endian_};
      }
      offset += size_of(property.type);
    }
    return xyz;
  }

  tl::expected<void, CloudFileError> walk(const Element& element, std::uint64_t index, Eigen::Vector3f& point) {
    const auto truncated = [&] {
      return error_at_byte(file_offset_ + position_, CloudFileFault::Truncated,
                           fmt::format("the file ends within {} {} of {}", quoted(element.name), index, element.count));
    };
    for (const Property& property : element.properties) {
      const std::size_t size = size_of(property.type);
      std::size_t values = 1;
      if (property.list_length_type) {
        const std::size_t length_size = size_of(*property.list_length_type);
        if (left() < length_size) return truncated();
        const double length = load_scalar(bytes_.data() + position_, *property.list_length_type, big_endian_);
        if (length < 0.0) {
          return error_at_byte(file_offset_ + position_, CloudFileFault::Malformed,
                               fmt::format("a list of {} has the length {}", quoted(element.name), length));
        }
        position_ += length_size;
        if (length > static_cast<double>(left() / size)) return truncated();
        values = static_cast<std::size_t>(length);
      }
      if (values > left() / size) return truncated();
      if (property.axis != kSkipped) {
        point[property.axis] = to_float(load_scalar(bytes_.data() + position_, property.type, big_endian_));
      }
      position_ += values * size;
    }
    return {};
  }

  std::string_view bytes_;
  std::size_t file_offset_;
  bool big_endian_;
  std::size_t position_ = 0;
};

bool has_all_axes(const Element& vertex) {
  int axes = 0;
  for (const Property& property : vertex.properties) axes += property.axis != kSkipped ? 1 : 0;
  return axes == 3;
}

tl::expected<LoadedCloud, CloudFileError> read_ascii(TextLines& lines, const Header& header, std::size_t vertex_index) {
  for (std::size_t i = 0; i < vertex_index; ++i) {
    const Element& element = header.elements[i];
    if (element.properties.empty()) continue;
    for (std::uint64_t skipped = 0; skipped < element.count;) {
      const auto line = lines.next();
      if (!line) {
        return error_at_line(
            lines.line_number(), CloudFileFault::Truncated,
            fmt::format("the file ends after {} of {} {} elements", skipped, element.count, quoted(element.name)));
      }
      std::string_view rest = *line;
      skipped += take_word(rest).empty() ? 0 : 1;
    }
  }
  const Element& vertex = header.elements[vertex_index];
  std::vector<RowItem> row;
  for (const Property& property : vertex.properties) {
    row.push_back({.axis = property.axis, .repeat = 1, .is_list = property.list_length_type.has_value()});
  }
  return read_rows(lines, row, vertex.count);
}

}  // namespace

tl::expected<LoadedCloud, CloudFileError> decode_ply(std::string_view bytes) {
  TextLines lines(bytes);
  const auto header = read_header(lines);
  if (!header) return tl::unexpected(header.error());
  const auto refuse = [&](std::string_view text) {
    return error_at_line(header->end_line, CloudFileFault::Malformed, text);
  };
  if (!header->encoding) return refuse("the header has no format line");
  std::size_t vertex = 0;
  while (vertex < header->elements.size() && header->elements[vertex].name != "vertex") ++vertex;
  if (vertex == header->elements.size()) return refuse("the header has no element vertex");
  if (!has_all_axes(header->elements[vertex])) return refuse("the element vertex lacks a property x, y or z");

  if (header->encoding == Encoding::Ascii) return read_ascii(lines, *header, vertex);
  BinaryReader reader(lines.rest(), lines.offset(), header->encoding == Encoding::BigEndian);
  for (std::size_t i = 0; i < vertex; ++i) {
    if (auto skipped = reader.skip(header->elements[i]); !skipped) return tl::unexpected(skipped.error());
  }
  return reader.read_vertices(header->elements[vertex]);
}

std::string encode_ply(const scan::PointCloud& cloud, const PointAttributes& attributes) {
  static_assert(std::endian::native == std::endian::little);
  const bool has_rgb = !attributes.colours.empty();
  const bool has_label = !attributes.labels.empty();
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "{}{}end_header\n",
      cloud.points.size(), has_rgb ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
      has_label ? "property uint label\n" : "");
  out.reserve(out.size() + cloud.points.size() * (12 + (has_rgb ? 3 : 0) + (has_label ? 4 : 0)));
  const auto append = [&out](const void* data, std::size_t size) { out.append(static_cast<const char*>(data), size); };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    append(cloud.points[i].data(), 12);
    if (has_rgb) append(attributes.colours[i].data(), 3);
    if (has_label) append(&attributes.labels[i], sizeof(std::uint32_t));
  }
  return out;
}

}  // namespace stairway::ipc::cloud
