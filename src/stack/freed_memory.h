#pragma once

namespace mocha {

/// Lets the process keep memory that it has freed, instead of returning it to the system at once:
/// plans and maps need the like of it again, and each page that is handed out anew has to be
/// mapped and cleared first, which can take longer than the work on it. For the C library of GNU.
void keep_freed_memory();

}  // namespace mocha
