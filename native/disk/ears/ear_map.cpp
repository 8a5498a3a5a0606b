#include "ears/ear_map.h"

#include "linear/sparse_cholesky.h"
#include "planar/planar_predicates.h"
#include "surface/free_flattening.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double flatter[] = {1.0, 0.7, 0.5, 0.35, 0.25, 0.15};  // heights tried, over the natural height
constexpr int lens_level = static_cast<int>(std::size(flatter));
constexpr double least_share = 0.3;  // of the mean edge along a rim
constexpr double lens_reach = 0.9;   // of the way from the hinge to the middle of the hole
constexpr double lens_aspect = 1.0;  // height of the lens's control point over the hinge's length

/// An ear with its own vertex numbers: the ends of the hinge, the rim, the interior.
struct PlacedEar {
    PlacedEar(const Vertices& positions, const Triangles& faces, const Ear& ear)
        : loop(ear.loop), rim(static_cast<Index>(ear.rim.size())), names{ear.first, ear.last}
    {
        names.insert(names.end(), ear.rim.begin(), ear.rim.end());
        names.insert(names.end(), ear.interior.begin(), ear.interior.end());
        std::vector<std::pair<Index, Index>> rank;
        for (std::size_t i = 0; i < names.size(); ++i) rank.emplace_back(names[i], static_cast<Index>(i));
        std::sort(rank.begin(), rank.end());
        triangles.resize(static_cast<Eigen::Index>(ear.faces.size()), 3);
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                triangles(f, k) =
                    std::lower_bound(rank.begin(), rank.end(), std::pair(faces(ear.faces[f], k), Index{0}))->second;
        vertices = positions(names, Eigen::all);
        image = VectorXcd::Zero(static_cast<Eigen::Index>(names.size()));
    }

    /// The vertices from the hinge's first end along the rim to its last end.
    std::vector<Index> chain() const
    {
        std::vector<Index> result{0};
        for (Index i = 0; i < rim; ++i) result.push_back(2 + i);
        result.push_back(1);
        return result;
    }

    /// Share of the chain's length up to each rim vertex.
    VectorXd shares() const
    {
        const auto steps = chain();
        VectorXd walked(rim);
        VectorXd edges(rim + 1);
        for (Index i = 0; i <= rim; ++i) edges[i] = (vertices.row(steps[i + 1]) - vertices.row(steps[i])).stableNorm();
        edges = edges.array().max(least_share * edges.mean());  // coinciding vertices need places of their own
        double sum = 0.0;
        for (Index i = 0; i < rim; ++i) walked[i] = (sum += edges[i]) / edges.sum();
        return walked;
    }

    bool upright() const
    {
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            if (!(cross(image[triangles(f, 1)] - image[triangles(f, 0)],
                        image[triangles(f, 2)] - image[triangles(f, 0)]) > 0.0))
                return false;
        return true;
    }

    /// Makes the inside harmonic, with the chain given. Where the surface's own weights flip a face, it takes weights
    /// of 1, which never flip in a convex outline (Tutte 1963).
    void fill()
    {
        if (static_cast<std::size_t>(rim) + 2 == names.size()) return;
        std::vector<char> fixed(names.size(), 0);
        std::fill(fixed.begin(), fixed.begin() + rim + 2, char{1});
        MatrixXd parts(image.size(), 2);
        for (const bool even : {false, true}) {
            parts << image.real(), image.imag();
            const EdgeLengths weights = even ? EdgeLengths::Constant(triangles.rows(), 3, 0.5).eval()
                                             : half_cotangents(edge_lengths(vertices, triangles)).cwiseMax(1e-3).eval();
            const SparseMatrix laplacian = cotan_laplacian(triangles, weights, static_cast<Index>(names.size()));
            parts = DirichletSolver(laplacian, fixed).solve(parts);
            image = parts.col(0) + Complex(0.0, 1.0) * parts.col(1);
            if (upright()) return;
        }
    }

    int loop;
    Index rim;                 // number of rim vertices
    std::vector<Index> names;  // the surface's vertex for each
    Triangles triangles;
    Vertices vertices;
    VectorXcd image;
    VectorXcd natural;  // the conformal flattening
    int level = 0;      // how often it has been flattened
};

void lay_on_rim(PlacedEar& ear)
{
    const double begin = std::arg(ear.image[0]);
    double sweep = std::arg(ear.image[1] / ear.image[0]);
    if (sweep <= 0.0) sweep += 2.0 * std::numbers::pi;
    ear.image.segment(2, ear.rim) = (Complex(0.0, 1.0) * (begin + sweep * ear.shares().array())).exp();
    ear.fill();
}

