// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/cloud_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "ipc/cloud/formats.hpp"
#include "ipc/cloud/text_lines.hpp"

namespace stairway::ipc {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

struct FileBytes {
  std::unique_ptr<char[]> data;  // not a string: that would write every byte twice
  std::size_t size = 0;
};

tl::unexpected<CloudFileError> error(CloudFileFault fault, std::string text) {
  return tl::unexpected(CloudFileError{fault, std::move(text)});
}

tl::expected<FileBytes, CloudFileError> read_bytes(const std::filesystem::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    return error(CloudFileFault::Unreadable, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) return error(CloudFileFault::Unreadable, "not a regular file");
  if (static_cast<std::uint64_t>(status.st_size) > kMaxCloudFileBytes) {
    return error(CloudFileFault::TooLarge,
                 fmt::format("{} bytes, more than the limit of {}", status.st_size, kMaxCloudFileBytes));
  }
  const auto capacity = static_cast<std::size_t>(status.st_size);
  FileBytes bytes{std::make_unique_for_overwrite<char[]>(capacity), 0};
  while (bytes.size < capacity) {
    const ssize_t got = ::read(file.get(), bytes.data.get() + bytes.size, capacity - bytes.size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return error(CloudFileFault::Unreadable, std::strerror(errno));
    if (got == 0) break;
    bytes.size += static_cast<std::size_t>(got);
  }
  return bytes;
}

CloudFileError with_path(const std::filesystem::path& path, const CloudFileError& error) {
  return {error.fault, fmt::format("{}: {}", path.string(), error.text)};
}

bool is_ply(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n"); }

bool is_pcd(std::string_view bytes) {
  for (const std::string_view start : {"# .PCD", "#.PCD", "VERSION", "FIELDS", "COLUMNS", "#"}) {
    if (bytes.starts_with(start)) return true;
  }
  return false;
}

using Encoder = std::string (*)(const scan::PointCloud&, const PointAttributes&);

tl::expected<void, CloudFileError> write_cloud(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                               const PointAttributes& attributes, Encoder encode) {
  const auto fits = [&](std::size_t length) { return length == 0 || length == cloud.points.size(); };
  if (!fits(attributes.colours.size()) || !fits(attributes.labels.size())) {
    return error(CloudFileFault::Unwritable,
                 fmt::format("{}: {} colours and {} labels for {} points", path.string(), attributes.colours.size(),
                             attributes.labels.size(), cloud.points.size()));
  }
  const std::string bytes = encode(cloud, attributes);
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    return error(CloudFileFault::Unwritable, fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  }
  return {};
}

}  // namespace

std::string_view to_string(CloudFileFault fault) {
  switch (fault) {
    case CloudFileFault::Unreadable:
      return "unreadable";
    case CloudFileFault::NotACloud:
      return "not-a-cloud";
    case CloudFileFault::Malformed:
      return "malformed";
    case CloudFileFault::Truncated:
      return "truncated";
    case CloudFileFault::TooLarge:
      return "too-large";
    case CloudFileFault::Unwritable:
      break;
  }
  return "unwritable";
}

tl::expected<LoadedCloud, CloudFileError> decode_cloud(std::string_view bytes) {
  if (bytes.empty()) return error(CloudFileFault::Truncated, "the file is empty");
  if (is_ply(bytes)) return cloud::decode_ply(bytes);
  if (is_pcd(bytes)) return cloud::decode_pcd(bytes);
  const std::string_view first_line = bytes.substr(0, bytes.find('\n'));
  return cloud::error_at_line(
      1, CloudFileFault::NotACloud,
      fmt::format("expected a PCD ('# .PCD' or 'VERSION') or PLY ('ply') file, found {}", cloud::quoted(first_line)));
}

tl::expected<LoadedCloud, CloudFileError> read_cloud_file(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path);
  if (!bytes) return tl::unexpected(with_path(path, bytes.error()));
  auto loaded = decode_cloud({bytes->data.get(), bytes->size});
  if (!loaded) return tl::unexpected(with_path(path, loaded.error()));
  return loaded;
}

tl::expected<void, CloudFileError> write_pcd(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                             const PointAttributes& attributes) {
  return write_cloud(path, cloud, attributes, cloud::encode_pcd);
}

tl::expected<void, CloudFileError> write_ply(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                             const PointAttributes& attributes) {
  return write_cloud(path, cloud, attributes, cloud::encode_ply);
}

}  // namespace stairway::ipc
