#include "sphere/sphere_repair.h"

#include "core/sort_unique.h"
#include "execution/thread_share.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/repair_effort.h"
#include "mesh/vertex_faces.h"
#include "sphere/sphere_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr int sphere_ring_counts[] = {2, 4, 8, 16};
constexpr double least_depth =
    0.2;  // of a patch in the direction of its middle: what lies lower is far off in the plane
constexpr std::size_t effort_of_a_face = 50;  // a flipped one takes 67 on a tube of which two fifths are folded
constexpr double least_repaired_area = 1e-7;  // area of a face turned back, over its wanted area

enum class LoopFreedom { held, sliding, freed };

class SphereRepair {
public:
    SphereRepair(const PeriodicSurface& domain, SphericalMap& map, const ExecutionContext& context, std::size_t effort)
        : domain_(domain),
          triangles_(domain.surface.triangles),
          map_(map),
          context_(context),
          effort_(triangles_.rows(), effort),
          most_(effort < whole_effort ? std::min(2 * effort, effort_.most()) : effort_.most())
    {
        effort_.set_limit(most_);
    }

    std::size_t run()
    {
        std::vector<Index> left = all_tangled();
        if (left.empty() || effort_of_a_face * left.size() > most_) return left.size();
        prepare();
        for (const LoopFreedom loops : {LoopFreedom::held, LoopFreedom::sliding, LoopFreedom::freed}) {
            if (loops != LoopFreedom::held && domain_.loops.empty()) break;
            for (const int rings : sphere_ring_counts)
                for (const PatchShape shape : {PatchShape::surface, PatchShape::equilateral}) {
                    if (left.empty() || effort_.exhausted()) break;
                    for (const std::vector<Index>& patch : patches(left, rings)) {
                        work_ += patch.size();
                        repair(patch, shape, loops);
                    }
                    left = all_tangled();
                }
        }
        map_.off_circle.clear();
        for (Index v = 0; v < domain_.surface.vertex_count; ++v)
            if (off_[v]) map_.off_circle.push_back(v);
        return all_tangled().size();
    }

private:
    void prepare()
    {
        const std::size_t vertices = static_cast<std::size_t>(domain_.surface.vertex_count);
        loop_of_.assign(vertices, -1);
        off_.assign(vertices, 0);
        for (std::size_t k = 0; k < domain_.loops.size(); ++k)
            for (const Index v : domain_.loops[k]) loop_of_[v] = static_cast<int>(k);
        faces_of_ = VertexFaces(triangles_, domain_.surface.vertex_count);
        for (const Index v : map_.off_circle) off_[v] = 1;
    }

    bool is_tangled(Index f) const
    {
        return longest_edge_on_sphere(triangles_, map_.points, f) >= sphere_resolution &&
               !upright_on_sphere(triangles_, map_.points, f);
    }

    std::vector<Index> all_tangled() const
    {
        return found_in_pieces(static_cast<Index>(triangles_.rows()), [&](Index f) { return is_tangled(f); });
    }

    std::vector<Index> tangled(const std::vector<Index>& faces) const
    {
        std::vector<Index> result;
        std::ranges::copy_if(faces, std::back_inserter(result), [&](Index f) { return is_tangled(f); });
        return result;
    }

    /// Connected groups of the faces within so many rings of some faces.
    std::vector<std::vector<Index>> patches(const std::vector<Index>& seeds, int rings) const
    {
        std::vector<char> chosen(static_cast<std::size_t>(triangles_.rows()), 0);
        const std::vector<Index> faces = faces_of_.with_rings(triangles_, seeds, rings);
        for (const Index f : faces) chosen[f] = 1;
        std::vector<std::vector<Index>> result;
        for (const Index seed : faces) {
            if (chosen[seed] != 1) continue;
            std::vector<Index> group{seed};
            chosen[seed] = 2;
            for (std::size_t head = 0; head < group.size(); ++head)
                for (const Index v : triangles_.row(group[head]))
                    for (const Index g : faces_of_[v])
                        if (chosen[g] == 1) {
                            chosen[g] = 2;
                            group.push_back(g);
                        }
            std::ranges::sort(group);
            result.push_back(std::move(group));
        }
        return result;
    }

