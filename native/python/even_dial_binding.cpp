#include "bindings.h"

#include "even/even_dial.h"
#include "native_call.h"

#include <pybind11/eigen.h>

namespace py = pybind11;

namespace koebe::python {
namespace {

using SharedDial = SharedObject<EvenDial>;

}  // namespace

void bind_even_dial(py::module_& m)
{
    py::class_<SharedDial>(m, "EvenDial")
        .def(py::init([](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                         const Eigen::Ref<const PlanarPoints>& points,
                         bool round) { return new SharedDial{EvenDial(vertices, triangles, points, round)}; }))
        .def("move", [](SharedDial& shared, double even, int steps, const CancelToken& cancel) {
            return without_gil(py::none(), cancel, [&](ExecutionContext& context) {
                const auto lock = alone(shared.busy, context);
                const bool moved = shared.object.move(even, steps, context);
                return std::make_pair(shared.object.points(), moved);
            });
        });
}

}  // namespace koebe::python
