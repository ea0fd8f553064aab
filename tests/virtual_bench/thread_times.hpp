// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <map>
#include <string>

namespace stairway::bench {

/// Processor time of a process's threads so far, by their names [s]; empty when there is no such process.
std::map<std::string, double> thread_times_s(pid_t process);

}  // namespace stairway::bench
