// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

namespace stairway::daemon {

/// Gives the calling thread a name of at most 15 characters, as `top -H` shows it.
inline void name_this_thread(const char* name) { ::pthread_setname_np(::pthread_self(), name); }

/// Lets the calling thread have the processor when no other thread of this computer asks for much of it, as nice(1)
/// does for a process. Where the system forbids it, nothing changes.
inline void let_others_go_first() {
  constexpr int kNiceness = 10;
  // On Linux, a thread has a niceness of its own.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
}

}  // namespace stairway::daemon