/// Draws the ear as flat as its level says.
void draw(PlacedEar& ear, Complex middle)
{
    const Complex a = ear.image[0], b = ear.image[1];
    if (ear.level < lens_level) {
        for (Eigen::Index v = 2; v < ear.image.size(); ++v) {
            const Complex local = (ear.natural[v] - a) / (b - a);
            ear.image[v] = a + (b - a) * Complex(local.real(), flatter[ear.level] * local.imag());
        }
        return;
    }
    const Complex foot = 0.5 * (a + b);
    const double reach = std::min(lens_reach, lens_aspect * std::abs(b - a) / std::abs(middle - foot));
    const Complex control = foot + reach * (middle - foot);
    const VectorXd shares = ear.shares();
    for (Index i = 0; i < ear.rim; ++i) {
        const double t = shares[i];
        ear.image[2 + i] = (1.0 - t) * (1.0 - t) * a + 2.0 * t * (1.0 - t) * control + t * t * b;
    }
    ear.fill();
}

/// Whether the ear lies inside the hole: the core loop's polygon, convex, clockwise as the surface is on its left.
bool inside_hole(const PlacedEar& ear, const VectorXcd& hole)
{
    for (Index i = 0; i < ear.rim; ++i)
        for (Eigen::Index e = 0; e < hole.size(); ++e) {
            const Complex from = hole[e], to = hole[(e + 1) % hole.size()];
            if (!(cross(to - from, ear.image[2 + i] - from) < 0.0)) return false;
        }
    return true;
}

bool chains_meet(const PlacedEar& a, const PlacedEar& b)
{
    const auto p = a.chain(), q = b.chain();
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        for (std::size_t j = 0; j + 1 < q.size(); ++j) {
            if (&a == &b && j <= i + 1) continue;
            const bool joined = a.names[p[i]] == b.names[q[j]] || a.names[p[i]] == b.names[q[j + 1]] ||
                                a.names[p[i + 1]] == b.names[q[j]] || a.names[p[i + 1]] == b.names[q[j + 1]];
            if (!joined && segments_meet(a.image[p[i]], a.image[p[i + 1]], b.image[q[j]], b.image[q[j + 1]]))
                return true;
        }
    return false;
}

/// Flattens ears until each is upright, inside the hole, and apart from the others.
void flatten_until_apart(std::vector<PlacedEar*>& ears, const VectorXcd& hole, const ExecutionContext& context)
{
    const Complex middle = hole.mean();
    // Begin with each ear's natural shape.
    for (PlacedEar* ear : ears) {
        ear->natural = flatten_freely(ear->vertices, ear->triangles, {0, 1}, {ear->image[0], ear->image[1]});
        draw(*ear, middle);
    }
    const auto flatten = [&](PlacedEar& ear) {
        if (ear.level == lens_level) return false;
        ++ear.level;
        draw(ear, middle);
        return true;
    };
    // Flatten where two ears meet, until nothing changes. Levels only rise, so this ends.
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < ears.size(); ++i) {
            context.checkpoint();
            while (!(ears[i]->upright() && inside_hole(*ears[i], hole) && !chains_meet(*ears[i], *ears[i])))
                if (!flatten(*ears[i])) break;
            for (std::size_t j = 0; j < i; ++j)
                while (chains_meet(*ears[i], *ears[j])) {
                    const bool first = flatten(*ears[i]), second = flatten(*ears[j]);
                    if (!first && !second) break;
                    changed = true;
                }
        }
    }
}

}  // namespace

std::vector<Index> lay_ears(const Vertices& vertices, const Triangles& triangles, const std::vector<Ear>& ears,
                            const std::vector<VertexLoop>& loops, PlanarPoints& uv, const ExecutionContext& context)
{
    std::vector<PlacedEar> placed;
    std::vector<char> cut(vertices.rows(), 0);
    for (const Ear& ear : ears) {
        PlacedEar& item = placed.emplace_back(vertices, triangles, ear);
        item.image[0] = {uv(ear.first, 0), uv(ear.first, 1)};
        item.image[1] = {uv(ear.last, 0), uv(ear.last, 1)};
        for (const Index v : ear.rim) cut[v] = 1;
    }
    // Ears of the outer loop lie along the unit circle: a disk is convex. The others lie inside their hole, whose
    // polygon the loop without its ears is.
    std::vector<Index> off_circle;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        std::vector<PlacedEar*> of_loop;
        for (PlacedEar& ear : placed)
            if (ear.loop == static_cast<int>(k)) of_loop.push_back(&ear);
        if (of_loop.empty()) continue;
        if (k == 0) {
            for (PlacedEar* ear : of_loop) lay_on_rim(*ear);
            continue;
        }
        VectorXcd hole(static_cast<Eigen::Index>(loops[k].size()));
        Eigen::Index corners = 0;
        for (const Index v : loops[k])
            if (!cut[v]) hole[corners++] = {uv(v, 0), uv(v, 1)};
        hole.conservativeResize(corners);
        flatten_until_apart(of_loop, hole, context);
        for (const PlacedEar* ear : of_loop)
            off_circle.insert(off_circle.end(), ear->names.begin() + 2, ear->names.begin() + 2 + ear->rim);
    }
    for (const PlacedEar& ear : placed)
        for (std::size_t i = 2; i < ear.names.size(); ++i)
            uv.row(ear.names[i]) << ear.image[i].real(), ear.image[i].imag();
    return off_circle;
}

}  // namespace koebe
