#include "bindings.h"

#include "native_call.h"
#include "pipeline/surface_solver.h"

#include <pybind11/eigen.h>

namespace py = pybind11;

namespace koebe::python {
namespace {

using SharedSolver = SharedObject<SurfaceSolver>;

}  // namespace

void bind_surface(py::module_& m)
{
    py::class_<SharedSolver>(m, "Surface")
        .def(py::init([](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                         const UniformizeOptions& options) {
            return new SharedSolver{detached([points = Vertices(vertices), faces = Triangles(triangles), options] {
                return SurfaceSolver(points, faces, options);
            })};
        }))
        .def("uniformize", [](SharedSolver& shared, const Eigen::Ref<const Vertices>& vertices,
                              const py::object& progress, const CancelToken& cancel) {
            return without_gil(progress, cancel, [&](ExecutionContext& context) {
                const auto lock = alone(shared.busy, context);
                return shared.object.uniformize(vertices, context);
            });
        });
}

}  // namespace koebe::python
