// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stop_token>
#include <string>

namespace stairway::bench {

/// Answers an order with a line of text.
using OrderHandler = std::function<std::string(const std::string& order)>;

/// Takes orders at a socket in the file system, one after the other, until it is told to stop. Throws
/// std::system_error when there can be no socket.
void serve_orders(const std::string& path, const OrderHandler& handle, std::stop_token stop);

/// Sends one order and waits for its answer. Throws std::system_error when nobody answers within 10 s.
std::string send_order(const std::string& path, const std::string& order);

}  // namespace stairway::bench