    void repair(std::vector<Index> faces, PatchShape shape, LoopFreedom loops)
    {
        const std::vector<Index> before = tangled(faces);
        if (before.empty()) return;
        SpherePoint axis = SpherePoint::Zero();
        for (const Index f : faces)
            for (const Index v : triangles_.row(f)) axis += map_.points.row(v).transpose();
        if (axis.norm() < 0.6 * 3.0 * static_cast<double>(faces.size())) {  // most of the sphere: round one of them
            axis.setZero();
            for (const Index v : triangles_.row(before[work_ % before.size()])) axis += map_.points.row(v).transpose();
        }
        if (!(axis.norm() > 0.0)) return;
        axis.normalize();
        // Leave out faces too far from the middle to be projected.
        std::erase_if(faces, [&](Index f) {
            return std::ranges::any_of(
                triangles_.row(f), [&](Index v) { return !(map_.points.row(v).dot(axis.transpose()) > least_depth); });
        });
        if (faces.empty()) return;
        std::vector<Index> vertices;
        for (const Index f : faces)
            for (const Index v : triangles_.row(f)) vertices.push_back(v);
        sort_unique(vertices);
        const auto number = [&](Index v) {
            return static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin());
        };
        const SpherePoint x = axis.unitOrthogonal(), y = axis.cross(x);
        const auto flat = [&](const SpherePoint& p) -> Eigen::RowVector2d {
            return {p.dot(x) / p.dot(axis), p.dot(y) / p.dot(axis)};
        };
        const Eigen::Index count = static_cast<Eigen::Index>(vertices.size());
        PlanarPoints plane(count, 2);
        for (Eigen::Index i = 0; i < count; ++i)
            plane.row(i) = flat(map_.points.row(vertices[static_cast<std::size_t>(i)]).transpose());
        const Eigen::RowVector2d low = plane.colwise().minCoeff(), high = plane.colwise().maxCoeff();
        const Eigen::RowVector2d middle = 0.5 * (low + high);
        const double size = 0.5 * (high - low).maxCoeff();
        if (!(size > sphere_resolution)) return;
        plane = (plane.rowwise() - middle) / size;

        FoldoverProblem problem;
        problem.points = plane;
        problem.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (int k = 0; k < 3; ++k)
                problem.triangles(static_cast<Eigen::Index>(i), k) = number(triangles_(faces[i], k));
        problem.mobility.assign(vertices.size(), FoldoverProblem::Mobility::held);
        problem.circles.resize(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Index v = vertices[i];
            if (!std::ranges::all_of(faces_of_[v], [&](Index f) { return std::ranges::binary_search(faces, f); }))
                continue;
            if (loop_of_[v] < 0 || off_[v] || loops == LoopFreedom::freed) {
                problem.mobility[i] = FoldoverProblem::Mobility::free;
            } else if (loops == LoopFreedom::sliding) {
                if (const auto circle = circle_near(v, flat)) {
                    problem.mobility[i] = FoldoverProblem::Mobility::sliding;
                    problem.circles[i] = {(circle->center - Complex(middle[0], middle[1])) / size,
                                          circle->radius / size};
                }
            }
        }
        // Faces that cannot move would only cost time.
        std::vector<Eigen::Index> kept;
        for (Eigen::Index f = 0; f < problem.triangles.rows(); ++f)
            if (std::ranges::any_of(problem.triangles.row(f),
                                    [&](Index v) { return problem.mobility[v] != FoldoverProblem::Mobility::held; }))
                kept.push_back(f);
        if (kept.empty()) return;
        problem.triangles = Triangles(problem.triangles(kept, Eigen::all));
        std::vector<Index> order(kept.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
        const PatchShapes shapes =
            patch_shapes(domain_.vertices(vertices, Eigen::all), problem.triangles, plane, order, shape);
        problem.reference = shapes.references;
        problem.floor.resize(problem.triangles.rows());
        for (Eigen::Index f = 0; f < problem.triangles.rows(); ++f) {
            const Eigen::RowVector2d a = plane.row(problem.triangles(f, 1)) - plane.row(problem.triangles(f, 0));
            const Eigen::RowVector2d b = plane.row(problem.triangles(f, 2)) - plane.row(problem.triangles(f, 0));
            const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
            problem.floor[f] =
                area > 0.0 ? std::min(least_repaired_area, 0.5 * area / shapes.areas[f]) : least_repaired_area;
        }
        const int affordable = effort_.affordable(problem.triangles.rows());
        if (affordable == 0) return;
        effort_.spend(problem.triangles.rows(),
                      minimize_foldover_free(problem, context_, {.max_iterations = affordable}).iterations);
        if (!problem.points.allFinite()) return;
        write_if_better(
            faces, vertices, problem,
            [&](const Eigen::RowVector2d& at) {
                const Eigen::RowVector2d place = middle + size * at;
                return SpherePoint(axis + place[0] * x + place[1] * y).normalized();
            },
            before.size());
    }

