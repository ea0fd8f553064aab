// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/programs.hpp"

#include "tests/bench/speed/child_process.hpp"

namespace stairway::bench {

std::filesystem::path sweep_file(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "sweep.pcd";
  if (!std::filesystem::exists(path)) run_child({CLOUD_MAKER, path, "sweep"});
  return path;
}

std::vector<std::filesystem::path> tower_files(const std::filesystem::path& folder,
                                               const std::vector<std::size_t>& sizes) {
  std::vector<std::string> command{CLOUD_MAKER, folder, "tower"};
  std::vector<std::filesystem::path> files;
  for (const std::size_t size : sizes) {
    command.push_back(std::to_string(size));
    files.push_back(folder / ("tower-" + std::to_string(size) + ".pcd"));
  }
  run_child(command);
  return files;
}

RunReport run_detector(const std::filesystem::path& file, const std::string& cloud) {
  return report_from_json(run_child({DETECTOR_RUN, file, cloud}).output);
}

RunReport run_pcl_segmentation(const std::filesystem::path& file, const std::string& settings) {
  return report_from_json(run_child({PCL_RUN, file, settings}).output);
}

}  // namespace stairway::bench
