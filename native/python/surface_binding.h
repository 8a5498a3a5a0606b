// koebe.Surface for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace koebe::python {

void bind_surface(pybind11::module_& m);

}  // namespace koebe::python
