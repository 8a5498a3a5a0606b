#include "pipeline/refinement.h"

#include "core/connectivity.h"

namespace koebe {

MapInput refined_input(const MapInput& input)
{
    const Surface& coarse = input.surface;
    const Index face_count = static_cast<Index>(coarse.triangles.rows());
    std::vector<Index> middle(3 * static_cast<std::size_t>(face_count), -1);  // the new vertex on each half-edge
    Index vertex_count = coarse.vertex_count;
    for (Index h = 0; h < 3 * face_count; ++h) {
        if (middle[h] >= 0) continue;
        middle[h] = vertex_count++;
        if (coarse.twin[h] != no_twin) middle[coarse.twin[h]] = middle[h];
    }

    MapInput fine;
    fine.outer_rank = input.outer_rank;
    fine.vertices.resize(vertex_count, 3);
    fine.vertices.topRows(coarse.vertex_count) = input.vertices;
    std::vector<Index> middle_after(coarse.vertex_count, -1);  // of the boundary edge that leaves a loop vertex
    for (Index h = 0; h < 3 * face_count; ++h) {
        const Index a = origin(coarse.triangles, h), b = target(coarse.triangles, h);
        fine.vertices.row(middle[h]) = 0.5 * (input.vertices.row(a) + input.vertices.row(b));
        if (coarse.twin[h] == no_twin) middle_after[a] = middle[h];
    }

    Surface& surface = fine.surface;
    surface.vertex_count = vertex_count;
    surface.euler_characteristic = coarse.euler_characteristic;
    surface.genus = coarse.genus;
    surface.triangles.resize(4 * face_count, 3);
    for (Index f = 0; f < face_count; ++f) {
        const Index* m = &middle[3 * static_cast<std::size_t>(f)];
        for (int k = 0; k < 3; ++k) surface.triangles.row(4 * f + k) << coarse.triangles(f, k), m[k], m[(k + 2) % 3];
        surface.triangles.row(4 * f + 3) << m[0], m[1], m[2];
    }
    surface.twin = pair_halfedges(surface.triangles, vertex_count);
    for (std::size_t k = 0; k < input.loops.size(); ++k) {
        VertexLoop& loop = fine.loops.emplace_back();
        VectorXd& edges = fine.edges.emplace_back(2 * input.edges[k].size());
        for (std::size_t i = 0; i < input.loops[k].size(); ++i) {
            loop.insert(loop.end(), {input.loops[k][i], middle_after[input.loops[k][i]]});
            edges[2 * i] = edges[2 * i + 1] = 0.5 * input.edges[k][i];
        }
    }
    surface.loops = fine.loops;
    return fine;
}

}  // namespace koebe
