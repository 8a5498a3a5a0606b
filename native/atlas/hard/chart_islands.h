// The charts of a surface, joined to islands that lie flat.
#pragma once

#include "execution/execution.h"
#include "hard/laid_part.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe {

/// At first each chart is an island.
class ChartIslands {
public:
    ChartIslands(const CutSurface& surface, FlatCharts charts);

    /// Cuts thin charts that are too long across, between planar regions. Before charts are joined.
    void cut_strips();
    /// Small pieces of the rest, such as the corner between three fillets, go with the island with which they have the
    /// longest border. Their map bends, the island does not move.
    void attach_rest(ExecutionContext& context);

protected:
    Index halfedges() const { return charts_.net.halfedge_count(); }
    Index twin(Index h) const { return surface_.surface.twin[h]; }
    Index island_of(Index h) const { return island_[chart_[face_of(h)]]; }
    bool same(Complex a, Complex b) const { return std::abs(a - b) < charts_.near; }
    std::optional<FlatPart> part_of(const std::vector<Index>& faces) const
    {
        return laid_part(surface_, charts_, faces);
    }
    /// The longer side of the box round laid faces, along most of their border up to quarter turns.
    double extent(const std::vector<Index>& faces, Complex* along = nullptr) const;

    const CutSurface& surface_;
    FlatCharts charts_;                        // twins over creases where charts are joined
    std::vector<std::vector<Index>> islands_;  // faces of joined charts, ascending; empty: joined to another island
    std::vector<FlatPart> parts_;              // (islands)
    std::vector<Index> island_;                // (charts)
    std::vector<Index> chart_;                 // (F) -1: of the rest

private:
    void cut_strip(std::size_t chart, const Complex& along, int count);
    std::vector<Index> longest_border(const SeamedMesh& piece) const;
    bool attach(const SeamedMesh& piece);
};

}  // namespace koebe
