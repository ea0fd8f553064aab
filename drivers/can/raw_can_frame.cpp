// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/can/raw_can_frame.hpp"

#include <linux/can/error.h>

#include <algorithm>
#include <cstdint>

#include "drivers/canopen/canopen_frames.hpp"

namespace stairway::drivers {
namespace {

using Arrivals = std::vector<std::variant<CanFrame, CanCondition>>;

struct ErrorBit {
  std::uint32_t bit;
  CanCondition condition;
};

// In the order in which a controller gets there.
constexpr ErrorBit kClasses[] = {
    {CAN_ERR_TX_TIMEOUT, CanCondition::TransmitStuck},
    {CAN_ERR_ACK, CanCondition::Unheard},
    {CAN_ERR_BUSOFF, CanCondition::BusOff},
    {CAN_ERR_RESTARTED, CanCondition::Restarted},
};
constexpr ErrorBit kControllerBits[] = {
    {CAN_ERR_CRTL_RX_OVERFLOW, CanCondition::Overrun},
    {CAN_ERR_CRTL_TX_OVERFLOW, CanCondition::TransmitStuck},
    {CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING, CanCondition::Warning},
    {CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE, CanCondition::Passive},
    {CAN_ERR_CRTL_ACTIVE, CanCondition::Active},
};

Arrivals from_error_frame(const can_frame& raw) {
  Arrivals out;
  if ((raw.can_id & CAN_ERR_CRTL) != 0) {
    for (const ErrorBit& entry : kControllerBits) {
      if ((raw.data[1] & entry.bit) != 0) out.emplace_back(entry.condition);
    }
  }
  for (const ErrorBit& entry : kClasses) {
    if ((raw.can_id & entry.bit) != 0) out.emplace_back(entry.condition);
  }
  return out;
}

}  // namespace

Arrivals from_raw_frame(const can_frame& raw) {
  if ((raw.can_id & CAN_ERR_FLAG) != 0) return from_error_frame(raw);
  if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0 || raw.len > CAN_MAX_DLEN) return {};
  CanFrame frame{static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK), raw.len, {}};
  std::copy_n(raw.data, frame.length, frame.data.begin());
  return {frame};
}

can_frame to_raw_frame(const CanFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.len = frame.length;
  std::ranges::copy(frame.payload(), raw.data);
  return raw;
}

can_err_mask_t raw_error_classes() {
  return CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;
}

std::vector<can_filter> raw_filters(int node, int host_node) {
  const int identifiers[] = {cob::kNmt,
                             cob::kEmergency + node,
                             cob::kTpdo1 + node,
                             cob::kTpdo2 + node,
                             cob::kSdoAnswer + node,
                             cob::kSdoRequest + node,
                             cob::kHeartbeat + node,
                             cob::kHeartbeat + host_node};
  std::vector<can_filter> filters;
  for (const int id : identifiers) {
    filters.push_back({static_cast<canid_t>(id), CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

}  // namespace stairway::drivers
