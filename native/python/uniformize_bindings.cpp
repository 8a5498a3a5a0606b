// Maps to circle domains, and cutting for them.
#include "array_conversion.h"
#include "bindings.h"
#include "map_binding.h"
#include "native_call.h"
#include "option_binding.h"

#include "opened/cut_uniformize.h"
#include "opened/cut_warnings.h"
#include "pipeline/convex_disk.h"
#include "pipeline/uniformize.h"
#include "report/cut_json.h"
#include "report/json.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// Pieces, cuts and faces left out, as tuples, and the number of handles.
py::tuple opened_tuple(const OpenedSurface& opened)
{
    py::list pieces, cuts, left_out;
    for (const SurfacePiece& piece : opened.pieces)
        pieces.append(py::make_tuple(piece.vertices, piece.triangles, array_of(piece.source_vertex),
                                     array_of(piece.source_face),
                                     py::array_t<char>(piece.turned.size(), piece.turned.data())));
    for (const SurfaceCut& cut : opened.cuts)
        cuts.append(py::make_tuple(to_string(cut.kind), array_of(cut.vertices), cut_text(cut)));
    for (const LeftOutFace& out : opened.left_out) left_out.append(py::make_tuple(out.face, out.like, out.degenerate));
    return py::make_tuple(pieces, cuts, left_out, opened.handles);
}

}  // namespace

void bind_uniformize(py::module_& m)
{
    py::class_<CancelToken>(m, "CancelToken", R"(A flag that any thread may raise to stop a computation.

Give it to a function as `cancel`. The call ends with Cancelled, within a fraction of a second.

>>> import koebe
>>> token = koebe.CancelToken()
>>> token.cancel()  # from any thread
>>> koebe.uniformize("blend_samples/face.obj", cancel=token)
Traceback (most recent call last):
...
koebe.errors.Cancelled: ...
)")
        .def(py::init<>())
        .def("cancel", &CancelToken::cancel, "Raise the flag. It stays raised.")
        .def_property_readonly("cancelled", &CancelToken::cancelled, "Whether the flag is raised.");

    // Options and results.
    bind_options<KoebeMeshOptions>(m, "KoebeMeshOptions");
    bind_options<UniformizeOptions>(m, "UniformizeOptions")
        .def_readonly("mesh", &UniformizeOptions::mesh)
        .def_readwrite("outer_vertex", &UniformizeOptions::outer_vertex);

    py::dict warning_elements;
    for (int k = 0; k < warning_kind_count; ++k)
        warning_elements[to_string(static_cast<WarningKind>(k))] = to_string(elements_of(static_cast<WarningKind>(k)));
    m.attr("warning_elements") = warning_elements;
    py::class_<MapReport>(m, "MapReport").def_property_readonly("flipped_faces", [](const MapReport& r) {
        return array_of(r.distortion.flipped);
    });
    bind_result<UniformizeResult>(m, "UniformizeResult")
        .def_property_readonly("conformal_uv",
                               [](const UniformizeResult& r) -> std::optional<PlanarPoints> {
                                   return r.conformal ? std::optional(r.conformal->uv) : std::nullopt;
                               })
        .def_property_readonly("step_maps", [](const UniformizeResult& r) { return r.step_images; });

    bind_result<CutUniformizeResult>(m, "CutUniformizeResult");

    // The maps.
    bind_map<UniformizeOptions, UniformizeResult>(m, "uniformize", uniformize);
    m.def("make_polygons_convex", [](Positions vertices, Faces triangles, UniformizeResult& result,
                                     const std::vector<Index>& polygon, bool mend, const CancelToken& cancel) {
        without_gil(py::none(), cancel, [&](ExecutionContext& context) {
            make_polygons_convex(vertices, triangles, polygon, result, context, mend);
        });
    });
    m.def("uniformize_with_cuts",
          [](Positions vertices, Faces triangles, const std::vector<Index>& polygon, const UniformizeOptions& options,
             const py::object& progress, const CancelToken& cancel) {
              return without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return uniformize_with_cuts(vertices, triangles, polygon, options, context);
              });
          });
    m.def("open_surface", [](Positions vertices, Faces triangles, const std::vector<Index>& polygon,
                             const py::object& progress, const CancelToken& cancel) {
        return opened_tuple(without_gil(progress, cancel, [&](ExecutionContext& context) {
            return run_detachable<OpenedSurface>(context,
                                                 [points = Vertices(vertices), faces = Triangles(triangles),
                                                  options = OpenOptions{.polygon = polygon}](ExecutionContext& own) {
                                                     own.begin_stage("cut", 0.0, 1.0);
                                                     OpenedSurface opened = open_surface(points, faces, options, own);
                                                     own.advance(1.0);
                                                     return opened;
                                                 });
        }));
    });
}

}  // namespace koebe::python
