#include "flatten/unfold.h"

#include "core/errors.h"
#include "cut/edge_runs.h"
#include "even/even_map.h"
#include "flatten/stretch.h"
#include "flow/flat_layout.h"
#include "mesh/connectivity.h"
#include "parts/darts.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace koebe {
namespace {

constexpr double few_bends = 0.02;      // share of vertices
constexpr std::size_t some_bends = 16;  // vertices
constexpr double straight = 1e-4;       // radians
constexpr int most_dart_rounds = 100;   // in each some darts that share no vertex
constexpr int most_rounds = 12;         // of further relaxation,
constexpr double worth_a_round = 0.97;  // of the stretch
constexpr double negligible = 1e-9;     // stretch

std::vector<Index> bent_vertices(const Vertices& vertices, const Triangles& triangles)
{
    VectorXd angle = VectorXd::Zero(vertices.rows());
    std::vector<char> inner(static_cast<std::size_t>(vertices.rows()), 1);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto place = [&](int c) -> Eigen::RowVector3d { return vertices.row(triangles(f, (k + c) % 3)); };
            const Eigen::RowVector3d a = place(1) - place(0), b = place(2) - place(0);
            angle[triangles(f, k)] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    for_each_edge(triangles, static_cast<Index>(vertices.rows()), [&](std::span<const Index> halfedges) {
        if (halfedges.size() != 1) return;
        inner[origin(triangles, halfedges[0])] = inner[target(triangles, halfedges[0])] = 0;
    });
    std::vector<Index> bent;
    for (Index v = 0; v < static_cast<Index>(angle.size()); ++v)
        if (inner[v] && angle[v] > 0.0 && !(std::abs(angle[v] - 2.0 * std::numbers::pi) < straight)) bent.push_back(v);
    return bent;
}

PlanarPoints unfolded(const FlatPart& part)
{
    const Triangles& triangles = part.surface.triangles;
    const EdgeLengths lengths = edge_lengths(part.vertices, triangles);
    const VectorXcd z = positions_from_edges(triangles, lengths, unfolded_edges(triangles, lengths, part.surface.twin),
                                             part.surface.vertex_count);
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

}  // namespace

bool is_bent_at_few_vertices(const Vertices& vertices, const Triangles& triangles)
{
    const double most = few_bends * static_cast<double>(vertices.rows());
    return static_cast<double>(bent_vertices(vertices, triangles).size()) <= static_cast<double>(some_bends) + most;
}

void cut_to_bends(FlatPart& part)
{
    for (int round = 0; round < most_dart_rounds; ++round) {
        const std::vector<Dart> darts = shortest_darts(part, bent_vertices(part.vertices, part.surface.triangles));
        if (darts.empty() || !open_darts(part, darts)) return;
    }
}

void unfold(FlatPart& part, ExecutionContext& context)
{
    double before = mean_stretch(part);
    FlatPart other = part;
    try {
        other.points = unfolded(part);
    } catch (const SolverError&) {  // faces without area
        other.points.setZero();
    }
    if (lies_one_to_one(other, other.points))
        if (const double now = mean_stretch(other); now < before) {
            part = std::move(other);
            before = now;
        }
    std::vector<RoundLoop> none;
    for (int round = 0; round < most_rounds && before > negligible; ++round) {
        make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, none}, 1.0, packed_side,
                  context);
        const double now = mean_stretch(part);
        if (!(now < worth_a_round * before)) return;
        before = now;
    }
}

}  // namespace koebe
