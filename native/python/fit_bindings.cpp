// Maps to given circle domains.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "report_object.h"

#include "fit/fit_circles.h"
#include "fit/teichmueller.h"
#include "fit/torus_dilatation.h"
#include "report/fit_json.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// @param vertices one for each rim, the outer one first; -1: no pin @param angles their places, radians
std::vector<TemplateRim> rims_of(const std::vector<bool>& rotates, const std::vector<Index>& vertices,
                                 const std::vector<double>& angles)
{
    std::vector<TemplateRim> rims;
    for (std::size_t k = 0; k < rotates.size(); ++k) {
        rims.push_back({rotates[k], {}});
        if (vertices[k] >= 0) rims.back().pin = RimPin{vertices[k], angles[k]};
    }
    return rims;
}

}  // namespace

void bind_fit(py::module_& m)
{
    // A map to given circles.
    py::class_<CircleTemplate>(m, "CircleTemplate")
        .def(py::init([](const PlanarPoints& centers, const VectorXd& radii, const std::vector<std::string>& names,
                         const std::vector<int>& loops, const std::vector<bool>& rotates,
                         const std::vector<Index>& vertices, const std::vector<double>& angles) {
            CircleTemplate wanted{.circles = circles_of(centers, radii), .names = names, .loops = loops};
            wanted.rims = rims_of(rotates, vertices, angles);
            wanted.outer = wanted.rims.front();
            wanted.rims.erase(wanted.rims.begin());
            return wanted;
        }));
    py::class_<FitResult, UniformizeResult>(m, "FitResult")
        .def_property_readonly("mu", [](const FitResult& r) { return r.mu; })
        .def("report", [](const FitResult& r) { return to_object(to_json(r)); });
    m.def("fit_circles",
          [](Positions vertices, Faces triangles, const CircleTemplate& wanted, const UniformizeOptions& options,
             bool extremal, const py::object& progress, const CancelToken& cancel) {
              return without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return fit_circles(vertices, triangles, wanted, {.map = options, .extremal = extremal}, context);
              });
          });
    // The extremal map of one domain to another.
    py::class_<TeichmuellerMap>(m, "TeichmuellerMap")
        .def_readonly("dilatation", &TeichmuellerMap::dilatation)
        .def_readonly("lower", &TeichmuellerMap::lower)
        .def_readonly("largest", &TeichmuellerMap::largest)
        .def_property_readonly("distance", &TeichmuellerMap::distance)
        .def_property_readonly("mu", [](const TeichmuellerMap& map) { return map.mu; })
        .def_property_readonly("uv", [](const TeichmuellerMap& map) { return map.uv; })
        .def_readonly("match", &TeichmuellerMap::match)
        .def_readonly("straight", &TeichmuellerMap::straight)
        .def_readonly("refused", &TeichmuellerMap::refused)
        .def_readonly("flipped", &TeichmuellerMap::flipped)
        .def_readonly("newton_steps", &TeichmuellerMap::newton_steps);
    m.def("teichmueller_map",
          [](const MappedSurface& a, const PlanarPoints& centers, const VectorXd& radii, const std::vector<int>& match,
             const std::vector<SurfacePoint>& points, const std::vector<Complex>& places, bool least_match,
             const py::object& progress, const CancelToken& cancel) {
              TeichmuellerOptions options{.match = match, .least_match = least_match};
              for (std::size_t i = 0; i < points.size(); ++i) options.landmarks.push_back({points[i], places[i]});
              return without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return teichmueller_map(a, circles_of(centers, radii), options, context);
              });
          });
    m.def("torus_dilatation", &torus_dilatation);
}

}  // namespace koebe::python
