// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::drivers {

/// Whether two ways of writing a serial number mean the same unit: some firmware leaves the leading H or zeros out,
/// so "00903971", "0903971" and "H0903971" are one.
bool is_same_serial(std::string_view a, std::string_view b);

/// What is known against a UTM-30LX's firmware, from FIRM of VV, e.g. "P.1.05(17/Apr./2009)"; empty when nothing is, or
/// when it cannot be read. Field reports: 1.16.02 has a clock that runs wrong; before 1.18.01 intensities fail at wide
/// windows and QT is ignored at times.
std::string firmware_warning(std::string_view firmware);

}  // namespace stairway::drivers
