// Numbers that circles and surfaces give about shapes.
#include "array_conversion.h"
#include "bindings.h"
#include "native_call.h"
#include "option_binding.h"
#include "report_object.h"

#include "certified/capacities.h"
#include "certified/polygonal_circles.h"
#include "linear/dense_spd.h"
#include "pipeline/uniformize.h"
#include "report/capacity_json.h"
#include "report/json.h"
#include "shape/conformal_module.h"
#include "shape/domain_alignment.h"
#include "shape/loop_matching.h"
#include "shape/module_error.h"
#include "shape/separation_distance.h"
#include "surface/surface_point.h"
#include "transfer/correspondence.h"
#include "transfer/sphere_places.h"
#include "transfer/sphere_registration.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace koebe::python {

void bind_shapes(py::module_& m)
{
    // A surface with its map, and the module of its circles.
    py::class_<MappedSurface>(m, "MappedSurface")
        .def(py::init([](const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                         const std::vector<VertexLoop>& loops, const std::vector<std::vector<Index>>& off_circle,
                         const PlanarPoints& centers, const VectorXd& radii, const std::vector<bool>& own) {
            MappedSurface surface{vertices, triangles, uv, {}};
            const std::vector<Circle> circles = circles_of(centers, radii);
            for (std::size_t k = 0; k < loops.size(); ++k)
                surface.loops.push_back({{loops[k], {}, off_circle[k]}, circles[k], 0.0, !own[k]});
            return surface;
        }));
    m.def("conformal_module", [](const PlanarPoints& centers, const VectorXd& radii, const std::vector<int>& order) {
        return detached([circles = circles_of(centers, radii), order] { return conformal_module(circles, order); },
                        true);
    });
    // Errors: enclosures, finer meshes, polygonal rims.
    bind_options<CapacityOptions>(m, "CapacityOptions");
    m.def("certified_capacities",
          [](const Vertices& vertices, const Triangles& triangles,
             const std::vector<std::pair<std::vector<int>, std::vector<int>>>& between, const CapacityOptions& options,
             const py::object& progress, const CancelToken& cancel) {
              std::vector<Condenser> condensers;
              for (const auto& [low, high] : between) condensers.push_back({low, high});
              return to_object(to_json(without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return certified_capacities(vertices, triangles, condensers, options, context);
              })));
          });
    m.def("module_names", &module_names);
    m.def("module_error", &module_error);
    m.def("refined_circles", [](const MappedSurface& surface, const UniformizeOptions& options,
                                const py::object& progress, const CancelToken& cancel) {
        return arrays_of(without_gil(progress, cancel, [&](ExecutionContext& context) {
            return refined_circles(surface.vertices, surface.triangles, surface.loops, options, context);
        }));
    });
    m.def("polygonal_circles",
          [](const MappedSurface& surface, int threads, const py::object& progress, const CancelToken& cancel) {
              const PolygonalCircles found = without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return polygonal_circles(surface.vertices, surface.triangles, surface.loops, threads, context);
              });
              return py::make_tuple(arrays_of(found.circles), arrays_of(found.of_upper_bounds));
          });
    m.def("extrapolated_circles", [](const PlanarPoints& centers_a, const VectorXd& radii_a,
                                     const PlanarPoints& centers_b, const VectorXd& radii_b) {
        return arrays_of(extrapolated_circles(circles_of(centers_a, radii_a), circles_of(centers_b, radii_b)));
    });
    m.def("polygonal_changes", [](const MappedSurface& surface) {
        return polygonal_changes(surface.vertices, surface.triangles, surface.uv, surface.loops);
    });
    m.def("require_own_circles", [](const std::vector<bool>& own) {
        std::vector<LoopReport> loops(own.size());
        for (std::size_t k = 0; k < own.size(); ++k) loops[k].shrunk = !own[k];
        require_own_circles(loops);
    });
    // Which loop corresponds to which.
    m.def("canonical_order", [](const PlanarPoints& centers, const VectorXd& radii, bool any_outer) {
        return detached(
            [circles = circles_of(centers, radii), any_outer] { return canonical_order(circles, any_outer); });
    });
    m.attr("ambiguous_margin") = ambiguous_margin;
    m.def("match_loops", [](const PlanarPoints& centers_a, const VectorXd& radii_a, const PlanarPoints& centers_b,
                            const VectorXd& radii_b, bool any_outer) {
        return detached([a = circles_of(centers_a, radii_a), b = circles_of(centers_b, radii_b), any_outer] {
            LoopMatch match = match_loops(a, b, any_outer);
            return std::make_tuple(std::move(match.order_a), std::move(match.order_b), match.distance, match.margin);
        });
    });
    m.def("conformal_separations", [](const PlanarPoints& centers, const VectorXd& radii) {
        return detached([circles = circles_of(centers, radii)] { return conformal_separations(circles); });
    });
    m.def("match_separations", [](const PlanarPoints& centers_a, const VectorXd& radii_a, const PlanarPoints& centers_b,
                                  const VectorXd& radii_b, bool any_outer) {
        return detached([a = circles_of(centers_a, radii_a), b = circles_of(centers_b, radii_b), any_outer] {
            SeparationMatch match = match_separations(a, b, any_outer);
            return std::make_tuple(std::move(match.match), match.distance);
        });
    });
    m.def("separation_distance",
          [](const PlanarPoints& centers_a, const VectorXd& radii_a, const PlanarPoints& centers_b,
             const VectorXd& radii_b, const std::vector<int>& match) {
              return separation_distance(circles_of(centers_a, radii_a), circles_of(centers_b, radii_b), match);
          });

    // One domain laid over another.
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
        .def_readonly("margin", &DomainAlignment::margin)
        .def("__call__", [](const DomainAlignment& d, Points points) { return planar(d.map(complex(points))); })
        .def(py::pickle(
            [](const DomainAlignment& d) {
                return py::make_tuple(d.map.a, d.map.turn, d.match, d.residual, d.largest, d.worst, d.misses,
                                      d.iterations, d.converged, d.margin);
            },
            [](const py::tuple& state) {
                return DomainAlignment{{state[0].cast<Complex>(), state[1].cast<Complex>()},
                                       state[2].cast<std::vector<int>>(),
                                       state[3].cast<double>(),
                                       state[4].cast<double>(),
                                       state[5].cast<int>(),
                                       state[6].cast<std::vector<double>>(),
                                       state[7].cast<int>(),
                                       state[8].cast<bool>(),
                                       state[9].cast<double>()};
            }));
    // Points of one surface on another, through the two domains.
    py::class_<SurfacePoint>(m, "SurfacePoint")
        .def("place", [](const SurfacePoint& point, const PlanarPoints& uv, const Triangles& triangles) {
            const Eigen::RowVector2d at = point.of(uv, triangles);
            return Complex(at[0], at[1]);
        });
    m.def("surface_points",
          [](Positions vertices, Faces triangles, const std::vector<Index>& numbers, Positions positions) {
              std::vector<NamedPoint> points;
              for (std::size_t i = 0; i < numbers.size(); ++i)
                  points.push_back({numbers[i], positions.row(static_cast<Eigen::Index>(i))});
              return detached([all = Vertices(vertices), faces = Triangles(triangles), points] {
                  return surface_points(all, faces, points);
              });
          });
    m.def("correspond",
          [](const MappedSurface& source, const MappedSurface& target, const std::vector<int>& match, bool fit_holes,
             const std::vector<SurfacePoint>& on_source, const std::vector<SurfacePoint>& on_target, bool extremal,
             const py::object& progress, const CancelToken& cancel) {
              std::vector<Landmark> landmarks;
              for (std::size_t i = 0; i < on_source.size(); ++i) landmarks.push_back({on_target[i], on_source[i]});
              const CorrespondenceOptions options{
                  .match = match, .fit_holes = fit_holes, .landmarks = landmarks, .extremal = extremal};
              Correspondence found = without_gil(progress, cancel, [&](ExecutionContext& context) {
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
    // The same on spheres.
    py::class_<SpherePlaces>(m, "SpherePlaces")
        .def(py::init<const Vertices&, const Triangles&>())
        .def("at", [](const SpherePlaces& all, const Vertices& places) {
            Eigen::VectorX<Index> faces(places.rows());
            Vertices weights(places.rows(), 3);
            for (Eigen::Index i = 0; i < places.rows(); ++i) {
                const SurfacePoint at = all.at(places.row(i).transpose());
                faces[i] = at.face;
                weights.row(i) = at.weights;
            }
            return std::make_pair(std::move(faces), std::move(weights));
        });
    m.def("register_spheres",
          [](const Vertices& vertices_a, const Triangles& triangles_a, const Vertices& points_a,
             const MatrixXd& fields_a, const Vertices& vertices_b, const Triangles& triangles_b,
             const Vertices& points_b, const MatrixXd& fields_b, const std::vector<Index>& landmarks,
             const Vertices& places, double stiffness, const py::object& progress, const CancelToken& cancel) {
              const SphereSurface a{vertices_a, triangles_a, points_a, fields_a};
              const SphereSurface b{vertices_b, triangles_b, points_b, fields_b};
              std::vector<SphereLandmark> pairs;
              for (std::size_t i = 0; i < landmarks.size(); ++i)
                  pairs.push_back({landmarks[i], places.row(static_cast<Eigen::Index>(i)).transpose()});
              const SphereRegistration found = without_gil(progress, cancel, [&](ExecutionContext& context) {
                  return run_detachable<SphereRegistration>(context, [a, b, pairs, stiffness](ExecutionContext& own) {
                      fix_product_blocks();
                      return register_spheres(a, b, pairs, stiffness, own);
                  });
              });
              py::dict parts;
              parts["sphere"] = found.points;
              parts["beltrami"] = py::dict(py::arg("mean") = found.beltrami.mean, py::arg("max") = found.beltrami.max);
              parts["log_area_sd"] = found.log_area_sd;
              parts["steps"] = found.steps;
              parts["settled"] = found.settled;
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

}  // namespace koebe::python
