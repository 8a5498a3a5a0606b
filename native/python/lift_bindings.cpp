// Patterns on surfaces.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "option_binding.h"
#include "report_object.h"

#include "lift/lift.h"
#include "lift/patterns.h"
#include "report/lift_json.h"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {

void bind_lift(py::module_& m)
{
    bind_options<LiftOptions>(m, "LiftOptions");
    py::class_<LiftResult>(m, "LiftResult")
        .def_property_readonly("vertices", [](const LiftResult& r) { return r.vertices; })
        .def_property_readonly("triangles", [](const LiftResult& r) { return r.triangles; })
        .def_property_readonly("uv", [](const LiftResult& r) { return r.uv; })
        .def_property_readonly("original", [](const LiftResult& r) { return array_of(r.original); })
        .def_property_readonly("patch", [](const LiftResult& r) { return array_of(r.patch); })
        .def_property_readonly("face", [](const LiftResult& r) { return array_of(r.face); })
        .def_property_readonly("weights", [](const LiftResult& r) { return r.weights; })
        .def("report", [](const LiftResult& r) { return to_object(to_json(r)); });
    m.def("pattern_names", &pattern_names);
    m.def("lift", [](Positions vertices, Faces triangles, const std::string& pattern, const LiftOptions& options,
                     const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            return lift(vertices, triangles, pattern, options, context);
        });
    });
}

}  // namespace koebe::python
