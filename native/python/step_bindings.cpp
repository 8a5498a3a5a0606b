// Single steps of a map.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "report_object.h"

#include "circles/circle_fit.h"
#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "holes/fair_filling.h"
#include "holes/fan_filling.h"
#include "io/mesh_formats.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"
#include "io/welding.h"
#include "linear/dense_spd.h"
#include "mesh/topology.h"
#include "opened/disk_packing.h"
#include "quality/distortion.h"
#include "quality/shared_warnings.h"
#include "quality/upright_floats.h"
#include "report/json.h"
#include "surface/harmonic_map.h"
#include "surface/importance.h"
#include "surface/loop_edges.h"
#include "surface/mirror.h"
#include "surface/nearest_triangles.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {
namespace {

/// The checked surface, for a map that needs this number of boundary loops.
Surface surface_with_loops(const Vertices& vertices, const Triangles& triangles, std::size_t count)
{
    validate_arrays(vertices, triangles);
    Surface surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
    if (surface.loops.size() != count)
        throw InputError("the map is for " + std::to_string(count) + " boundary loops, the mesh has " +
                         std::to_string(surface.loops.size()));
    return surface;
}

/// The map of a surface with two loops, the longer one on the unit circle, and the inner radius.
std::pair<PlanarPoints, double> annulus_by(AnnulusBackend backend, const Vertices& vertices, const Triangles& triangles)
{
    const Surface surface = surface_with_loops(vertices, triangles, 2);
    const auto length = [&](const VertexLoop& loop) { return loop_edges(vertices, loop).sum(); };
    const int outer = length(surface.loops[0]) >= length(surface.loops[1]) ? 0 : 1;
    const AnnulusMap map =
        annulus_map(surface.triangles, edge_lengths(vertices, surface.triangles), surface.vertex_count,
                    surface.loops[outer], surface.loops[1 - outer], {.backend = backend});
    if (!map.converged)
        throw SolverError("the discrete Yamabe flow left a curvature of " + std::to_string(map.curvature_error) +
                          " and " + std::to_string(map.collapsed) + " collapsed faces after " +
                          std::to_string(map.steps) + " steps");
    return {planar(map.positions), map.inner_radius};
}

}  // namespace

