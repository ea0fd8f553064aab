// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/fuzz/targets.hpp"

namespace stairway::fuzz {
namespace {

class FuzzTarget : public testing::TestWithParam<Target> {};

TEST_P(FuzzTarget, keeps_its_promises_on_every_seed_cut_anywhere) {
  for (const Seed& seed : GetParam().seeds()) {
    const std::size_t stride = 1 + seed.size() / 16;
    for (std::size_t length = 0; length < seed.size(); length += stride) GetParam().run(std::span(seed).first(length));
    GetParam().run(seed);
  }
}

TEST_P(FuzzTarget, keeps_its_promises_on_damaged_seeds) {
  for (const Seed& seed : GetParam().seeds()) {
    const std::size_t stride = 1 + seed.size() / 32;
    for (std::size_t at = 0; at < seed.size(); at += stride) {
      Seed damaged = seed;
      damaged[at] ^= static_cast<std::uint8_t>(1U << (at % 8));
      GetParam().run(damaged);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, FuzzTarget, testing::ValuesIn(kTargets),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(FuzzPromiseDeathTest, a_broken_one_stops_the_program) {
  EXPECT_DEATH(require(false, "one and one is three"), "broken promise: one and one is three");
}

}  // namespace
}  // namespace stairway::fuzz
