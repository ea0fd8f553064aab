// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "tests/integration/daemon_process.hpp"
#include "tests/integration/private_network.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 200s;
const std::vector<std::string> kDaemon{"--simulate=straight-flight", "--set", "simulate.speed=0", "--set",
                                       "disk.period_s=6"};

class Examples : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_private_network()) GTEST_SKIP() << "this kernel permits no network namespaces (unshare -n)";
    add_multicast_route();
  }
};

void expect_walks_to_the_stairway(DaemonProcess& example) {
  ASSERT_EQ(example.wait(kPatience), 0) << example.output();
  const std::string text = example.output();
  for (const char* part : {"stairway 1: straight, ascending, 10 steps, height 17", " mm, depth 2", "\n  go to (1.5",
                           ", face 0 deg, keep to ", ", walk up 10 steps\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

void run(const std::string& command, const std::string& log) {
  ASSERT_EQ(std::system((command + " >" + log + " 2>&1").c_str()), 0) << command << '\n' << read_text(log);
}

TEST_F(Examples, python_walks_to_the_stairway) {
  DaemonProcess example({STAIRWAY_SOURCE_DIR "/examples/python/stairways.py", "--count", "1"},
                        {"PYTHONPATH=" STAIRWAY_PYTHON_DIR, "PYTHONDONTWRITEBYTECODE=1"}, "/usr/bin/python3");
  DaemonProcess daemon(kDaemon);
  expect_walks_to_the_stairway(example);
}

TEST_F(Examples, cpp_is_built_from_what_is_installed_and_walks_to_the_stairway) {
  const TemporaryFolder folder;
  const std::string log = folder.path("log"), prefix = folder.path("usr"), build = folder.path("build");
  run("cmake --install " STAIRWAY_BUILD_DIR " --component development --prefix " + prefix, log);
  run("cmake -S " STAIRWAY_SOURCE_DIR "/examples/cpp -B " + build + " -DCMAKE_PREFIX_PATH=" + prefix, log);
  run("cmake --build " + build, log);
  DaemonProcess example({"1"}, {}, build + "/walk_to_stairways");
  DaemonProcess daemon(kDaemon);
  expect_walks_to_the_stairway(example);
}

}  // namespace
}  // namespace stairway::test
