#pragma once

#include <cstdint>

#include "fleet/protocol/passing_messages.h"

namespace mocha {

/// The instruction as the robot that it is for decodes it, however many datagrams it takes: whoever
/// makes an order keeps to this, too. Quantised again it stays as it is. Throws
/// std::invalid_argument for places beyond what can be said.
PassingInstruction quantised(PassingInstruction instruction);

/// The same from turn `first` on, with as many turns as fit into one datagram; none where the names
/// of its robots leave no room. Throws as encode() does for what cannot be said at all, and where
/// `first` is neither one of its turns nor their end.
PassingInstruction fitting_part(const PassingInstruction& whole, std::uint32_t first);

}  // namespace mocha
