#pragma once

#include <memory>

#include "fleet/wire/byte_codec.h"
#include "trajectory/motion.h"

namespace mocha {

/// A motion as bytes: its minimal description, quantised. Throws std::invalid_argument, saying what
/// is wrong, for an empty motion and for numbers out of range.
void put_motion(ByteWriter& out, const Motion& motion);

/// The motion in these bytes, rebuilt as every receiver rebuilds it. Throws std::invalid_argument,
/// saying what is wrong, for bytes that hold none.
std::shared_ptr<const Motion> get_motion(ByteReader& in);

}  // namespace mocha
