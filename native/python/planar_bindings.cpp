// Planar domains with smooth or polygonal rims.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "option_binding.h"
#include "report_object.h"

#include "execution/detachable_run.h"
#include "planar_domain/planar_map.h"
#include "report/planar_json.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {

void bind_planar(py::module_& m)
{
    bind_options<PlanarOptions>(m, "PlanarOptions").def_readwrite("pole", &PlanarOptions::pole);
    py::class_<PlanarResult>(m, "PlanarResult")
        // Figures, which are plain copies.
        .def_property_readonly("circles", [](const PlanarResult& result) { return arrays_of(result.circles); })
        .def_readonly("order", &PlanarResult::order)
        .def_property_readonly("module", [](const PlanarResult& result) { return VectorXd(result.module); })
        .def_property_readonly("module_errors",
                               [](const PlanarResult& result) { return VectorXd(result.module_errors); })
        .def_readonly("error", &PlanarResult::error)
        .def_readonly("residuals", &PlanarResult::residuals)
        .def_readonly("converged", &PlanarResult::converged)
        .def_readonly("sweeps", &PlanarResult::sweeps)
        .def_readonly("levels", &PlanarResult::levels)
        .def_readonly("unknowns", &PlanarResult::unknowns)
        .def_readonly("slit_error", &PlanarResult::slit_error)
        .def_property_readonly("slits",
                               [](const PlanarResult& result) {
                                   std::vector<std::pair<Complex, Complex>> ends;
                                   for (const Slit& slit : result.slits) ends.emplace_back(slit.begin, slit.end);
                                   return ends;
                               })
        // Places. The map is shared, so that another thread can go on without Python's lock.
        .def("slit_image",
             [](const PlanarResult& result, Points places) {
                 return detached([map = result.map, z = complex(places)] { return planar(map.slit_images(z)); });
             })
        .def("report", [](const PlanarResult& result) { return to_object(to_json(result)); })
        .def("image",
             [](const PlanarResult& result, Points places) {
                 return detached([map = result.map, z = complex(places)] { return planar(map(z)); });
             })
        .def("preimage", [](const PlanarResult& result, Points images) {
            return detached([map = result.map, w = complex(images)] { return planar(map.inverse(w)); });
        });
    m.def("planar_map", [](const std::string& text, bool is_svg, const PlanarOptions& options,
                           const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            return run_detachable<PlanarResult>(context, [text, is_svg, options](ExecutionContext& own) {
                return planar_map(planar_rims(text, is_svg), options, own);
            });
        });
    });
}

}  // namespace koebe::python
