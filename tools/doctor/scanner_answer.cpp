// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/scanner_answer.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "drivers/scip/unit_checks.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

constexpr std::uint64_t kEnoughScans = 40;
constexpr std::size_t kMaxTroubles = 10;
constexpr double kSlowShare = 0.95;

/// Gathers what the driver tells.
class Listener {
 public:
  void take(const ScipEvent& event) {
    if (const auto* device = std::get_if<ScipDeviceInfo>(&event)) answer.device = *device;
    if (const auto* scan = std::get_if<LaserScan>(&event)) take(*scan);
    if (const auto* trouble = std::get_if<ScipTroubleEvent>(&event)) take(*trouble);
  }
  bool is_done() const { return is_hopeless_ || answer.scans >= kEnoughScans; }

  ScannerAnswer answer;

 private:
  void take(const LaserScan& scan) {
    if (answer.scans++ == 0) first_ns_ = scan.first_beam_stamp_ns;
    answer.scan_duration_s = static_cast<double>(scan.first_beam_stamp_ns - first_ns_) * 1e-9;
  }
  void take(const ScipTroubleEvent& event) {
    // The firmware has a check of its own.
    if (event.trouble == ScipTrouble::OldFirmware) return;
    if (answer.troubles.size() < kMaxTroubles) answer.troubles.push_back(event.detail);
    is_hopeless_ = is_hopeless_ || event.trouble == ScipTrouble::SensorFault;
  }

  HostStamp first_ns_ = 0;
  bool is_hopeless_ = false;
};

std::string with_troubles(std::string text, const ScannerAnswer& answer) {
  if (!answer.troubles.empty()) text += ": " + answer.troubles.front();
  return text;
}

Check judge_device(const ScipDeviceInfo& device, const std::string& wanted_serial) {
  constexpr const char* kName = "scanner-answer";
  const VersionInfo& version = device.version;
  const std::string text = fmt::format("{}, serial {}", device.parameters.model, version.serial);
  if (!device.state.is_healthy()) {
    return failure(kName, fmt::format("{}, says \"{}\"", text, device.state.status), "switch its power off and on");
  }
  if (device.parameters.model.find("UTM-30LX") == std::string::npos) {
    return warning(kName, text + ", is no UTM-30LX", "the mount, the window and the clock are set for a UTM-30LX");
  }
  if (!wanted_serial.empty() && !is_same_serial(version.serial, wanted_serial)) {
    return failure(kName, text, "lidar.usb_serial asks for " + wanted_serial + ": plug that one in, or change it");
  }
  return ok(kName, text);
}

Check judge_firmware(const VersionInfo& version) {
  const std::string fault = firmware_warning(version.firmware);
  if (fault.empty()) return ok("scanner-firmware", version.firmware);
  return warning("scanner-firmware", fault, "watch the scanner's clock in health, and have it updated by the maker");
}

Check judge_stream(const ScannerAnswer& answer) {
  constexpr const char* kName = "scanner-stream";
  const double wanted_hz = answer.device->parameters.scan_speed_rpm / 60.0;
  if (answer.scans < 2 || answer.scan_duration_s <= 0.0) {
    return failure(kName, with_troubles(fmt::format("{} scans came", answer.scans), answer),
                   "let it warm up for 10 s after power-up and try again; check supply, cable and hub");
  }
  const double rate_hz = static_cast<double>(answer.scans - 1) / answer.scan_duration_s;
  const std::string text = fmt::format("{:.1f} scans/s", rate_hz);
  if (rate_hz < wanted_hz * kSlowShare) {
    return warning(kName, with_troubles(fmt::format("{} of {:.0f}", text, wanted_hz), answer),
                   "use another cable or a port without a hub");
  }
  return ok(kName, text);
}

}  // namespace

ScannerAnswer ask_scanner(PortOpener<BytePort> opener, Utm30lx::Clock now, const ScipOptions& options,
                          std::chrono::nanoseconds patience) {
  Listener listener;
  Utm30lx scanner(std::move(opener), now, options);
  for (const HostStamp end_ns = now() + patience.count(); now() < end_ns && !listener.is_done();) {
    for (const ScipEvent& event : scanner.poll(std::chrono::milliseconds(20))) listener.take(event);
  }
  return listener.answer;
}

std::vector<Check> judge(const ScannerAnswer& answer, const std::string& wanted_serial) {
  if (!answer.device) {
    return {failure("scanner-answer", with_troubles("cannot be asked", answer),
                    "switch its power off and on; let no other program use it")};
  }
  return {judge_device(*answer.device, wanted_serial), judge_firmware(answer.device->version), judge_stream(answer)};
}

}  // namespace stairway::doctor
