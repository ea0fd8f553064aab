// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/experiment.hpp"

namespace stairway::bench {

/// The parts of the benchmark. Each works in the folder Request::data and runs programs in processes of their own, so
/// that none is helped or slowed by what another one left behind. `share` lessens rounds and sizes.
evaluation::Result run_stages(const evaluation::Request& request);
evaluation::Result run_pcl(const evaluation::Request& request);
evaluation::Result run_growth(const evaluation::Request& request);
evaluation::Result run_process(const evaluation::Request& request);
evaluation::Result run_daemon(const evaluation::Request& request);

}  // namespace stairway::bench
