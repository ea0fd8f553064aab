// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/private_network.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace stairway::test {
namespace {

constexpr const char* kMark = "STAIRWAY_TEST_PRIVATE_NETWORK";

int run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

std::string unshare_options() { return ::geteuid() == 0 ? "-n" : "-rn"; }

bool is_listing(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]).starts_with("--gtest_list_tests")) return true;
  }
  return false;
}

// Becomes this program once more, inside a new network namespace.
void enter_private_network(char** argv) {
  ::setenv(kMark, "1", 1);
  const std::string options = unshare_options();
  std::vector<char*> command{const_cast<char*>("unshare"), const_cast<char*>(options.c_str())};
  for (char** argument = argv; *argument != nullptr; ++argument) command.push_back(*argument);
  command.push_back(nullptr);
  ::execvp("unshare", command.data());
  ::unsetenv(kMark);
}

}  // namespace

bool has_private_network() { return std::getenv(kMark) != nullptr; }

void add_multicast_route() { run("ip route add 224.0.0.0/4 dev lo"); }

void remove_multicast_route() { run("ip route del 224.0.0.0/4 dev lo"); }

}  // namespace stairway::test

int main(int argc, char** argv) {
  using namespace stairway::test;
  const bool is_permitted = run("unshare " + unshare_options() + " true") == 0;
  if (!has_private_network() && !is_listing(argc, argv) && is_permitted) enter_private_network(argv);
  if (has_private_network()) {
    run("ip link set lo up multicast on");
    add_multicast_route();
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
