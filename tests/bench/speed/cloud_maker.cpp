// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// Writes the clouds that the programs of the benchmark read.
// Usage: cloud_maker FILE sweep | cloud_maker FOLDER tower POINTS...
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ipc/cloud_file.hpp"
#include "tests/bench/speed/clouds.hpp"

namespace stairway::bench {
namespace {

void write(const std::filesystem::path& path, const scan::PointCloud& cloud) {
  if (const auto written = ipc::write_pcd(path, cloud); !written) throw std::runtime_error(written.error().text);
}

// The largest comes first and is cut for the others.
void write_tower(const std::filesystem::path& folder, const std::vector<std::size_t>& falling) {
  scan::PointCloud cloud = walk_through_tower(falling.front());
  for (const std::size_t points : falling) {
    cloud.points.resize(points);
    write(folder / ("tower-" + std::to_string(points) + ".pcd"), cloud);
  }
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2 && arguments[1] == "sweep") return write(arguments[0], take_sweep());
  if (arguments.size() < 3 || arguments[1] != "tower") throw std::invalid_argument("see the usage in the source");
  std::vector<std::size_t> sizes;
  for (std::size_t i = 2; i < arguments.size(); ++i) sizes.push_back(std::stoul(arguments[i]));
  std::sort(sizes.rbegin(), sizes.rend());
  write_tower(arguments[0], sizes);
}

}  // namespace
}  // namespace stairway::bench

int main(int argc, char** argv) {
  try {
    stairway::bench::run({argv + 1, argv + argc});
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "cloud_maker: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
