// Paths of fine edges where coarse parts were cut.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"

#include <unordered_map>
#include <vector>

namespace koebe {

/// Half-edges one after the other, in faces on their left.
using Path = std::vector<Index>;

double halfedge_length(const FlatPart& part, Index halfedge);
double path_length(const FlatPart& part, const Path& path);

/// A coarse part, and the pieces into which it was cut.
class CutCoarsePart {
public:
    explicit CutCoarsePart(const FlatPart& uncut);
    void add(const FlatPart& piece);

    const FlatPart& uncut() const { return *uncut_; }
    const std::vector<const FlatPart*>& pieces() const { return pieces_; }

    /// A half-edge of a piece.
    struct Place {
        std::size_t piece = 0;
        Index halfedge = -1;
    };
    /// Where a half-edge of the uncut part is now.
    Place place_of(Index halfedge) const;
    /// Whether a half-edge of the uncut part is on the boundary now.
    bool is_open(Index halfedge) const;
    /// The uncut part's face with this number in the whole; -1: none.
    Index face_of_whole(Index face) const;

private:
    const FlatPart* uncut_;
    std::vector<const FlatPart*> pieces_;
    std::unordered_map<Index, Index> face_;  // by the face of the whole
    std::vector<Place> first_;               // (F) of each face's half-edges
};

/// A chain of coarse edges, from one fork, tip or place of the boundary to the next, and its path of fine edges.
struct CarriedPath {
    Path chain, path;
};

/// A short path of fine edges near each chain of coarse edges along which parts were cut. Paths do not meet, except at
/// their ends, do not touch the boundary between them, and spare polygons. The path of a mirror image is the image of
/// the path. A chain has no path if every path would be far longer.
/// @param vertex (parts, V) the fine vertex of each coarse vertex @return (parts) the paths
std::vector<std::vector<CarriedPath>> carried_paths(const std::vector<FlatPart>& fine,
                                                    const std::vector<CutCoarsePart>& coarse,
                                                    const std::vector<std::vector<Index>>& vertex,
                                                    const ExecutionContext& context);

}  // namespace koebe
