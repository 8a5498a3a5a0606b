// What the bindings of maps have in common.
#pragma once

#include "array_conversion.h"
#include "native_call.h"
#include "option_binding.h"
#include "report_object.h"

#include "core/types.h"
#include "quality/report.h"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

namespace koebe::python {

/// Binds the common members of a map's result. The caller adds more.
template <class Result>
pybind11::class_<Result, MapReport> bind_result(pybind11::module_& m, const char* name)
{
    return pybind11::class_<Result, MapReport>(m, name)
        .def_property_readonly("uv", [](const Result& r) { return r.uv; })
        .def("report", [](const Result& r) { return to_object(to_json(r)); });
}

template <class Options, class Result>
void bind_map(pybind11::module_& m, const char* name,
              Result (*map)(const Vertices&, const Triangles&, const Options&, ExecutionContext&))
{
    m.def(name, [map](Positions vertices, Faces triangles, const Options& options, const pybind11::object& progress,
                      const CancelToken& cancel) {
        return without_gil(progress, cancel,
                           [&](ExecutionContext& context) { return map(vertices, triangles, options, context); });
    });
}

}  // namespace koebe::python
