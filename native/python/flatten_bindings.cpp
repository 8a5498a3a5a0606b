// Patterns to sew.
#include "array_conversion.h"
#include "bindings.h"
#include "map_binding.h"

#include "core/page.h"
#include "flatten/flatten.h"
#include "report/flatten_json.h"
#include "report/pattern_dxf.h"
#include "report/pattern_svg.h"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {

void bind_flatten(py::module_& m)
{
    bind_options<FlattenOptions>(m, "FlattenOptions");
    bind_result<FlattenResult>(m, "FlattenResult")
        .def_property_readonly("part", [](const FlattenResult& r) { return array_of(r.part); })
        .def_property_readonly("svg", [](const FlattenResult& r) { return pattern_svg(r.pattern); })
        .def_property_readonly("dxf", [](const FlattenResult& r) { return pattern_dxf(r.pattern); });
    bind_map<FlattenOptions, FlattenResult>(m, "flatten", flatten);
    m.def("page_problem", [](const std::string& name) { return page_named(name) ? std::string() : page_help(name); });
}

}  // namespace koebe::python
