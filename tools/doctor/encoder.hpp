// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/encoder/encoder_options.hpp"
#include "drivers/ports/edge_port.hpp"
#include "tools/doctor/check.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::doctor {

struct LineFacts {
  std::string signal;    ///< "A", "B" or "index"
  int offset = 0;        ///< on the chip
  std::string name;      ///< as the board calls it; often empty
  std::string consumer;  ///< of the program that has it
  bool is_used = false;
};

struct EncoderFacts {
  std::vector<std::string> chips;  ///< all there are, e.g. "gpiochip0"
  NodeFacts node;                  ///< of the wanted one
  std::string refusal;             ///< why chip or lines are not to be had, for a person; empty when they are
  std::vector<LineFacts> lines;    ///< of A, B and, where there is one, the index
};
EncoderFacts look_at_encoder(const Machine& machine, const drivers::EncoderOptions& options);

/// encoder, encoder-access, encoder-lines.
/// @param has_daemon  a stairwayd runs, so that taken lines are as they should be.
std::vector<Check> judge(const EncoderFacts& facts, const Caller& caller, bool has_daemon);

/// What the lines did while somebody looked.
struct CountFacts {
  double duration_s = 0.0;
  std::uint64_t a_edges = 0;
  std::uint64_t b_edges = 0;
  std::uint64_t index_edges = 0;
  std::uint64_t lost_edges = 0;
  drivers::LineLevels levels;  ///< at the start
  bool is_broken = false;      ///< the port failed meanwhile
  std::string rate_problem;    ///< why edges may get lost at the speed that is wanted; empty when none will
};
/// @param now  on the time line of the port's stamps.
CountFacts count_edges(drivers::EdgePort& port, std::chrono::nanoseconds duration,
                       const std::function<drivers::HostStamp()>& now);

/// encoder-counts.
Check judge(const CountFacts& facts);

}  // namespace stairway::doctor
