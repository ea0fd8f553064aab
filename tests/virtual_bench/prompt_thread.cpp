// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/prompt_thread.hpp"

#include <pthread.h>
#include <sched.h>

namespace stairway::bench {

void be_prompt() {
  const sched_param parameters{.sched_priority = 10};
  ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
}

}  // namespace stairway::bench
