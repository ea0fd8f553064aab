// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::test {

/// Whether this process runs in a network namespace of its own, where multicast reaches no real interface. The main
/// function of these tests puts it there if the kernel permits.
bool has_private_network();

/// The route that LCM needs, in the private network.
void add_multicast_route();
void remove_multicast_route();

}  // namespace stairway::test
