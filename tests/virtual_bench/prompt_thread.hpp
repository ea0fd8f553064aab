// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::bench {

/// Lets the calling thread run before all ordinary ones: a device does not wait for the computer's processor. Ordinary
/// where the system does not permit it. Threads that share a lock must all be prompt, or none.
void be_prompt();

}  // namespace stairway::bench
