// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::tools {

/// From now on SIGINT and SIGTERM ask for a clean end. The second one ends the program the hard way, should the first
/// not be seen.
void catch_interrupts();
bool is_interrupted();

}  // namespace stairway::tools
