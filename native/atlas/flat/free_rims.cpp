#include "flat/free_rims.h"

#include "core/complex_places.h"
#include "cost/tolerances.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/distortion.h"
#include "surface/laplacian.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace koebe {
namespace {

constexpr Eigen::Index most_faces = 30000;  // most faces of a part that moves as a whole
constexpr int rings = 12;                   // rings that move in a larger part
constexpr int most_steps = 5;
constexpr double worthwhile_fall = 5e-3;    // relative fall of the angle error that is worth another step
constexpr int halvings = 4;                 // of a step
constexpr double tether = 0.2;              // eps
constexpr double least_distortion = 0.3;    // |mu| at which a weight is taken, over the mean
constexpr double least_face_height = 1e-2;  // of a face, over its longest edge

/// f_zbar = sum zbar_k f_k and f_z = sum z_k f_k of a face's linear map.
struct FaceWeights {
    std::array<Complex, 3> zbar, z;
};

FaceWeights face_weights(double l01, double l12, double l20)
{
    const double longest = std::max({l01, l12, l20, 1e-300});
    const double base = std::max(l01, least_face_height * longest);
    const double height = std::max(2.0 * triangle_area(l01, l12, l20) / base, least_face_height * longest);
    const double x = (base * base + l20 * l20 - l12 * l12) / (2.0 * base);
    const std::array<Complex, 3> p{Complex(0.0, 0.0), Complex(base, 0.0), Complex(x, height)};
    FaceWeights weights;
    for (int k = 0; k < 3; ++k) {
        const Complex gradient = Complex(0.0, 1.0) * (p[(k + 2) % 3] - p[(k + 1) % 3]) / (base * height);
        weights.zbar[k] = 0.5 * gradient;
        weights.z[k] = 0.5 * std::conj(gradient);
    }
    return weights;
}

class RimProblem {
public:
    RimProblem(const Vertices& vertices, const Surface& surface, const RimFreedom& freedom, const PlanarPoints& start)
        : vertices_(vertices), same_(freedom.same), start_(start)
    {
        choose_faces(surface, freedom);
        const EdgeLengths lengths = edge_lengths(vertices_, faces_);
        for (Eigen::Index f = 0; f < faces_.rows(); ++f)
            weights_.push_back(face_weights(lengths(f, 0), lengths(f, 1), lengths(f, 2)));
    }
    bool empty() const { return unknowns_ == 0; }

    /// The way of each vertex in the least squares step from some points.
    PlanarPoints step(const PlanarPoints& points)
    {
        std::vector<Eigen::Triplet<Complex, Index>> entries;
        VectorXcd right = VectorXcd::Zero(unknowns_);
        add_faces(points, entries, right);
        add_tethers(points, entries, right);
        Matrix normal(unknowns_, unknowns_);
        normal.setFromTriplets(entries.begin(), entries.end());
        if (!analyzed_) solver_.analyzePattern(normal);
        analyzed_ = true;
        solver_.factorize(normal);
        PlanarPoints way = PlanarPoints::Zero(points.rows(), 2);
        if (solver_.info() != Eigen::Success) return way;
        const VectorXcd solution = solver_.solve(right);
        for (std::size_t v = 0; v < same_.size(); ++v)
            if (const Index row = unknown(static_cast<Index>(v)); row >= 0)
                way.row(static_cast<Eigen::Index>(v)) << solution[row].real(), solution[row].imag();
        return way;
    }
    double angle_error(const PlanarPoints& points) const
    {
        return measure_distortion(vertices_, faces_, points).angle_error_deg.mean;
    }
    Index turned_over(const PlanarPoints& points) const
    {
        Index count = 0;
        for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
            const Complex a = complex_at(points, faces_(f, 0));
            const Complex b = complex_at(points, faces_(f, 1)) - a, c = complex_at(points, faces_(f, 2)) - a;
            count += !(std::imag(std::conj(b) * c) > 0.0);
        }
        return count;
    }

private:
    using Matrix = Eigen::SparseMatrix<Complex, Eigen::ColMajor, Index>;

    Index unknown(Index v) const { return unknown_[same_[v]]; }

