// Straightens paths along the edges of a surface: of equally long paths, those with few turns.
#pragma once

#include "execution/execution.h"
#include "part_maps/part_mesh.h"

#include <memory>
#include <vector>

namespace koebe {

/// Half-edges one after the other, in faces on their left.
using Path = std::vector<Index>;

/// The chains of cut edges, from one fork, tip or place of the boundary to the next. A chain that closes begins at its
/// lowest vertex. @param is_cut (3F) 1 on one half-edge of a cut edge at least
std::vector<Path> chains_of(const Surface& surface, const std::vector<char>& is_cut);

/// Replaces paths, one after the other, by paths with the same ends, in a band beside them, that cost least:
///     sum over edges of length shown (1 + (distance / width)^2) + turn_cost sum over vertices of turn length / (pi/2)
/// A turn is the angle off straight on the surface; its length is the mean of both edges'. So a staircase costs more
/// than two straight runs. Paths meet only at their ends, where they keep their order, and spare polygons. A path stays
/// where another one ends on it. One that ends where it begins is straightened all round.
class PathStraightener {
public:
    explicit PathStraightener(const CutSurface& whole);
    ~PathStraightener();
    PathStraightener(PathStraightener&&) = delete;

    /// Notes a path that others must not touch.
    void add(const Path& path);
    /// @param path one that was added @return by how much it costs less; 0: it stays as it was
    double straighten(Path& path);
    /// Notes another path in place of one that was added.
    void replace(Path& path, Path by);

private:
    class Search;
    std::unique_ptr<Search> search_;
};

/// Straightens all of these paths.
void straighten(const CutSurface& whole, std::vector<Path>& paths, const ExecutionContext& context);

}  // namespace koebe
