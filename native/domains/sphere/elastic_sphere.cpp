#include "sphere/elastic_sphere.h"

#include "even/even_map.h"
#include "even/wanted_shapes.h"
#include "foldover/face_energy.h"
#include "sphere/sphere_check.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr double unregularized = 1e-9;   // the epsilon of the energy: its faces are upright
constexpr double diagonal_shift = 1e-8;  // of the Hessian, relative: turns of the sphere cost nothing
constexpr double least_fall = 1e-4;      // of the energy, over the fall that the slope promises (Armijo)
constexpr int most_halvings = 30;

constexpr double nearest_size = 8.0;  // most ratio of the area that a face wants next to its present area,
constexpr double few_far_off = 1e-3;  // until sizes differ by more only on this share of the area
constexpr int most_approaches = 30;
constexpr int steps_an_approach = 4;
constexpr int last_steps = 60;
constexpr double settled_fall = 5e-4;   // relative decrease of the energy
constexpr double lightest_face = 1e-3;  // weight of a face, over the mean

using Frame = Eigen::Matrix<double, 3, 2>;  // two unit vectors

/// A flat face: its plane's axes, and the second and the third corner minus the first, in the plane.
struct FlatFace {
    Frame axes;
    Complex second, third;
};

FlatFace flat_face(const Vertices& points, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::Vector3d a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)).transpose() - a,
                          c = points.row(triangles(f, 2)).transpose() - a;
    FlatFace face;
    const Eigen::Vector3d x = b.normalized(), normal = b.cross(c).normalized();
    face.axes << x, normal.cross(x);
    face.second = {b.norm(), 0.0};
    face.third = {x.dot(c), face.axes.col(1).dot(c)};
    return face;
}

class SphereRelaxation {
public:
    SphereRelaxation(const ElasticSphere& sphere, Vertices& points, KeptFactor& factor)
        : sphere_(sphere),
          points_(points),
          factor_(factor),
          energy_{sphere.area_weight, sphere.slack > 0.0 ? 2.0 : 1.0, sphere.slack, unregularized}
    {
        if (sphere.slack > 0.0) energy_.scale = std::sqrt(2.0 * (sphere.area_weight + sphere.slack));
        least_ = sphere.slack > 0.0 ? energy_.excess(2.0 + 2.0 * sphere.area_weight) : 2.0 + 2.0 * sphere.area_weight;
        least_ *= (sphere.slack > 0.0 ? least_ : 1.0);
        for (const Eigen::Matrix2d& reference : sphere.reference) shapes_.emplace_back(reference);
        first_.assign(static_cast<std::size_t>(points.rows()), -1);
        for (const Index v : sphere.triangles.reshaped()) first_[v] = 0;
        for (std::size_t v = 0; v < first_.size(); ++v) {
            const bool moves = first_[v] == 0 && (sphere.held.empty() || !sphere.held[v]);
            first_[v] = moves ? std::exchange(unknowns_, unknowns_ + 2) : -1;
        }
    }

    ElasticRelaxation run(int most_steps, double settled, const ExecutionContext& context)
    {
        ElasticRelaxation done;
        if (unknowns_ == 0) return {0, true};
        for (double now = energy(points_); done.steps < most_steps;) {
            context.checkpoint();
            const double before = now;
            if (!step(now)) {
                done.settled = true;
                break;
            }
            ++done.steps;
            if (before - now <= settled * std::abs(before)) {
                done.settled = true;
                break;
            }
        }
        return done;
    }

private:
    /// Without its least value, so that relative decreases mean something.
    double energy(const Vertices& points) const
    {
        double sum = 0.0;
        for (Eigen::Index f = 0; f < sphere_.triangles.rows(); ++f) {
            const FlatFace face = flat_face(points, sphere_.triangles, f);
            sum +=
                sphere_.weight[f] * (scaled(energy_(shapes_[f].map_to(face.second, face.third), 0.0)) - scaled(least_));
        }
        return sphere_.residuals ? sum + 0.5 * sphere_.residuals(points, nullptr).squaredNorm() : sum;
    }

