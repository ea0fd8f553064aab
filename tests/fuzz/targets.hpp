// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/fuzz/fuzz_input.hpp"

namespace stairway::fuzz {

/// One thing to feed with inputs: `run` aborts when a promise is broken.
struct Target {
  const char* name;
  void (*run)(std::span<const std::uint8_t> input);
  std::vector<Seed> (*seeds)();  ///< made from the vectors of the protocol's documents
};

void run_scip(std::span<const std::uint8_t> input);
std::vector<Seed> scip_seeds();

void run_can(std::span<const std::uint8_t> input);
std::vector<Seed> can_seeds();

void run_quadrature(std::span<const std::uint8_t> input);
std::vector<Seed> quadrature_seeds();

void run_event_log(std::span<const std::uint8_t> input);
std::vector<Seed> event_log_seeds();

inline constexpr Target kTargets[] = {
    {"scip", run_scip, scip_seeds},
    {"can", run_can, can_seeds},
    {"quadrature", run_quadrature, quadrature_seeds},
    {"event_log", run_event_log, event_log_seeds},
};

}  // namespace stairway::fuzz
