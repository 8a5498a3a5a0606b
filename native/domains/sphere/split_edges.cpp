#include "sphere/split_edges.h"

#include "core/connectivity.h"
#include "execution/each_in_pieces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace koebe {

bool split_edges(Polyhedron& mesh, const std::function<bool(Index, Index)>& too_long)
{
    const auto is_long = [&](Index h) { return too_long(origin(mesh.triangles, h), target(mesh.triangles, h)); };
    if (found_in_pieces(static_cast<Index>(mesh.triangles.size()), is_long).empty()) return false;
    std::map<std::pair<Index, Index>, Index> middle;
    std::vector<Eigen::RowVector3d> added;
    std::vector<std::array<Index, 3>> faces;
    const Index first = static_cast<Index>(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        std::array<Index, 3> v{}, half{};
        for (int k = 0; k < 3; ++k) {
            const Index a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
            v[static_cast<std::size_t>(k)] = a;
            half[static_cast<std::size_t>(k)] = -1;
            if (!too_long(a, b)) continue;
            const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), first + static_cast<Index>(added.size()));
            if (is_new) added.emplace_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
            half[static_cast<std::size_t>(k)] = at->second;
        }
        const auto count = std::ranges::count_if(half, [](Index h) { return h >= 0; });
        // Turn the face so that the first edge is split, or the first and the second.
        std::size_t turn = 0;
        while (count > 0 && !(half[turn] >= 0 && (count == 1 || half[(turn + 1) % 3] >= 0))) ++turn;
        std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(turn), v.end());
        std::rotate(half.begin(), half.begin() + static_cast<std::ptrdiff_t>(turn), half.end());
        if (count == 0) {
            faces.push_back(v);
        } else if (count == 1) {
            faces.push_back({v[0], half[0], v[2]});
            faces.push_back({half[0], v[1], v[2]});
        } else if (count == 2) {
            faces.push_back({half[0], v[1], half[1]});
            faces.push_back({v[0], half[0], half[1]});
            faces.push_back({v[0], half[1], v[2]});
        } else {
            faces.push_back({v[0], half[0], half[2]});
            faces.push_back({half[0], v[1], half[1]});
            faces.push_back({half[2], half[1], v[2]});
            faces.push_back({half[0], half[1], half[2]});
        }
    }
    mesh.vertices.conservativeResize(first + static_cast<Eigen::Index>(added.size()), 3);
    for (std::size_t i = 0; i < added.size(); ++i) mesh.vertices.row(first + static_cast<Index>(i)) = added[i];
    mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            mesh.triangles(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = faces[f][k];
    return true;
}

}  // namespace koebe
