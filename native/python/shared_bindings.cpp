// Objects that are called again and again: a surface in several shapes, and a map made more or less even.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"

#include "even/even_dial.h"
#include "pipeline/surface_solver.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// An object for one call at a time.
template <typename Object>
struct Shared {
    Object object;
    std::timed_mutex busy = {};

    /// Computes without the GIL. A second thread waits for the first, and may be cancelled meanwhile.
    template <class Compute>
    auto call(const py::object& progress, const CancelToken& cancel, Compute compute)
    {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            std::unique_lock lock(busy, std::defer_lock);
            while (!lock.try_lock_for(std::chrono::milliseconds(20))) context.checkpoint();
            return compute(context);
        });
    }
};

}  // namespace

void bind_shared(py::module_& m)
{
    // A factorized surface that maps many vertex positions.
    using Solver = Shared<SurfaceSolver>;
    py::class_<Solver>(m, "Surface")
        .def(py::init([](Positions vertices, Faces triangles, const UniformizeOptions& options) {
            return new Solver{detached([points = Vertices(vertices), faces = Triangles(triangles), options] {
                return SurfaceSolver(points, faces, options);
            })};
        }))
        .def("uniformize",
             [](Solver& shared, Positions vertices, const py::object& progress, const CancelToken& cancel) {
                 return shared.call(progress, cancel, [&](ExecutionContext& context) {
                     return shared.object.uniformize(vertices, context);
                 });
             });

    // A map that follows a slider, and pins.
    using Dial = Shared<EvenDial>;
    py::class_<Dial>(m, "EvenDial")
        .def(py::init([](Positions vertices, Faces triangles, Points points, bool round) {
            return new Dial{EvenDial(vertices, triangles, points, round)};
        }))
        .def("move",
             [](Dial& shared, double even, int steps, const CancelToken& cancel) {
                 return shared.call(py::none(), cancel, [&](ExecutionContext& context) {
                     const bool moved = shared.object.move(even, steps, context);
                     return std::make_pair(shared.object.points(), moved);
                 });
             })
        .def("pin", [](Dial& shared, const std::vector<Index>& vertices, Points places, double even,
                       const CancelToken& cancel) {
            return shared.call(py::none(), cancel, [&](ExecutionContext& context) {
                shared.object.pin({vertices, places}, even, context);
                return shared.object.points();
            });
        });
}

}  // namespace koebe::python
