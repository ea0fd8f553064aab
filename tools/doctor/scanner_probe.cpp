// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tools/doctor/scanner.hpp"

namespace stairway::doctor {
namespace {

constexpr const char* kDevices = "/sys/bus/usb/devices";
constexpr const char* kHokuyo = "15d1";

void add_interface(const Machine& machine, const std::string& folder, UsbScanner& scanner) {
  scanner.drivers.push_back(machine.link_name(folder + "/driver").value_or(""));
  for (const std::string& tty : machine.names(folder + "/tty")) scanner.ttys.push_back(tty);
}

void add_holders(const Machine& machine, const std::string& node, UsbScanner& scanner) {
  for (ProcessFacts& process : processes_holding(machine, node)) {
    const auto is_same = [&](const ProcessFacts& other) { return other.id == process.id; };
    if (std::none_of(scanner.holders.begin(), scanner.holders.end(), is_same)) {
      scanner.holders.push_back(std::move(process));
    }
  }
}

UsbScanner look_at(const Machine& machine, const std::string& port, const std::vector<std::string>& all) {
  const std::string folder = std::string(kDevices) + "/" + port;
  UsbScanner scanner{.port = port, .product = machine.line(folder + "/product").value_or("")};
  const auto bus = machine.number(folder + "/busnum"), device = machine.number(folder + "/devnum");
  scanner.node = look_at_node(machine, fmt::format("/dev/bus/usb/{:03}/{:03}", bus.value_or(0), device.value_or(0)));
  for (const std::string& name : all) {
    if (name.starts_with(port + ":")) add_interface(machine, std::string(kDevices) + "/" + name, scanner);
  }
  add_holders(machine, scanner.node.path, scanner);
  for (const std::string& tty : scanner.ttys) add_holders(machine, "/dev/" + tty, scanner);
  return scanner;
}

}  // namespace

ScannerFacts look_for_scanners(const Machine& machine) {
  ScannerFacts facts{.has_usb = machine.has(kDevices)};
  const auto names = machine.names(kDevices);
  for (const std::string& name : names) {
    if (machine.line(std::string(kDevices) + "/" + name + "/idVendor") == kHokuyo) {
      facts.scanners.push_back(look_at(machine, name, names));
    }
  }
  return facts;
}

}  // namespace stairway::doctor
