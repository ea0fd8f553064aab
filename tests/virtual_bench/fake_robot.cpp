// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "tests/virtual_bench/order_socket.hpp"
#include "tests/virtual_bench/robot.hpp"
#include "tests/virtual_bench/scanner_cable.hpp"

namespace {

using namespace stairway;

std::string obey(bench::Robot& robot, const std::string& order) {
  const std::lock_guard lock(robot.mutex);
  if (order == "scanner streaming") return robot.scanner.is_streaming() ? "yes" : "no";
  return "unknown order: " + order;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A robot that speaks on the other side of the kernel's drivers.", "fake_robot");
  std::string table;
  std::string tty = "/dev/ttyGS0";
  std::string socket = "/run/fake_robot";
  app.add_option("--table", table, "What the scanner sees, from make_scan_table")->required()->type_name("FILE");
  app.add_option("--tty", tty, "The device side of the scanner's cable")->type_name("TTY");
  app.add_option("--socket", socket, "Where it takes orders")->type_name("PATH");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Robot robot(bench::ScanTable::read(table));
    const std::jthread scanner([&](std::stop_token stop) { bench::serve_scanner(robot, tty, stop); });
    std::puts("ready");
    std::fflush(stdout);
    bench::serve_orders(socket, [&](const std::string& order) { return obey(robot, order); }, {});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fake_robot: %s\n", error.what());
    return 1;
  }
  return 0;
}
