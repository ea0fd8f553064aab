// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <string>

#include "tests/virtual_bench/machine.hpp"

namespace stairway::bench {
namespace {

// Prints what edge_rate prints.
std::string run_edge_rate(const std::string& arguments) {
  std::FILE* pipe = ::popen((std::string(EDGE_RATE) + " --chip " + Rig::kEncoderChip + " " + arguments).c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  char line[256];
  while (std::fgets(line, sizeof(line), pipe) != nullptr) text += line;
  EXPECT_EQ(::pclose(pipe), 0);
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
  return text;
}

// By the kernel's interface a reader that was away for longer than the queue lasts knows what it missed. On a busy host
// it is away without meaning to.
void expect_no_untold_loss(const std::string& table) {
  std::istringstream rows(table);
  int measured = 0;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream fields(row);
    std::string access, wanted, reached;
    int stall_ms = 0, sent = 0, missing = 0, told = 0;
    if (!(fields >> access >> stall_ms >> wanted >> reached >> sent >> missing >> told) || access != "kernel") continue;
    ++measured;
    EXPECT_TRUE(missing == 0 || told > 0) << row;
  }
  EXPECT_GT(measured, 0);
}

// On the lines of the robot's encoder, which is kept still.
class EdgeRate : public testing::Test {
 protected:
  EdgeRate() { machine_.order("encoder dead"); }
  ~EdgeRate() override {
    machine_.order("encoder mend");
    machine_.rig().remove_encoder_chip();
    machine_.rig().add_encoder_chip();
  }
  std::string lines() { return "--lines " + machine_.rig().encoder_lines().string(); }

  Machine& machine_ = Machine::get();
};

TEST_F(EdgeRate, no_edge_is_lost_untold_as_fast_as_they_come) {
  expect_no_untold_loss(run_edge_rate(lines() + " --rate 0"));
}

class LongRunEdgeRate : public EdgeRate {};

TEST_F(LongRunEdgeRate, no_edge_is_lost_untold_at_any_rate) { expect_no_untold_loss(run_edge_rate(lines())); }

}  // namespace
}  // namespace stairway::bench
