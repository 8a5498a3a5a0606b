// Maps to domains other than the disk, and to parts.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "option_binding.h"
#include "report_object.h"

#include "flatten/flatten.h"
#include "flatten/page.h"
#include "parts/parts.h"
#include "report/flatten_json.h"
#include "report/parts_json.h"
#include "report/pattern_dxf.h"
#include "report/pattern_svg.h"
#include "report/schottky_json.h"
#include "report/sphere_json.h"
#include "report/tile_json.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// Binds the common members of a map result with UVs per corner. The caller adds more.
template <class Result>
py::class_<Result, MapReport> bind_result(py::module_& m, const char* name)
{
    return py::class_<Result, MapReport>(m, name).def_property_readonly("uv", [](const Result& r) { return r.uv; });
}

template <class Options, class Result>
void bind_map(py::module_& m, const char* name,
              Result (*map)(const Vertices&, const Triangles&, const Options&, ExecutionContext&))
{
    m.def(name, [map](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                      const Options& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel,
                           [&](ExecutionContext& context) { return map(vertices, triangles, options, context); });
    });
}

template <class Result>
py::object report_of(const Result& result)
{
    return to_object(to_json(result));
}

}  // namespace

void bind_domains(py::module_& m)
{
    bind_result<PartsResult>(m, "PartsResult")
        .def_property_readonly("part", [](const PartsResult& r) { return array_of(r.part); })
        .def("report", &report_of<PartsResult>);
    bind_options<PartsOptions>(m, "PartsOptions");
    bind_map<PartsOptions, PartsResult>(m, "parts", parts_of);

    py::enum_<LengthUnit>(m, "LengthUnit")
        .value("mm", LengthUnit::mm)
        .value("cm", LengthUnit::cm)
        .value("m", LengthUnit::m)
        .value("in", LengthUnit::in);
    bind_options<FlattenOptions>(m, "FlattenOptions");
    bind_result<FlattenResult>(m, "FlattenResult")
        .def_property_readonly("part", [](const FlattenResult& r) { return array_of(r.part); })
        .def_property_readonly("svg", [](const FlattenResult& r) { return pattern_svg(r.pattern); })
        .def_property_readonly("dxf", [](const FlattenResult& r) { return pattern_dxf(r.pattern); })
        .def("report", &report_of<FlattenResult>);
    bind_map<FlattenOptions, FlattenResult>(m, "flatten", flatten);
    m.def("page_problem", [](const std::string& name) { return page_named(name) ? std::string() : page_help(name); });

    bind_words(m, "RingHoles", {RingHoles::circles, RingHoles::concentric, RingHoles::radial});
    bind_options<TileOptions>(m, "TileOptions");
    bind_result<TileResult>(m, "TileResult").def("report", &report_of<TileResult>);
    bind_map<TileOptions, TileResult>(m, "torus_map", torus_map);
    bind_map<TileOptions, TileResult>(m, "ring_map", ring_map);

    bind_words(m, "SphereLayout", {SphereLayout::equirectangular, SphereLayout::octahedral});
    bind_options<SphereOptions>(m, "SphereOptions");
    bind_result<SphereResult>(m, "SphereResult")
        .def_property_readonly("points", [](const SphereResult& r) { return r.points; })
        .def("report", &report_of<SphereResult>);
    bind_map<SphereOptions, SphereResult>(m, "sphere_map", sphere_map);

    bind_words(m, "SchottkyNormalization", {SchottkyNormalization::area, SchottkyNormalization::circles});
    bind_options<SchottkyOptions>(m, "SchottkyOptions");
    bind_result<SchottkyResult>(m, "SchottkyResult").def("report", &report_of<SchottkyResult>);
    bind_map<SchottkyOptions, SchottkyResult>(m, "schottky_map", schottky_map);
}

}  // namespace koebe::python
