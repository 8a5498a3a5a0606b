#include "cut/seamed_mesh.h"

#include "cut/edge_runs.h"
#include "mesh/connected_pieces.h"

#include <algorithm>

namespace koebe {
namespace {

/// The next half-edge from the same fan, clockwise, or no_twin.
Index turn(const SeamedMesh& mesh, Index h) { return mesh.twin[previous_halfedge(h)]; }

Index turn_back(const SeamedMesh& mesh, Index h)
{
    return mesh.twin[h] == no_twin ? no_twin : next_halfedge(mesh.twin[h]);
}

}  // namespace

void SeamedMesh::cut(Index halfedge)
{
    if (twin[halfedge] == no_twin) return;
    twin[twin[halfedge]] = no_twin;
    twin[halfedge] = no_twin;
}

void number_fans(SeamedMesh& mesh)
{
    mesh.fans = Triangles::Constant(mesh.corners.rows(), 3, -1);
    mesh.fan_count = 0;
    Index* fan = mesh.fans.data();
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        if (fan[h] >= 0) continue;
        for (Index g = h; g != no_twin && fan[g] < 0; g = turn(mesh, g)) fan[g] = mesh.fan_count;
        for (Index g = turn_back(mesh, h); g != no_twin && fan[g] < 0; g = turn_back(mesh, g)) fan[g] = mesh.fan_count;
        ++mesh.fan_count;
    }
}

std::vector<Index> vertices_of_fans(const SeamedMesh& mesh)
{
    std::vector<Index> vertices(static_cast<std::size_t>(mesh.fan_count));
    for (Index h = 0; h < mesh.halfedge_count(); ++h) vertices[origin(mesh.fans, h)] = origin(mesh.corners, h);
    return vertices;
}

void join_idle_seams(SeamedMesh& mesh)
{
    for_each_edge(mesh.fans, mesh.fan_count, [&](std::span<const Index> run) {
        if (run.size() != 2 || mesh.twin[run[0]] != no_twin || mesh.twin[run[1]] != no_twin) return;
        if (origin(mesh.fans, run[0]) != target(mesh.fans, run[1])) return;
        mesh.join(run[0], run[1]);
    });
}

std::vector<SeamedMesh> connected_parts(const SeamedMesh& mesh)
{
    Index count = 0;
    const std::vector<Index> part = joined_pieces(mesh.twin, count, [](Index) { return true; });
    std::vector<Index> size(count, 0), place(part.size());
    for (std::size_t f = 0; f < part.size(); ++f) place[f] = size[part[f]]++;
    // Half-edges keep their places in their faces: 3 f + k becomes 3 place[f] + k.
    std::vector<SeamedMesh> parts(count);
    for (Index p = 0; p < count; ++p) {
        parts[p].corners.resize(size[p], 3);
        parts[p].face.reserve(size[p]);
        parts[p].turned.reserve(size[p]);
        parts[p].twin.reserve(3 * static_cast<std::size_t>(size[p]));
        parts[p].whole.reserve(3 * static_cast<std::size_t>(size[p]));
        parts[p].length.reserve(3 * static_cast<std::size_t>(size[p]));
    }
    for (std::size_t f = 0; f < part.size(); ++f) {
        SeamedMesh& own = parts[part[f]];
        own.corners.row(place[f]) = mesh.corners.row(static_cast<Eigen::Index>(f));
        own.face.push_back(mesh.face[f]);
        own.turned.push_back(mesh.turned[f]);
        for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
            const Index twin = mesh.twin[h];
            own.twin.push_back(twin == no_twin ? no_twin : 3 * place[face_of(twin)] + twin % 3);
            own.whole.push_back(mesh.whole[h]);
            own.length.push_back(mesh.length[h]);
        }
    }
    for (SeamedMesh& own : parts) number_fans(own);
    return parts;
}

std::vector<std::vector<Index>> boundary_halfedges(const SeamedMesh& mesh)
{
    std::vector<char> met(mesh.twin.size(), 0);
    std::vector<std::vector<Index>> loops;
    for (Index start = 0; start < mesh.halfedge_count(); ++start) {
        if (mesh.twin[start] != no_twin || met[start]) continue;
        std::vector<Index> loop;
        for (Index h = start; !met[h];) {
            met[h] = 1;
            loop.push_back(h);
            h = next_halfedge(h);
            while (mesh.twin[h] != no_twin) h = next_halfedge(mesh.twin[h]);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

int genus_of(const SeamedMesh& mesh, std::size_t loops)
{
    const auto open = std::count(mesh.twin.begin(), mesh.twin.end(), no_twin);
    const auto faces = static_cast<std::ptrdiff_t>(mesh.face.size());
    const auto euler = mesh.fan_count - (3 * faces + open) / 2 + faces;
    return static_cast<int>((2 - euler - static_cast<std::ptrdiff_t>(loops)) / 2);
}

}  // namespace koebe
