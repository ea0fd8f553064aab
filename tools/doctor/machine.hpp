// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stairway::doctor {

/// The files by which Linux shows its devices, processes and set-up. Whatever cannot be read counts as absent: nothing
/// here throws or fails.
class Machine {
 public:
  /// @param root  in the place of "/", for tests.
  explicit Machine(std::filesystem::path root = "/") : root_(std::move(root)) {}

  /// @param absolute  e.g. "/sys/bus/usb/devices".
  std::filesystem::path path(std::string_view absolute) const;
  bool has(std::string_view absolute) const;

  /// The first line of a file, without trailing space.
  std::optional<std::string> line(std::string_view absolute) const;
  std::vector<std::string> lines(std::string_view absolute) const;  ///< at most 10000
  /// The whole number that a file begins with, e.g. of /proc/sys.
  std::optional<std::int64_t> number(std::string_view absolute) const;
  /// Names in a folder, sorted.
  std::vector<std::string> names(std::string_view absolute) const;
  /// The last part of what a symbolic link points at.
  std::optional<std::string> link_name(std::string_view absolute) const;

 private:
  std::filesystem::path root_;
};

/// A device's file and who may use it.
struct NodeFacts {
  std::string path;  ///< as the kernel knows it, e.g. "/dev/gpiochip0"
  bool exists = false;
  bool is_usable = false;  ///< whoever asks may read and write it
  std::string group;       ///< by name, or by number when it has none
  bool is_open_to_group = false;
};
NodeFacts look_at_node(const Machine& machine, const std::string& path);

/// The name of a group in /etc/group.
std::optional<std::string> group_name(const Machine& machine, gid_t id);
std::optional<gid_t> group_id(const Machine& machine, std::string_view name);

/// A running program, by the name the kernel keeps (at most 15 characters).
struct ProcessFacts {
  int id = 0;
  std::string name;
};
std::vector<ProcessFacts> processes_named(const Machine& machine, std::string_view name);
/// Those that have `node` open; processes of others are only seen by root.
std::vector<ProcessFacts> processes_holding(const Machine& machine, const std::string& node);
std::string to_string(const ProcessFacts& process);  ///< "name (process 12)"

/// Whoever runs the doctor.
struct Caller {
  bool is_root = false;
  std::vector<std::string> groups;  ///< by name
  bool is_in(std::string_view group) const;
};
Caller look_at_caller(const Machine& machine);

}  // namespace stairway::doctor
