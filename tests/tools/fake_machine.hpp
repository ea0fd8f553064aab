// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "tests/tools/temporary_folder.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::test {

/// A root folder with just the files that a test puts there.
class FakeMachine {
 public:
  doctor::Machine machine() const { return doctor::Machine(folder_.path()); }

  void file(const std::string& absolute, const std::string& text) { write_text(place(absolute), text); }
  void node(const std::string& absolute, unsigned mode) {
    file(absolute, "");
    ::chmod(place(absolute).c_str(), mode);
  }
  void link(const std::string& absolute, const std::string& target) {
    std::filesystem::create_symlink(target, place(absolute));
  }
  /// The group of every file here gets this name.
  void name_own_group(const std::string& name) {
    file("/etc/group", name + ":x:" + std::to_string(::getegid()) + ":\n");
  }
  void process(int id, const std::string& name, const std::string& open_file = "/dev/null") {
    const std::string folder = "/proc/" + std::to_string(id);
    file(folder + "/comm", name + "\n");
    std::filesystem::create_directories(place(folder + "/fd"));
    link(folder + "/fd/3", open_file);
  }

 private:
  std::string place(const std::string& absolute) {
    const auto path = folder_.path() / std::filesystem::path(absolute).relative_path();
    std::filesystem::create_directories(path.parent_path());
    return path.string();
  }

  TemporaryFolder folder_;
};

}  // namespace stairway::test
