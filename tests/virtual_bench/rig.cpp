// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/rig.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace stairway::bench {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kDrivers = "gpio-sim vcan can_raw cdc_acm usb_f_acm dummy_hcd";
constexpr std::array<std::string_view, 3> kEncoderLines{"disk-a", "disk-b", "disk-index"};
constexpr auto kPatience = 10s;

void run(const std::string& command) {
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

void write(const fs::path& file, std::string_view text) {
  std::ofstream out(file);
  out << text << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::string text;
  if (!std::getline(in, text)) throw std::runtime_error("cannot read " + file.string());
  return text;
}

void wait_for(const fs::path& file) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!fs::exists(file)) {
    if (std::chrono::steady_clock::now() >= end) throw std::runtime_error(file.string() + " does not appear");
    std::this_thread::sleep_for(10ms);
  }
}

}  // namespace

Rig::Rig(const fs::path& modules)
    : gadget_("/sys/kernel/config/usb_gadget/scanner"), chip_("/sys/kernel/config/gpio-sim/encoder") {
  run("modprobe -d " + modules.string() + " -a " + kDrivers);
  run("mountpoint -q /sys/kernel/config || mount -t configfs configfs /sys/kernel/config");
  run("systemd-sysusers " SYSTEMD_FILES "/stairway.sysusers");
  fs::copy(SYSTEMD_FILES "/60-stairway.rules", "/etc/udev/rules.d");
  run("/lib/systemd/systemd-udevd --daemon");
  run("udevadm control --ping");
  run("ip route add 224.0.0.0/4 dev lo");
  write("/proc/sys/net/core/rmem_max", "4194304");

  fs::create_directories(gadget_ / "strings/0x409");
  fs::create_directories(gadget_ / "configs/c.1");
  fs::create_directories(gadget_ / "functions/acm.0");
  write(gadget_ / "idVendor", "0x15d1");
  write(gadget_ / "idProduct", "0x0000");
  write(gadget_ / "bDeviceClass", "2");
  write(gadget_ / "strings/0x409/manufacturer", "Hokuyo Data Flex for USB");
  write(gadget_ / "strings/0x409/product", "URG-Series USB Driver");
  fs::create_directory_symlink(gadget_ / "functions/acm.0", gadget_ / "configs/c.1/acm.0");
  controller_ = fs::directory_iterator("/sys/class/udc")->path().filename();

  for (std::size_t line = 0; line < kEncoderLines.size(); ++line)
    fs::create_directories(chip_ / "bank" / ("line" + std::to_string(line)));
  write(chip_ / "bank/num_lines", std::to_string(kEncoderLines.size()));
  write(chip_ / "bank/label", kEncoderChip);
  for (std::size_t line = 0; line < kEncoderLines.size(); ++line)
    write(chip_ / "bank" / ("line" + std::to_string(line)) / "name", kEncoderLines[line]);
}

void Rig::plug_scanner() {
  write(gadget_ / "UDC", controller_);
  wait_for(kTty);
}

void Rig::unplug_scanner() { write(gadget_ / "UDC", ""); }

void Rig::add_bus() {
  run(std::string("ip link add ") + kBus + " type vcan");
  raise_bus();
}

void Rig::remove_bus() { run(std::string("ip link delete ") + kBus); }

void Rig::raise_bus() { run(std::string("ip link set ") + kBus + " up"); }

void Rig::lower_bus() { run(std::string("ip link set ") + kBus + " down"); }

void Rig::add_encoder_chip() {
  write(chip_ / "live", "1");
  wait_for("/dev/" + read(chip_ / "bank/chip_name"));
}

void Rig::remove_encoder_chip() { write(chip_ / "live", "0"); }

fs::path Rig::encoder_lines() const {
  return fs::path("/sys/devices/platform") / read(chip_ / "dev_name") / read(chip_ / "bank/chip_name");
}

}  // namespace stairway::bench
