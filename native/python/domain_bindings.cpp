// Maps to domains other than the disk, and to parts.
#include "array_conversion.h"
#include "bindings.h"
#include "map_binding.h"

#include "packing/packed_layer.h"
#include "parts/parts.h"
#include "parts/sewing.h"
#include "report/packed_json.h"
#include "report/parts_json.h"
#include "report/schottky_json.h"
#include "report/sphere_json.h"
#include "report/tile_json.h"
#include "splitting/coarse_surface.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// The last sketch of a computation. Written and read on any thread.
class CutSketch : NotCopied {
public:
    void draw(CutEdges edges)
    {
        const std::scoped_lock lock(mutex_);
        edges_ = std::move(edges);
    }
    CutEdges take()
    {
        const std::scoped_lock lock(mutex_);
        return std::exchange(edges_, {});
    }

private:
    std::mutex mutex_;
    CutEdges edges_;
};

}  // namespace

void bind_domains(py::module_& m)
{
    // Parts: the result, a sketch that other threads may read, the map.
    bind_result<PartsResult>(m, "PartsResult").def_property_readonly("part", [](const PartsResult& r) {
        return array_of(r.part);
    });
    py::class_<CutSketch, std::shared_ptr<CutSketch>>(m, "CutSketch",
                                                      R"(Where `parts` would cut, while it computes.

>>> import koebe
>>> sketch = koebe.CutSketch()
>>> result = koebe.parts("docs/link.obj", sketch=sketch)  # another thread may ask meanwhile
>>> print(sketch.take().shape[1], len(sketch.take()))
2 0
)")
        .def(py::init<>())
        .def(
            "take",
            [](CutSketch& sketch) {
                const CutEdges edges = sketch.take();
                py::array_t<Index> rows({edges.size(), std::size_t{2}});
                Index* at = rows.mutable_data();
                for (const auto& edge : edges) at = std::ranges::copy(edge, at).out;
                return rows;
            },
            "(E, 2) int32: vertices of the edges that would be cut, as far as they are decided. The edges of the "
            "result may be others. Empty if nothing is new since the last call.");
    bind_options<PartsOptions>(m, "PartsOptions")
        .def("draw_on", [](PartsOptions& options, const std::shared_ptr<CutSketch>& sketch) {
            options.sketch = [sketch](CutEdges edges) { sketch->draw(std::move(edges)); };
        });
    bind_map<PartsOptions, PartsResult>(m, "parts", parts_of);

    // Layers of UVs: packed, sewn, and the coarse surface for a quick look.
    bind_result<PackedLayer>(m, "PackedLayer").def_property_readonly("island", [](const PackedLayer& r) {
        return array_of(r.part);
    });
    bind_options<PackedLayerOptions>(m, "PackOptions");
    bind_map<PackedLayerOptions, PackedLayer>(m, "pack", pack_layer);
    m.def("sew", [](Positions vertices, Faces triangles, Points uv, const std::vector<std::array<Index, 2>>& edges,
                    const std::vector<Index>& polygon, std::optional<double> even, const py::object& progress,
                    const CancelToken& cancel) {
        SewnLayer sewn = without_gil(progress, cancel, [&](ExecutionContext& context) {
            return sew_islands(vertices, triangles, {uv, edges, polygon, even}, context);
        });
        return py::make_tuple(std::move(sewn.uv), array_of(sewn.island), sewn.joined, sewn.sewn);
    });

    m.def("coarse_surface", [](Positions vertices, Faces triangles, Index faces, const CancelToken& cancel) {
        CoarseSurface coarse = without_gil(py::none(), cancel, [&](ExecutionContext& context) {
            return coarse_surface(vertices, triangles, faces, {}, context);
        });
        return py::make_tuple(std::move(coarse.vertices), std::move(coarse.triangles), array_of(coarse.vertex));
    });

    // The other domains.
    bind_options<TileOptions>(m, "TileOptions");
    bind_result<TileResult>(m, "TileResult");
    bind_map<TileOptions, TileResult>(m, "torus_map", torus_map);
    bind_map<TileOptions, TileResult>(m, "ring_map", ring_map);

    bind_options<SphereOptions>(m, "SphereOptions");
    bind_result<SphereResult>(m, "SphereResult").def_property_readonly("points", [](const SphereResult& r) {
        return r.points;
    });
    bind_map<SphereOptions, SphereResult>(m, "sphere_map", sphere_map);

    bind_options<SchottkyOptions>(m, "SchottkyOptions");
    bind_result<SchottkyResult>(m, "SchottkyResult");
    bind_map<SchottkyOptions, SchottkyResult>(m, "schottky_map", schottky_map);
}

}  // namespace koebe::python