    /// The circle of the plane that best fits the image of a loop's circle near a vertex.
    template <typename Flat>
    std::optional<Circle> circle_near(Index v, const Flat& flat) const
    {
        const Cap& cap = map_.caps[static_cast<std::size_t>(loop_of_[v])];
        const SpherePoint at = map_.points.row(v);
        const SpherePoint along = cap.center.cross(at);
        const double step = 1e-3 * std::sin(cap.radius);
        if (!(along.norm() > 0.0) || !(step > sphere_resolution)) return std::nullopt;
        std::array<Complex, 3> p;
        for (int i = 0; i < 3; ++i) {
            const Eigen::RowVector2d q = flat(onto_circle(cap, at + (i - 1) * step * along.normalized()));
            p[static_cast<std::size_t>(i)] = {q[0], q[1]};
        }
        const Complex b = p[0] - p[1], c = p[2] - p[1];
        const double area = 2.0 * (b.real() * c.imag() - b.imag() * c.real());
        if (!(std::abs(area) > 1e-12 * std::abs(b) * std::abs(c))) return std::nullopt;
        const Complex center = (std::norm(b) * c - std::norm(c) * b) * Complex(0.0, -1.0) / area;
        return Circle{p[1] + center, std::abs(center)};
    }

    /// Keeps the new places if fewer faces are flipped.
    template <typename Lift>
    void write_if_better(const std::vector<Index>& faces, const std::vector<Index>& vertices,
                         const FoldoverProblem& problem, const Lift& lift, std::size_t before)
    {
        Vertices old(static_cast<Eigen::Index>(vertices.size()), 3);
        std::vector<Index> freed;
        // Back to the sphere. Rims that slid return to their circle; those that were freed leave it.
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Eigen::Index row = static_cast<Eigen::Index>(i);
            const Index v = vertices[i];
            old.row(row) = map_.points.row(v);
            if (problem.mobility[i] == FoldoverProblem::Mobility::held) continue;
            SpherePoint place = lift(problem.points.row(row));
            if (problem.mobility[i] == FoldoverProblem::Mobility::sliding)
                place = onto_circle(map_.caps[static_cast<std::size_t>(loop_of_[v])], place);
            else if (loop_of_[v] >= 0 && !off_[v])
                freed.push_back(v);
            map_.points.row(v) = place.transpose();
        }
        // Judge, and undo if nothing is gained.
        const bool better = tangled(faces).size() < before && loops_hold(vertices);
        if (!better) {
            for (std::size_t i = 0; i < vertices.size(); ++i)
                map_.points.row(vertices[i]) = old.row(static_cast<Eigen::Index>(i));
            return;
        }
        for (const Index v : freed) off_[v] = 1;
    }

    /// Whether the loops of these vertices are still simple.
    bool loops_hold(const std::vector<Index>& vertices) const
    {
        std::vector<int> touched;
        for (const Index v : vertices)
            if (loop_of_[v] >= 0) touched.push_back(loop_of_[v]);
        sort_unique(touched);
        for (const int k : touched) {
            const std::size_t loop = static_cast<std::size_t>(k);
            const Triangles none(0, 3);
            if (!find_sphere_faults(none, {domain_.loops[loop]}, map_.points, {map_.caps[loop]}).holes.empty())
                return false;
        }
        return true;
    }

    const PeriodicSurface& domain_;
    const Triangles& triangles_;
    SphericalMap& map_;
    const ExecutionContext& context_;
    RepairEffort effort_;
    const std::size_t most_;  // effort
    std::vector<int> loop_of_;
    VertexFaces faces_of_;
    std::vector<char> off_;
    std::size_t work_ = 0;
};

}  // namespace

std::size_t turn_back_on_sphere(const PeriodicSurface& domain, SphericalMap& map, const ExecutionContext& context,
                                std::size_t effort)
{
    return SphereRepair(domain, map, context, effort).run();
}

}  // namespace koebe
