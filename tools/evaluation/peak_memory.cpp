// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/peak_memory.hpp"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace stairway::evaluation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Lines such as "VmHWM:     12345 kB".
double status_MB(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":")) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  return kUnknown;
}

// Sets the peak back to what is held now (proc(5), clear_refs).
bool forget_peak() {
  std::ofstream clear("/proc/self/clear_refs");
  clear << '5' << std::flush;
  return clear.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  // Memory that is free but not given back would hide growth.
  malloc_trim(0);
  before_MB_ = forget_peak() ? status_MB("VmRSS") : kUnknown;
}

double PeakMemory::growth_MB() const { return status_MB("VmHWM") - before_MB_; }

}  // namespace stairway::evaluation
