// Connected components of a surface.
#pragma once

#include "core/connectivity.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// The pieces of faces that edges join. @param twin pair_halfedges's @param joins whether a half-edge with a twin does:
/// the same from both sides @return the piece of each face, from 0 in the order of their first faces
template <class Joins>
std::vector<Index> joined_pieces(const std::vector<Index>& twin, Index& count, Joins joins)
{
    std::vector<Index> piece(twin.size() / 3, -1), queue;
    count = 0;
    for (Index seed = 0; seed < static_cast<Index>(piece.size()); ++seed) {
        if (piece[seed] >= 0) continue;
        queue.assign(1, seed);
        piece[seed] = count;
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = twin[h];
                if (t == no_twin || piece[face_of(t)] >= 0 || !joins(h)) continue;
                piece[face_of(t)] = count;
                queue.push_back(face_of(t));
            }
        ++count;
    }
    return piece;
}

/// The pieces of faces of equal labels. @param label (F)
inline std::vector<Index> connected_pieces(const std::vector<Index>& twin, const std::vector<int>& label, Index& count)
{
    return joined_pieces(twin, count, [&](Index h) { return label[face_of(h)] == label[face_of(twin[h])]; });
}

}  // namespace koebe
