#pragma once

namespace tbb::info {

/// More than the machine may have: what matters is in how many orders things happen.
inline int default_concurrency() { return 4; }

}  // namespace tbb::info
