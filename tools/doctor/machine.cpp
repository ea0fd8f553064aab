// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/machine.hpp"

#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

namespace stairway::doctor {
namespace {

constexpr std::size_t kMaxLines = 10'000;

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

template <typename Number>
std::optional<Number> leading_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  return value;
}

/// The fields of a line of /etc/passwd or /etc/group.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts{""};
  for (const char c : line) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back().push_back(c);
    }
  }
  return parts;
}

bool is_number(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<ProcessFacts> all_processes(const Machine& machine) {
  std::vector<ProcessFacts> found;
  for (const std::string& name : machine.names("/proc")) {
    if (!is_number(name)) continue;
    if (const auto comm = machine.line("/proc/" + name + "/comm")) found.push_back({std::stoi(name), *comm});
  }
  return found;
}

}  // namespace

std::filesystem::path Machine::path(std::string_view absolute) const {
  return root_ / std::filesystem::path(absolute).relative_path();
}

bool Machine::has(std::string_view absolute) const {
  std::error_code ignored;
  return std::filesystem::exists(path(absolute), ignored);
}

std::optional<std::string> Machine::line(std::string_view absolute) const {
  std::ifstream file(path(absolute));
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  return trimmed(std::move(text));
}

std::vector<std::string> Machine::lines(std::string_view absolute) const {
  std::ifstream file(path(absolute));
  std::vector<std::string> found;
  for (std::string text; found.size() < kMaxLines && std::getline(file, text);) found.push_back(text);
  return found;
}

std::optional<std::int64_t> Machine::number(std::string_view absolute) const {
  const auto text = line(absolute);
  return text ? leading_number<std::int64_t>(*text) : std::nullopt;
}

std::vector<std::string> Machine::names(std::string_view absolute) const {
  std::vector<std::string> found;
  std::error_code error;
  auto entry = std::filesystem::directory_iterator(path(absolute), error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    found.push_back(entry->path().filename().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<std::string> Machine::link_name(std::string_view absolute) const {
  std::error_code error;
  const auto target = std::filesystem::read_symlink(path(absolute), error);
  if (error) return std::nullopt;
  return target.filename().string();
}

NodeFacts look_at_node(const Machine& machine, const std::string& path) {
  NodeFacts facts{.path = path};
  const std::string place = machine.path(path).string();
  struct stat status {};
  if (::stat(place.c_str(), &status) != 0) return facts;
  facts.exists = true;
  facts.is_usable = ::access(place.c_str(), R_OK | W_OK) == 0;
  facts.group = group_name(machine, status.st_gid).value_or(std::to_string(status.st_gid));
  facts.is_open_to_group = (status.st_mode & (S_IRGRP | S_IWGRP)) == (S_IRGRP | S_IWGRP);
  return facts;
}

std::optional<std::string> group_name(const Machine& machine, gid_t id) {
  for (const std::string& line : machine.lines("/etc/group")) {
    const auto parts = fields(line);
    if (parts.size() >= 3 && leading_number<gid_t>(parts[2]) == id) return parts[0];
  }
  return std::nullopt;
}

std::optional<gid_t> group_id(const Machine& machine, std::string_view name) {
  for (const std::string& line : machine.lines("/etc/group")) {
    const auto parts = fields(line);
    if (parts.size() >= 3 && parts[0] == name) return leading_number<gid_t>(parts[2]);
  }
  return std::nullopt;
}

std::vector<ProcessFacts> processes_named(const Machine& machine, std::string_view name) {
  std::vector<ProcessFacts> found = all_processes(machine);
  std::erase_if(found, [&](const ProcessFacts& process) { return process.name != name; });
  return found;
}

std::vector<ProcessFacts> processes_holding(const Machine& machine, const std::string& node) {
  std::vector<ProcessFacts> found = all_processes(machine);
  std::erase_if(found, [&](const ProcessFacts& process) {
    const std::string folder = "/proc/" + std::to_string(process.id) + "/fd";
    const auto names = machine.names(folder);
    return std::none_of(names.begin(), names.end(), [&](const std::string& name) {
      std::error_code error;
      return std::filesystem::read_symlink(machine.path(folder + "/" + name), error) == node && !error;
    });
  });
  return found;
}

std::string to_string(const ProcessFacts& process) {
  return process.name + " (process " + std::to_string(process.id) + ")";
}

bool Caller::is_in(std::string_view group) const {
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

Caller look_at_caller(const Machine& machine) {
  Caller caller{.is_root = ::geteuid() == 0};
  std::vector<gid_t> ids(static_cast<std::size_t>(std::max(0, ::getgroups(0, nullptr))));
  ids.resize(static_cast<std::size_t>(std::max(0, ::getgroups(static_cast<int>(ids.size()), ids.data()))));
  ids.push_back(::getegid());
  for (const gid_t id : ids) {
    if (const auto name = group_name(machine, id)) caller.groups.push_back(*name);
  }
  return caller;
}

}  // namespace stairway::doctor