    /// phi from the term of a face: half the term if it is linear.
    double scaled(double term) const { return sphere_.slack > 0.0 ? term : 0.5 * term; }

    Frame tangents(Eigen::Index v) const
    {
        const Eigen::Vector3d normal = points_.row(v);
        Frame frame;
        frame.col(0) = normal.unitOrthogonal();
        frame.col(1) = normal.cross(frame.col(0));
        return frame;
    }

    /// Newton's direction, in the tangent planes.
    std::pair<VectorXd, double> direction()
    {
        std::vector<Frame> frame(first_.size());
        for (std::size_t v = 0; v < frame.size(); ++v)
            if (first_[v] >= 0) frame[v] = tangents(static_cast<Eigen::Index>(v));
        VectorXd gradient = VectorXd::Zero(unknowns_);
        entries_.clear();
        const auto add = [&](Index row, Index column, const Eigen::Matrix2d& block) {
            if (row < column) return;
            for (int c = 0; c < 2; ++c)
                for (int r = row == column ? c : 0; r < 2; ++r) entries_.emplace_back(row + r, column + c, block(r, c));
        };
        for (Eigen::Index f = 0; f < sphere_.triangles.rows(); ++f) {
            const FlatFace face = flat_face(points_, sphere_.triangles, f);
            const double weight = sphere_.slack > 0.0 ? sphere_.weight[f] : 0.5 * sphere_.weight[f];
            const FaceDerivatives slopes =
                energy_.derivatives(shapes_[f].map_to(face.second, face.third), 0.0, weight, shapes_[f]);
            std::array<Eigen::Matrix2d, 3> turn;  // from the plane of the face to the vertices' tangent planes
            for (int k = 0; k < 3; ++k) {
                const Index v = sphere_.triangles(f, k);
                if (first_[v] < 0) continue;
                turn[k] = frame[v].transpose() * face.axes;
                gradient.segment<2>(first_[v]) +=
                    turn[k] * Eigen::Vector2d(slopes.gradient[k].real(), slopes.gradient[k].imag());
            }
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) {
                    const Index row = first_[sphere_.triangles(f, k)], column = first_[sphere_.triangles(f, l)];
                    if (row < 0 || column < 0) continue;
                    add(row, column, turn[k] * slopes.block(k, l, shapes_[f]) * turn[l].transpose());
                }
        }
        if (sphere_.residuals) {
            std::vector<Vertices> slopes;
            const MatrixXd residuals = sphere_.residuals(points_, &slopes);
            for (std::size_t v = 0; v < first_.size(); ++v)
                for (std::size_t k = 0; first_[v] >= 0 && k < slopes.size(); ++k) {
                    const Eigen::Index row = static_cast<Eigen::Index>(v);
                    const Eigen::Vector2d slope = frame[v].transpose() * slopes[k].row(row).transpose();
                    gradient.segment<2>(first_[v]) += residuals(row, static_cast<Eigen::Index>(k)) * slope;
                    add(first_[v], first_[v], slope * slope.transpose());
                }
        }
        hessian_.resize(unknowns_, unknowns_);
        hessian_.setFromTriplets(entries_.begin(), entries_.end());
        return newton_descent(hessian_, gradient, diagonal_shift, factor_);
    }

    Vertices moved(const VectorXd& step, double share) const
    {
        Vertices result = points_;
        for (std::size_t v = 0; v < first_.size(); ++v) {
            if (first_[v] < 0) continue;
            const Eigen::Index row = static_cast<Eigen::Index>(v);
            const Eigen::Vector3d along = tangents(row) * step.segment<2>(first_[v]);
            result.row(row) = (points_.row(row) + share * along.transpose()).normalized();
        }
        return result;
    }

    /// @param now the energy, before and after the step @return whether a step lowers it
    bool step(double& now)
    {
        const auto [way, slope] = direction();
        if (!(slope < 0.0)) return false;
        double share = 1.0;
        for (int i = 0; i < most_halvings; ++i, share *= 0.5) {
            Vertices trial = moved(way, share);
            if (!trial.allFinite() || !all_upright(sphere_.triangles, trial)) continue;
            const double there = energy(trial);
            if (!(there <= now + least_fall * share * slope)) continue;
            points_ = std::move(trial);
            now = there;
            return true;
        }
        return false;
    }

    const ElasticSphere& sphere_;
    Vertices& points_;
    KeptFactor& factor_;
    FaceEnergy energy_;
    double least_ = 0.0;  // of a face's term
    std::vector<WantedShape> shapes_;
    std::vector<Index> first_;  // (V) of a vertex' two unknowns; -1: it stays
    Index unknowns_ = 0;
    std::vector<Eigen::Triplet<double, Index>> entries_;
    SparseMatrix hessian_;
};

}  // namespace

