// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tools/doctor/scanner.hpp"

namespace stairway::doctor {
namespace {

constexpr std::string_view kRulesRemedy =
    "install 60-stairway.rules, then udevadm control --reload && udevadm trigger, or plug it in again";

std::string ports(const std::vector<UsbScanner>& scanners) {
  std::string text;
  for (const UsbScanner& scanner : scanners) text += (text.empty() ? "" : ", ") + scanner.port;
  return text;
}

const UsbScanner* choose(const ScannerFacts& facts, const WantedScanner& wanted) {
  for (const UsbScanner& scanner : facts.scanners) {
    if (wanted.port.empty() || scanner.port == wanted.port) return &scanner;
  }
  return nullptr;
}

Check judge_presence(const ScannerFacts& facts, const WantedScanner& wanted, const UsbScanner* chosen) {
  if (!facts.has_usb) {
    return failure("scanner", "this kernel shows no USB (/sys/bus/usb is missing)",
                   "run on a machine, or in a virtual machine, that has USB");
  }
  if (facts.scanners.empty()) {
    return failure("scanner", "no Hokuyo scanner on USB",
                   "check its 12 V supply (the LED is lit), cable and hub; lsusb -d 15d1: must list it");
  }
  if (chosen == nullptr) {
    return failure("scanner", fmt::format("no scanner at port {}, but at {}", wanted.port, ports(facts.scanners)),
                   "plug it in there, or change lidar.usb_port");
  }
  if (facts.scanners.size() > 1 && wanted.port.empty() && wanted.serial.empty()) {
    return warning("scanner", fmt::format("{} scanners, at ports {}", facts.scanners.size(), ports(facts.scanners)),
                   "say which one by lidar.usb_serial or lidar.usb_port");
  }
  const std::string product = chosen->product.empty() ? "a Hokuyo scanner" : chosen->product;
  return ok("scanner", fmt::format("{} at port {}", product, chosen->port));
}

Check judge_access(const UsbScanner& scanner, const Caller& caller) {
  const NodeFacts& node = scanner.node;
  if (!node.exists) {
    return failure("scanner-access", node.path + " is missing", "is udev running? systemctl status systemd-udevd");
  }
  const bool is_for_daemon = node.group == "stairway" && node.is_open_to_group;
  if (!is_for_daemon) {
    return failure("scanner-access", fmt::format("{} belongs to group {}, not stairway", node.path, node.group),
                   std::string(kRulesRemedy));
  }
  if (!node.is_usable && !caller.is_root) {
    return warning("scanner-access",
                   fmt::format("{} is open to group stairway, which you are {}", node.path,
                               caller.is_in("stairway") ? "in, but may not use it" : "not in"),
                   "stairwayd may use it; for yourself: usermod -aG stairway USER, then log in again");
  }
  return ok("scanner-access", fmt::format("{} is open to group stairway", node.path));
}

std::string names(const std::vector<ProcessFacts>& processes) {
  std::string text;
  for (const ProcessFacts& process : processes) text += (text.empty() ? "" : ", ") + to_string(process);
  return text;
}

Check judge_interfaces(const UsbScanner& scanner, bool has_daemon) {
  constexpr const char* kName = "scanner-interfaces";
  std::vector<ProcessFacts> others = scanner.holders;
  std::erase_if(others, [](const ProcessFacts& process) { return process.name == "stairwayd"; });
  if (!others.empty()) {
    return failure(kName, "opened by " + names(others), "end that program: a scanner answers one at a time");
  }
  const auto has_driver = [&](std::string_view name) {
    return std::find(scanner.drivers.begin(), scanner.drivers.end(), name) != scanner.drivers.end();
  };
  if (has_driver("usbfs")) {
    if (has_daemon) return ok(kName, "taken by stairwayd");
    return failure(kName, "taken by another program",
                   "end it; fuser -v " + scanner.node.path + ", run by root, says which one");
  }
  if (has_driver("cdc_acm")) return ok(kName, "with the kernel's cdc_acm, from which stairwayd takes them");
  return ok(kName, "free");
}

}  // namespace

std::vector<Check> judge(const ScannerFacts& facts, const WantedScanner& wanted, const Caller& caller,
                         bool has_daemon) {
  const UsbScanner* chosen = choose(facts, wanted);
  std::vector<Check> checks{judge_presence(facts, wanted, chosen)};
  if (chosen != nullptr) {
    checks.push_back(judge_access(*chosen, caller));
    checks.push_back(judge_interfaces(*chosen, has_daemon));
  }
  return checks;
}

}  // namespace stairway::doctor
