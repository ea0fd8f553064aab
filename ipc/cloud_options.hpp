// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace stairway::ipc {

/// How the clouds of the sweeps are sent.
struct CloudOptions {
  bool send = false;        ///< at all
  int slice_bytes = 16000;  ///< size of one message [bytes], 1000..60000
  double rate_mb_s = 8.0;   ///< pace of the messages [MB/s], 0.1..1000
};

}  // namespace stairway::ipc
