#include "mesh/connected_pieces.h"

#include "core/connectivity.h"

namespace koebe {

std::vector<Index> connected_pieces(const std::vector<Index>& twin, const std::vector<int>& label, Index& count)
{
    std::vector<Index> piece(label.size(), -1), queue;
    count = 0;
    for (Index seed = 0; seed < static_cast<Index>(label.size()); ++seed) {
        if (piece[seed] >= 0) continue;
        queue.assign(1, seed);
        piece[seed] = count;
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = twin[h];
                if (t == no_twin) continue;
                const Index g = face_of(t);
                if (piece[g] >= 0 || label[g] != label[seed]) continue;
                piece[g] = count;
                queue.push_back(g);
            }
        ++count;
    }
    return piece;
}

}  // namespace koebe
