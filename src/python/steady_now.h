#pragma once

namespace mocha {

/// A steady clock [s]; what is below this module reads none.
double steady_now_s();

}  // namespace mocha