    /// Finds the faces near the rims, and the vertices that move.
    void choose_faces(const Surface& surface, const RimFreedom& freedom)
    {
        const Triangles& triangles = surface.triangles;
        const std::size_t count = freedom.held.size();
        const bool all = triangles.rows() <= most_faces;
        // Faces within some rings of the rims, or all.
        std::vector<char> near(count, all ? 1 : 0), chosen(static_cast<std::size_t>(triangles.rows()), all ? 1 : 0);
        if (!all)
            for (const VertexLoop& loop : surface.loops)
                for (const Index v : loop) near[v] = !freedom.held[v];
        for (int ring = 0; ring < rings && !all; ++ring) {
            std::vector<char> wider = near;
            for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
                const auto row = triangles.row(f);
                if (!near[row[0]] && !near[row[1]] && !near[row[2]]) continue;
                chosen[static_cast<std::size_t>(f)] = 1;
                for (const Index v : row) wider[v] = 1;
            }
            if (ring + 1 < rings) near = std::move(wider);
        }
        // Vertices inside these rings move, unless one in their place is held.
        std::vector<char> moves(count, 1);
        for (std::size_t v = 0; v < count; ++v)
            if (!near[v] || freedom.held[v]) moves[same_[v]] = 0;
        unknown_.assign(count, -1);
        for (std::size_t v = 0; v < count; ++v)
            if (same_[v] == static_cast<Index>(v) && moves[v]) unknown_[v] = unknowns_++;
        faces_.resize(static_cast<Eigen::Index>(std::ranges::count(chosen, 1)), 3);
        for (Eigen::Index f = 0, at = 0; f < triangles.rows(); ++f)
            if (chosen[static_cast<std::size_t>(f)]) faces_.row(at++) = triangles.row(f);
    }

    void add_faces(const PlanarPoints& points, std::vector<Eigen::Triplet<Complex, Index>>& entries,
                   VectorXcd& right) const
    {
        // mu = f_zbar / f_z, with the larger of both as denominator, so that flipped faces stay bounded.
        VectorXcd mu(faces_.rows());
        VectorXd scale(faces_.rows());
        for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
            Complex zbar = 0.0, z = 0.0;
            for (int k = 0; k < 3; ++k) {
                zbar += weights_[f].zbar[k] * complex_at(points, faces_(f, k));
                z += weights_[f].z[k] * complex_at(points, faces_(f, k));
            }
            scale[f] = 1.0 / std::max({std::abs(z), std::abs(zbar), 1e-300});
            mu[f] = scale[f] * zbar;
        }
        // One step for sum |mu| by weights 1 / |mu| (iteratively reweighted least squares).
        const double least = least_distortion * mu.cwiseAbs().mean() + 1e-30;
        for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
            const double weight = 1.0 / std::max(std::abs(mu[f]), least);
            for (int k = 0; k < 3; ++k) {
                const Index row = unknown(faces_(f, k));
                if (row < 0) continue;
                const Complex own = weight * scale[f] * std::conj(weights_[f].zbar[k]);
                right[row] -= own * mu[f];
                for (int l = 0; l < 3; ++l)
                    if (const Index column = unknown(faces_(f, l)); column >= 0)
                        entries.emplace_back(row, column, own * scale[f] * weights_[f].zbar[l]);
            }
        }
    }

    void add_tethers(const PlanarPoints& points, std::vector<Eigen::Triplet<Complex, Index>>& entries,
                     VectorXcd& right) const
    {
        VectorXd edges = VectorXd::Zero(unknowns_), count = edges;
        for (Eigen::Index f = 0; f < faces_.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                for (const int l : {1, 2})
                    if (const Index row = unknown(faces_(f, k)); row >= 0) {
                        edges[row] +=
                            std::norm(complex_at(points, faces_(f, (k + l) % 3)) - complex_at(points, faces_(f, k)));
                        count[row] += 1.0;
                    }
        for (std::size_t v = 0; v < same_.size(); ++v) {
            const Index row = unknown_[v], vertex = static_cast<Index>(v);
            if (row < 0) continue;
            const double pull = tether * count[row] / std::max(edges[row], 1e-300);
            entries.emplace_back(row, row, pull);
            right[row] += pull * (complex_at(start_, vertex) - complex_at(points, vertex));
        }
    }

    const Vertices& vertices_;
    const std::vector<Index>& same_;
    const PlanarPoints start_;
    Triangles faces_;
    std::vector<FaceWeights> weights_;
    std::vector<Index> unknown_;  // (V) the row of the first vertex of a number; -1: held, or another's
    Index unknowns_ = 0;
    Eigen::SimplicialLDLT<Matrix> solver_;
    bool analyzed_ = false;
};

}  // namespace

void free_rims(const Vertices& vertices, const Surface& surface, const RimFreedom& freedom, PlanarPoints& points,
               ExecutionContext& context)
{
    if (!points.allFinite()) return;
    RimProblem problem(vertices, surface, freedom, points);
    if (problem.empty()) return;
    const double extent = box_size(points).maxCoeff();
    const auto crossings = [&](const PlanarPoints& places) {
        return crossing_boundary_edges(surface.loops, places, tolerance::drawn_edge * extent).size() +
               turned_loops(surface.loops, places, tolerance::drawn_edge * extent).size();
    };
    // Newton steps, halved until angles fall, with no more faces turned over and no more crossings.
    const std::size_t crossing = crossings(points);
    Index turned = problem.turned_over(points);
    double error = problem.angle_error(points);
    bool goes_on = true;
    for (int step = 0; step < most_steps && goes_on; ++step) {
        context.checkpoint();
        const PlanarPoints way = problem.step(points);
        goes_on = false;
        if (!way.allFinite()) break;
        double share = 1.0;
        for (int i = 0; i < halvings; ++i, share *= 0.5) {
            const PlanarPoints next = points + share * way;
            const Index over = problem.turned_over(next);
            const double now = problem.angle_error(next);
            if (over > turned || !(now < error) || crossings(next) > crossing) continue;
            goes_on = now < (1.0 - worthwhile_fall) * error;
            turned = over;
            error = now;
            points = next;
            break;
        }
    }
}

}  // namespace koebe
