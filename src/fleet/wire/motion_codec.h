#pragma once

#include <memory>

#include "fleet/wire/byte_codec.h"
#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// How a robot brakes as bytes, rounded to 1 mm/s^2. Throws std::invalid_argument, saying what is
/// wrong, for numbers out of range.
void put_braking(ByteWriter& out, const Braking& braking);

/// The braking in these bytes. Throws std::invalid_argument, saying what is wrong, for bytes that
/// hold none.
Braking get_braking(ByteReader& in);

/// A motion as bytes: its minimal description, quantised. Throws std::invalid_argument, saying what
/// is wrong, for an empty motion and for numbers out of range.
void put_motion(ByteWriter& out, const Motion& motion);

/// The motion in these bytes, rebuilt as every receiver rebuilds it. Throws std::invalid_argument,
/// saying what is wrong, for bytes that hold none.
std::shared_ptr<const Motion> get_motion(ByteReader& in);

}  // namespace mocha