Eigen::Matrix2d flat_edges(const Vertices& points, const Triangles& triangles, Eigen::Index face)
{
    const FlatFace flat = flat_face(points, triangles, face);
    Eigen::Matrix2d edges;
    edges << flat.second.real(), flat.third.real(), flat.second.imag(), flat.third.imag();
    return edges;
}

bool all_upright(const Triangles& triangles, const Vertices& points)
{
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (!upright_on_sphere(triangles, points, f)) return false;
    return true;
}

ElasticRelaxation relax_on_sphere(const ElasticSphere& sphere, Vertices& points, int most_steps, double settled,
                                  KeptFactor& factor, const ExecutionContext& context)
{
    return SphereRelaxation(sphere, points, factor).run(most_steps, settled, context);
}

bool make_sphere_even(const PeriodicSurface& domain, double even, Vertices& points, const ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    if (!all_upright(triangles, points)) return false;
    // The surface, scaled to the area that the faces cover on the sphere, and its faces laid flat.
    const auto area_now = [&](Eigen::Index f) { return 0.5 * flat_edges(points, triangles, f).determinant(); };
    double covered = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) covered += area_now(f);
    const Vertices surface = domain.vertices / scale_to_size(domain.vertices, triangles, 1.0) * std::sqrt(covered);
    const PatchShapes shapes = wanted_shapes(surface, triangles, PlanarPoints::Zero(points.rows(), 2), {});
    ElasticSphere sphere{triangles, shapes.references, shapes.areas.cwiseMax(lightest_face * shapes.areas.mean())};
    sphere.weight /= sphere.weight.sum();
    sphere.area_weight = area_weight(even);
    sphere.held.assign(static_cast<std::size_t>(points.rows()), 0);
    for (const VertexLoop& loop : domain.loops)
        for (const Index v : loop) sphere.held[v] = 1;
    // Sizes within a factor of the present ones are wanted first, until few faces are farther off.
    KeptFactor factor;
    int steps = 0;
    for (int approach = 0; approach < most_approaches; ++approach) {
        double far = 0.0;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            const double ratio = shapes.areas[f] / area_now(f);
            const double wanted = std::clamp(ratio, 1.0 / nearest_size, nearest_size);
            if (wanted != ratio) far += shapes.areas[f];
            sphere.reference[f] = shapes.references[f] * std::sqrt(wanted / ratio);
        }
        if (!(far > few_far_off * shapes.areas.sum())) break;
        steps += relax_on_sphere(sphere, points, steps_an_approach, settled_fall, factor, context).steps;
    }
    // Then the surface's own sizes.
    sphere.reference = shapes.references;
    steps += relax_on_sphere(sphere, points, last_steps, settled_fall, factor, context).steps;
    return steps > 0;
}

}  // namespace koebe
