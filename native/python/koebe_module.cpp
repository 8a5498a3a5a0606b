// The Python module: its definitions. Arrays come checked from koebe/_arrays.py, and each call copies them.
#include "error_translation.h"
#include "native_call.h"
#include "report_object.h"
#include "surface_binding.h"

#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "core/tolerances.h"
#include "core/topology.h"
#include "holes/fair_filling.h"
#include "holes/fan_filling.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"
#include "linear/dense_spd.h"
#include "parts/parts.h"
#include "pipeline/cut_uniformize.h"
#include "pipeline/cut_warnings.h"
#include "pipeline/uniformize.h"
#include "quality/distortion.h"
#include "report/cut_json.h"
#include "report/json.h"
#include "report/parts_json.h"
#include "report/schottky_json.h"
#include "report/sphere_json.h"
#include "report/tile_json.h"
#include "shape/conformal_module.h"
#include "shape/domain_alignment.h"
#include "shape/loop_matching.h"
#include "shape/module_error.h"
#include "surface/harmonic_map.h"
#include "surface/loop_edges.h"
#include "transfer/correspondence.h"
#include "transfer/surface_point.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace koebe;
using namespace koebe::python;

namespace {

/// The checked surface for a map that is made for so many boundary loops.
Surface surface_with_loops(const Vertices& vertices, const Triangles& triangles, std::size_t count)
{
    validate_arrays(vertices, triangles);
    Surface surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
    if (surface.loops.size() != count)
        throw InputError("the map is for " + std::to_string(count) + " boundary loops, the mesh has " +
                         std::to_string(surface.loops.size()));
    return surface;
}

py::array_t<Index> array_of(const std::vector<Index>& numbers)
{
    return py::array_t<Index>(numbers.size(), numbers.data());
}

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

/// @throws SolverError a position that is not finite
PlanarPoints planar(const VectorXcd& positions)
{
    PlanarPoints points(positions.size(), 2);
    points << positions.real(), positions.imag();
    if (!points.allFinite()) throw SolverError("the map has positions that are not finite");
    return points;
}

VectorXcd complex(const Eigen::Ref<const PlanarPoints>& points)
{
    return points.col(0) + Complex(0.0, 1.0) * points.col(1);
}

/// Circles as Python has them: (L, 2) centres and (L) radii.
std::vector<Circle> circles_of(const PlanarPoints& centers, const VectorXd& radii)
{
    std::vector<Circle> circles;
    for (Eigen::Index k = 0; k < radii.size(); ++k)
        circles.push_back({Complex(centers(k, 0), centers(k, 1)), radii[k]});
    return circles;
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

PYBIND11_MODULE(_koebe, m)
{
    m.attr("__version__") = KOEBE_VERSION;
    m.attr("uv_resolution") = uv_resolution;
    m.attr("circle_tolerance") = circle_tolerance;

    translate_errors();
    watch_interpreter();

    py::enum_<Method>(m, "Method")
        .value("gk", Method::gk)
        .value("ck", Method::ck)
        .value("against-outer", Method::against_outer);
    py::enum_<Engine>(m, "Engine").value("condensed", Engine::condensed).value("mesh", Engine::mesh);
    py::enum_<OuterLoop>(m, "OuterLoop")
        .value("automatic", OuterLoop::automatic)
        .value("longest", OuterLoop::longest)
        .value("vertex", OuterLoop::vertex);
    py::enum_<Balance>(m, "Balance").value("none", Balance::none).value("area", Balance::area);

    py::enum_<AnnulusBackend>(m, "AnnulusBackend")
        .value("harmonic", AnnulusBackend::harmonic)
        .value("yamabe", AnnulusBackend::yamabe);

    using Metric = KoebeMeshOptions::Metric;
    py::enum_<Metric>(m, "Metric")
        .value("first", Metric::first)
        .value("planar", Metric::planar)
        .value("reflected", Metric::reflected);
    py::enum_<Partners>(m, "Partners").value("fixed", Partners::fixed).value("changing", Partners::changing);

    py::class_<CancelToken>(m, "CancelToken", "A flag that any thread may raise to stop a computation.")
        .def(py::init<>())
        .def("cancel", &CancelToken::cancel)
        .def_property_readonly("cancelled", &CancelToken::cancelled);

    py::class_<KoebeMeshOptions>(m, "KoebeMeshOptions")
        .def_readwrite("metric", &KoebeMeshOptions::metric)
        .def_readwrite("partners", &KoebeMeshOptions::partners)
        .def_readwrite("schedule", &KoebeMeshOptions::schedule)
        .def_readwrite("annulus", &KoebeMeshOptions::annulus)
        .def_readwrite("record_steps", &KoebeMeshOptions::record_steps);
    py::class_<UniformizeOptions>(m, "UniformizeOptions")
        .def(py::init<>())
        .def_readonly("mesh", &UniformizeOptions::mesh)
        .def_readwrite("method", &UniformizeOptions::method)
        .def_readwrite("engine", &UniformizeOptions::engine)
        .def_readwrite("outer", &UniformizeOptions::outer)
        .def_readwrite("outer_vertex", &UniformizeOptions::outer_vertex)
        .def_readwrite("center", &UniformizeOptions::center)
        .def_readwrite("point", &UniformizeOptions::point)
        .def_readwrite("tolerance", &UniformizeOptions::tolerance)
        .def_readwrite("most_lost", &UniformizeOptions::most_lost)
        .def_readwrite("max_sweeps", &UniformizeOptions::max_sweeps)
        .def_readwrite("balance", &UniformizeOptions::balance)
        .def_readwrite("importance", &UniformizeOptions::importance)
        .def_readwrite("threads", &UniformizeOptions::threads)
        .def_readwrite("polish", &UniformizeOptions::polish);

    py::dict warning_elements;
    for (int k = 0; k <= static_cast<int>(WarningKind::not_mapped); ++k)
        warning_elements[to_string(static_cast<WarningKind>(k))] = to_string(elements_of(static_cast<WarningKind>(k)));
    m.attr("warning_elements") = warning_elements;
    py::class_<MapReport>(m, "MapReport").def_property_readonly("flipped_faces", [](const MapReport& r) {
        return array_of(r.distortion.flipped);
    });
    py::class_<UniformizeResult, MapReport>(m, "UniformizeResult")
        .def_property_readonly("uv", [](const UniformizeResult& r) { return r.uv; })
        .def_property_readonly("step_maps", [](const UniformizeResult& r) { return r.step_images; })
        .def("report", [](const UniformizeResult& r) { return to_object(to_json(r)); });

    py::class_<CutUniformizeResult, MapReport>(m, "CutUniformizeResult")
        .def_property_readonly("uv", [](const CutUniformizeResult& r) { return r.uv; })
        .def("report", [](const CutUniformizeResult& r) { return to_object(to_json(r)); });

    py::class_<MappedSurface>(m, "MappedSurface")
        .def(py::init([](const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                         const std::vector<VertexLoop>& loops, const std::vector<std::vector<Index>>& off_circle,
                         const PlanarPoints& centers, const VectorXd& radii, const std::vector<bool>& own) {
            MappedSurface surface{vertices, triangles, uv, {}};
            const std::vector<Circle> circles = circles_of(centers, radii);
            for (std::size_t k = 0; k < loops.size(); ++k)
                surface.loops.push_back({.vertices = loops[k],
                                         .circle = circles[k],
                                         .roundness = {},
                                         .off_circle = off_circle[k],
                                         .shrunk = !own[k]});
            return surface;
        }));
    m.def("uniformize", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                           const UniformizeOptions& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            return uniformize(vertices, triangles, options, context);
        });
    });
    bind_surface(m);
    m.def("uniformize_with_cuts",
          [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
             const std::vector<Index>& polygon, const UniformizeOptions& options, const py::object& progress,
             const CancelToken& cancel) {
              return without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return uniformize_with_cuts(vertices, triangles, polygon, options, context);
              });
          });
    m.def("open_surface", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                             const std::vector<Index>& polygon, const py::object& progress, const CancelToken& cancel) {
        return opened_tuple(without_gil(progress, cancel, [&](ExecutionContext& context) {
            return run_detachable<OpenedSurface>(context,
                                                 [points = Vertices(vertices), faces = Triangles(triangles),
                                                  options = OpenOptions{.polygon = polygon}](ExecutionContext& own) {
                                                     return open_surface(points, faces, options, own);
                                                 });
        }));
    });
    py::class_<PartsResult, MapReport>(m, "PartsResult")
        .def_property_readonly("uv", [](const PartsResult& r) { return r.uv; })
        .def_property_readonly("part",
                               [](const PartsResult& r) { return py::array_t<Index>(r.part.size(), r.part.data()); })
        .def("report", [](const PartsResult& r) { return to_object(to_json(r)); });
    m.attr("default_price") = PartsOptions{}.price;
    m.attr("most_lost_area") = most_lost_area;
    m.def("parts",
          [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles, double price,
             bool cut, const std::vector<Index>& polygon, const std::vector<std::array<Index, 2>>& slits,
             bool round_cuts, double most_lost, const py::object& progress, const CancelToken& cancel) {
              return without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return parts_of(vertices, triangles,
                                  {.price = price,
                                   .most_lost = most_lost,
                                   .cut = cut,
                                   .polygon = polygon,
                                   .slits = slits,
                                   .round_cuts = round_cuts},
                                  context);
              });
          });
    py::enum_<RingHoles>(m, "RingHoles")
        .value("circles", RingHoles::circles)
        .value("concentric", RingHoles::concentric)
        .value("radial", RingHoles::radial);
    py::class_<TileOptions>(m, "TileOptions")
        .def(py::init<>())
        .def_readwrite("tolerance", &TileOptions::tolerance)
        .def_readwrite("most_lost", &TileOptions::most_lost)
        .def_readwrite("max_sweeps", &TileOptions::max_sweeps)
        .def_readwrite("holes", &TileOptions::holes)
        .def_readwrite("outer", &TileOptions::outer)
        .def_readwrite("inner", &TileOptions::inner)
        .def_readwrite("polygon", &TileOptions::polygon);
    py::class_<TileResult, MapReport>(m, "TileResult")
        .def_property_readonly("uv", [](const TileResult& r) { return r.uv; })
        .def("report", [](const TileResult& r) { return to_object(to_json(r)); });
    m.def("torus_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                          const TileOptions& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel,
                           [&](ExecutionContext& context) { return torus_map(vertices, triangles, options, context); });
    });
    m.def("ring_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                         const TileOptions& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel,
                           [&](ExecutionContext& context) { return ring_map(vertices, triangles, options, context); });
    });
    py::enum_<SphereLayout>(m, "SphereLayout")
        .value("equirectangular", SphereLayout::equirectangular)
        .value("octahedral", SphereLayout::octahedral);
    py::class_<SphereOptions>(m, "SphereOptions")
        .def(py::init<>())
        .def_readwrite("tolerance", &SphereOptions::tolerance)
        .def_readwrite("most_lost", &SphereOptions::most_lost)
        .def_readwrite("max_sweeps", &SphereOptions::max_sweeps)
        .def_readwrite("layout", &SphereOptions::layout)
        .def_readwrite("polygon", &SphereOptions::polygon);
    py::class_<SphereResult, MapReport>(m, "SphereResult")
        .def_property_readonly("points", [](const SphereResult& r) { return r.points; })
        .def_property_readonly("uv", [](const SphereResult& r) { return r.uv; })
        .def("report", [](const SphereResult& r, SphereLayout layout) { return to_object(to_json(r, layout)); });
    m.def("sphere_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                           const SphereOptions& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            return sphere_map(vertices, triangles, options, context);
        });
    });
    py::enum_<SchottkyNormalization>(m, "SchottkyNormalization")
        .value("area", SchottkyNormalization::area)
        .value("circles", SchottkyNormalization::circles);
    py::class_<SchottkyOptions>(m, "SchottkyOptions")
        .def(py::init<>())
        .def_readwrite("normalization", &SchottkyOptions::normalization)
        .def_readwrite("tolerance", &SchottkyOptions::tolerance)
        .def_readwrite("most_lost", &SchottkyOptions::most_lost)
        .def_readwrite("max_sweeps", &SchottkyOptions::max_sweeps)
        .def_readwrite("polygon", &SchottkyOptions::polygon);
    py::class_<SchottkyResult, MapReport>(m, "SchottkyResult")
        .def_property_readonly("uv", [](const SchottkyResult& r) { return r.uv; })
        .def("report", [](const SchottkyResult& r) { return to_object(to_json(r)); });
    m.def("schottky_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                             const SchottkyOptions& options, const py::object& progress, const CancelToken& cancel) {
        return without_gil(progress, cancel, [&](ExecutionContext& context) {
            return schottky_map(vertices, triangles, options, context);
        });
    });
    m.def("boundary_loops", [](const Eigen::Ref<const Triangles>& triangles, Index vertex_count) {
        return detached(
            [faces = Triangles(triangles), vertex_count] { return analyze_surface(faces, vertex_count).loops; },
            triangles.rows() < small_mesh);
    });
    m.def("fill_holes", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                           const std::optional<std::vector<Index>>& loops, bool fair) {
        FilledSurface filled = detached([positions = Vertices(vertices), faces = Triangles(triangles), loops, fair] {
            return fair ? fill_and_fair_holes(positions, faces, loops) : fill_holes(positions, faces, loops);
        });
        return std::make_tuple(std::move(filled.vertices), std::move(filled.triangles),
                               py::array_t<Index>(filled.label.size(), filled.label.data()));
    });
    using Indices = Eigen::Ref<const Eigen::VectorX<Index>>;
    m.def("triangulate", [](const Eigen::Ref<const Vertices>& vertices, const Indices& corners, const Indices& begin) {
        PolygonMesh mesh{vertices, {corners.begin(), corners.end()}, {begin.begin(), begin.end()}};
        const bool small = begin.size() < small_mesh;
        const Triangulation cut = detached([mesh = std::move(mesh)] { return triangulate(mesh); }, small);
        return std::make_tuple(cut.triangles, py::array_t<Index>(cut.face.size(), cut.face.data()));
    });
    m.def("parse_mesh", [](const std::string& bytes, const std::string& extension) {
        const PolygonMesh mesh = detached([bytes, extension] { return parse_mesh(bytes, extension); });
        return std::make_tuple(mesh.vertices, array_of(mesh.corners), array_of(mesh.face_begin));
    });
    m.def("harmonic_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                             const std::vector<Index>& fixed, const Eigen::Ref<const PlanarPoints>& values,
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
    m.def("disk_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles) {
        return detached([positions = Vertices(vertices), faces = Triangles(triangles)] {
            fix_product_blocks();
            const Surface surface = surface_with_loops(positions, faces, 1);
            return planar(disk_map(surface.triangles, edge_lengths(positions, surface.triangles), surface.vertex_count,
                                   surface.loops[0])
                              .positions);
        });
    });
    m.def("annulus_map", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                            AnnulusBackend backend) {
        return detached([positions = Vertices(vertices), faces = Triangles(triangles), backend] {
            fix_product_blocks();
            return annulus_by(backend, positions, faces);
        });
    });
    m.def("distortion", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                           const Eigen::Ref<const PlanarPoints>& uv) {
        const auto measure = [positions = Vertices(vertices), faces = Triangles(triangles), points = PlanarPoints(uv)] {
            return Distortion{measure_distortion(positions, faces, points), judge_disk(positions, faces, points)};
        };
        return to_object(to_json(detached(measure, triangles.rows() < small_mesh)));
    });
    m.def("conformal_module", [](const PlanarPoints& centers, const VectorXd& radii, const std::vector<int>& order) {
        return detached([circles = circles_of(centers, radii), order] { return conformal_module(circles, order); },
                        true);
    });
    m.def("module_names", &module_names);
    m.def("module_error", &module_error);
    m.def("refined_circles", [](const MappedSurface& surface, const UniformizeOptions& options) {
        std::vector<Circle> circles = without_gil(py::none(), {}, [&](ExecutionContext& context) {
            return refined_circles(surface.vertices, surface.triangles, surface.loops, options, context);
        });
        PlanarPoints centers(static_cast<Eigen::Index>(circles.size()), 2);
        VectorXd radii(centers.rows());
        for (Eigen::Index k = 0; k < radii.size(); ++k) {
            centers.row(k) << circles[k].center.real(), circles[k].center.imag();
            radii[k] = circles[k].radius;
        }
        return std::make_tuple(centers, radii);
    });
    m.def("require_own_circles", [](const std::vector<bool>& own) {
        std::vector<LoopReport> loops(own.size());
        for (std::size_t k = 0; k < own.size(); ++k) loops[k].shrunk = !own[k];
        require_own_circles(loops);
    });
    m.def("canonical_order", [](const PlanarPoints& centers, const VectorXd& radii, bool any_outer) {
        return detached(
            [circles = circles_of(centers, radii), any_outer] { return canonical_order(circles, any_outer); });
    });
    m.def("match_loops", [](const PlanarPoints& centers_a, const VectorXd& radii_a, const PlanarPoints& centers_b,
                            const VectorXd& radii_b, bool any_outer) {
        return detached([a = circles_of(centers_a, radii_a), b = circles_of(centers_b, radii_b), any_outer] {
            LoopMatch match = match_loops(a, b, any_outer);
            return std::make_tuple(std::move(match.order_a), std::move(match.order_b), match.distance);
        });
    });

    py::class_<DomainAlignment>(m, "DomainAlignment",
                                "An automorphism of the unit disk that lays one circle domain "
                                "over another: z -> turn (z - a) / (1 - conj(a) z).")
        .def_property_readonly("a", [](const DomainAlignment& d) { return d.map.a; })
        .def_property_readonly("turn", [](const DomainAlignment& d) { return d.map.turn; })
        .def_readonly("match", &DomainAlignment::match)
        .def_readonly("residual", &DomainAlignment::residual)
        .def_readonly("largest", &DomainAlignment::largest)
        .def_readonly("worst", &DomainAlignment::worst)
        .def_readonly("misses", &DomainAlignment::misses)
        .def_readonly("converged", &DomainAlignment::converged)
        .def("__call__", [](const DomainAlignment& d, const Eigen::Ref<const PlanarPoints>& points) {
            return planar(d.map(complex(points)));
        });
    [[maybe_unused]] const auto point = py::class_<SurfacePoint>(m, "SurfacePoint");
    m.def("surface_points", [](const Eigen::Ref<const Vertices>& vertices, const Eigen::Ref<const Triangles>& triangles,
                               const std::vector<Index>& numbers, const Eigen::Ref<const Vertices>& positions) {
        std::vector<NamedPoint> points;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            points.push_back({numbers[i], positions.row(static_cast<Eigen::Index>(i))});
        return detached([all = Vertices(vertices), faces = Triangles(triangles), points] {
            return surface_points(all, faces, points);
        });
    });
    m.def("correspond",
          [](const MappedSurface& source, const MappedSurface& target, const std::vector<int>& match, bool fit_holes,
             const std::vector<SurfacePoint>& on_source, const std::vector<SurfacePoint>& on_target) {
              std::vector<Landmark> landmarks;
              for (std::size_t i = 0; i < on_source.size(); ++i) landmarks.push_back({on_target[i], on_source[i]});
              const CorrespondenceOptions options{.match = match, .fit_holes = fit_holes, .landmarks = landmarks};
              Correspondence found = without_gil(py::none(), {}, [&](ExecutionContext& context) {
                  return run_detachable<Correspondence>(context, [source, target, options](ExecutionContext& own) {
                      fix_product_blocks();
                      return correspond(source, target, options, own);
                  });
              });
              py::dict parts;
              parts["alignment"] = found.alignment;
              parts["fitted"] = found.fitted;
              parts["uv"] = found.uv;
              parts["beltrami"] = py::dict(py::arg("mean") = found.beltrami.mean, py::arg("max") = found.beltrami.max);
              parts["flipped"] = found.folded;
              parts["faces"] = found.places.face;
              parts["weights"] = found.places.weights;
              parts["distances"] = found.places.distance;
              parts["points"] = found.points;
              parts["warnings"] = to_object(to_json(found.warnings));
              return parts;
          });
    m.def("align_domains",
          [](const PlanarPoints& source_centers, const VectorXd& source_radii, const PlanarPoints& target_centers,
             const VectorXd& target_radii, const std::vector<int>& match) {
              return detached([source = circles_of(source_centers, source_radii),
                               target = circles_of(target_centers, target_radii),
                               match] { return align_domains(source, target, match); });
          });
}
