#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "stack/planning_effort.h"

namespace mocha {

/// What plans took, and what they fell back on.
void diagnose_effort(const PlanningRecord& record,
                     diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace mocha