void bind_steps(py::module_& m)
{
    // A mesh before its map: loops, holes, polygons, welding. Small meshes are not worth a thread.
    m.def("boundary_loops", [](Faces triangles, Index vertex_count) {
        return detached(
            [faces = Triangles(triangles), vertex_count] { return analyze_surface(faces, vertex_count).loops; },
            triangles.rows() < small_mesh);
    });
    m.def("surface_warnings", [](Faces triangles, Index vertex_count) {
        std::vector<Warning> warnings;
        const auto turned = [faces = Triangles(triangles), vertex_count] {
            return analyze_surface(faces, vertex_count).reoriented;
        };
        warn_reoriented(detached(turned, triangles.rows() < small_mesh), warnings);
        return to_object(to_json(warnings));
    });
    m.def("fill_holes", [](Positions vertices, Faces triangles, const std::optional<std::vector<Index>>& loops,
                           bool fair) {
        FilledSurface filled = detached([positions = Vertices(vertices), faces = Triangles(triangles), loops, fair] {
            return fair ? fill_and_fair_holes(positions, faces, loops) : fill_holes(positions, faces, loops);
        });
        return std::make_tuple(std::move(filled.vertices), std::move(filled.triangles),
                               py::array_t<Index>(filled.label.size(), filled.label.data()),
                               to_object(to_json(filled.warnings)));
    });
    using Indices = Eigen::Ref<const Eigen::VectorX<Index>>;
    m.def("triangulate", [](Positions vertices, const Indices& corners, const Indices& begin) {
        PolygonMesh mesh{vertices, {corners.begin(), corners.end()}, {begin.begin(), begin.end()}};
        const bool small = begin.size() < small_mesh;
        const Triangulation cut = detached([mesh = std::move(mesh)] { return triangulate(mesh); }, small);
        return std::make_tuple(cut.triangles, py::array_t<Index>(cut.face.size(), cut.face.data()));
    });
    m.def("weld", [](Positions vertices, double distance) {
        return array_of(detached([points = Vertices(vertices), distance] { return weld(points, distance); },
                                 vertices.rows() < small_mesh));
    });
    m.def("coincident_vertices", [](Positions vertices, Faces triangles) {
        const auto find = [points = Vertices(vertices), faces = Triangles(triangles)] {
            const auto found = coincident_vertices(points, faces);
            return found ? std::vector<Warning>{*found} : std::vector<Warning>();
        };
        return to_object(to_json(detached(find, triangles.rows() < small_mesh)));
    });
    // Files.
    m.attr("mesh_formats") = io::format_names(io::FormatName::extension);
    m.def("parse_mesh", [](const std::string& bytes, const std::string& extension) {
        const PolygonMesh mesh = detached([bytes, extension] { return parse_mesh(bytes, extension); });
        return std::make_tuple(mesh.vertices, array_of(mesh.corners), array_of(mesh.face_begin));
    });
    // Single steps of the method: harmonic maps, disk, annulus.
    m.def("harmonic_map", [](Positions vertices, Faces triangles, const std::vector<Index>& fixed, Points values,
                             bool uniform) {
        return detached(
            [positions = Vertices(vertices), faces = Triangles(triangles), fixed, given = complex(values), uniform] {
                fix_product_blocks();
                const EdgeLengths lengths =
                    uniform ? EdgeLengths::Ones(faces.rows(), 3) : edge_lengths(positions, faces);
                return planar(harmonic_map(faces, lengths, static_cast<Index>(positions.rows()), fixed, given));
            },
            triangles.rows() < small_mesh);
    });
    m.def("disk_map", [](Positions vertices, Faces triangles) {
        return detached([positions = Vertices(vertices), faces = Triangles(triangles)] {
            fix_product_blocks();
            const Surface surface = surface_with_loops(positions, faces, 1);
            return planar(disk_map(surface.triangles, edge_lengths(positions, surface.triangles), surface.vertex_count,
                                   surface.loops[0])
                              .positions);
        });
    });
    m.def("annulus_map", [](Positions vertices, Faces triangles, int backend) {
        return detached([positions = Vertices(vertices), faces = Triangles(triangles), backend] {
            fix_product_blocks();
            return annulus_by(static_cast<AnnulusBackend>(backend), positions, faces);
        });
    });
    // Judges of a map, and places in it.
    m.def("distortion", [](Positions vertices, Faces triangles, Points uv) {
        const auto measure = [positions = Vertices(vertices), faces = Triangles(triangles), points = PlanarPoints(uv)] {
            return Distortion{measure_distortion(positions, faces, points), judge_disk(positions, faces, points)};
        };
        return to_object(to_json(detached(measure, triangles.rows() < small_mesh)));
    });
    m.def("places_in_domain", [](const PlanarPoints& uv, const Triangles& triangles, const PlanarPoints& points) {
        PlacesInTriangles found =
            detached([uv, triangles, points] { return nearest_triangles(uv, triangles, points); });
        return py::make_tuple(found.face, found.weights, found.distance);
    });
    m.def("upright_floats", [](const PlanarPoints& points, const Triangles& triangles) {
        return detached([points, triangles] { return upright_floats(points, triangles); });
    });
    m.def("mirror_image", [](Positions vertices, Faces triangles, const std::vector<Index>& polygon) {
        return array_of(detached([points = Vertices(vertices), faces = Triangles(triangles), polygon] {
                            return find_mirror(points, faces, polygon);
                        }).vertex);
    });
    // Helpers of the shapes and of the add-on.
    m.attr("most_important") = most_important;
    m.def("pack_disks", [](const std::vector<double>& radii, double margin) {
        return arrays_of(detached([radii, margin] { return pack_disks(radii, margin); }));
    });
    m.def("fit_circle", [](Points points) {
        const VectorXcd all = complex(points);
        const Circle circle = fit_circle_least_squares(all);
        const double off = ((all.array() - circle.center).abs() - circle.radius).abs().maxCoeff();
        return py::make_tuple(circle.center, circle.radius, off);
    });
}

}  // namespace koebe::python
