// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "tests/virtual_bench/drive_cable.hpp"
#include "tests/virtual_bench/encoder_cable.hpp"
#include "tests/virtual_bench/order_socket.hpp"
#include "tests/virtual_bench/orders.hpp"
#include "tests/virtual_bench/robot.hpp"
#include "tests/virtual_bench/scanner_cable.hpp"

int main(int argc, char** argv) {
  using namespace stairway::bench;
  CLI::App app("A robot that speaks on the other side of the kernel's drivers.", "fake_robot");
  std::string table;
  std::string tty = "/dev/ttyGS0";
  std::string interface = "can0";
  std::string chip = "/sys/kernel/config/gpio-sim/encoder";
  std::string socket = "/run/fake_robot";
  std::string order;
  app.add_option("--table", table, "What the scanner sees, from make_scan_table")->type_name("FILE");
  app.add_option("--tty", tty, "The device side of the scanner's cable")->type_name("TTY");
  app.add_option("--can", interface, "The drive's bus")->type_name("INTERFACE");
  app.add_option("--chip", chip, "The encoder's chip in configfs")->type_name("FOLDER");
  app.add_option("--socket", socket, "Where it takes orders")->type_name("PATH");
  app.add_option("--order", order, "Gives this order to a robot that is running")->type_name("ORDER");
  app.footer("Orders:\n" + list_of_orders() + "\nExample: fake_robot --order 'drive fault'");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!order.empty()) {
      std::puts(send_order(socket, order).c_str());
      return 0;
    }
    Robot robot(ScanTable::read(table));
    const std::jthread scanner([&](std::stop_token stop) { serve_scanner(robot, tty, stop); });
    const std::jthread drive([&](std::stop_token stop) { serve_drive(robot, interface, stop); });
    const std::jthread encoder([&](std::stop_token stop) { serve_encoder(robot, chip, stop); });
    std::puts("ready");
    std::fflush(stdout);
    serve_orders(socket, [&](const std::string& text) { return obey(robot, text); }, {});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fake_robot: %s\n", error.what());
    return 1;
  }
  return 0;
}
