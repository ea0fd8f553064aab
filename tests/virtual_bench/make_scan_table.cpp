// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "tests/virtual_bench/scan_table.hpp"
#include "tools/sim/scene_file.hpp"

namespace {

// Neighbouring angles are 5 mm apart at 3 m.
constexpr std::size_t kRows = 4096;

}  // namespace

int main(int argc, char** argv) {
  using namespace stairway;
  if (argc != 3) {
    std::fputs("usage: make_scan_table SCENE FILE\n", stderr);
    return 2;
  }
  try {
    bench::ScanTable::measure(sim::build_scene(sim::load_scene(argv[1])), kRows).write(argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_scan_table: %s\n", error.what());
    return 1;
  }
  return 0;
}
