#pragma once

#include <cstdint>
#include <string>

#include "fleet/protocol/passing_messages.h"
#include "fleet/wire/byte_codec.h"

namespace mocha {

// What robots say about passing as bytes, and back, but for the sender and its epoch, which are at
// the head of every message. Everything throws std::invalid_argument, saying what is wrong, for
// what cannot be encoded or decoded; what is decoded is valid.

void put_intent(ByteWriter& out, const PassingIntent& intent);
PassingIntent get_intent(ByteReader& in, std::string agent, std::uint32_t epoch);

/// Of a valid one.
void put_instruction(ByteWriter& out, const PassingInstruction& instruction);
PassingInstruction get_instruction(ByteReader& in, std::string leader, std::uint32_t epoch);

}  // namespace mocha
