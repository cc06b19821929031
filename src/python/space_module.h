#pragma once

#include <pybind11/pybind11.h>

namespace mocha {

/// Adds planning in space to the module.
void add_space_planning(pybind11::module_& module);

}  // namespace mocha
