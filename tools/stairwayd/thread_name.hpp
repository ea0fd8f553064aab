// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>

namespace stairway::daemon {

/// Gives the calling thread a name of at most 15 characters, as `top -H` shows it.
inline void name_this_thread(const char* name) { ::pthread_setname_np(::pthread_self(), name); }

}  // namespace stairway::daemon
