// From proxies to the fine surface, and back to E = 0 where angles became worse.
#pragma once

#include "execution/execution.h"
#include "parts/even_parts.h"
#include "parts/mesh_piece.h"

#include <cstddef>
#include <vector>

namespace koebe {

/// Makes parts that were decided on proxies of the fine surface. Holds what they are at E = 0 beside them.
class FineParts {
public:
    FineParts(std::vector<MeshPiece>& pieces, const PartsOptions& options, ExecutionContext& context)
        : pieces_(pieces), options_(options), context_(context)
    {
    }

    /// Makes the proxy's parts of the fine surface, each mapped by itself, without darts. If they have no place there,
    /// the parts of the fine surface are decided on itself.
    void lay(MeshPiece& own) const;

    /// Carries the parts of all pieces with their darts, and notes what they are at E = 0.
    /// @param before (pieces) the parts without darts
    void carry(std::vector<std::vector<FlatPart>> before);

    /// The angles of all groups at E = 0; no bounds, if E is given.
    AngleBounds angle_bounds();

    /// Takes the faces away that fill pinholes.
    void open_pinholes();

    /// Whether conformal parts can take the place of these groups: not where parts were joined on a proxy.
    bool can_go_back(const std::vector<std::size_t>& groups) const;

    /// Puts conformal parts in the place of groups. @param groups numbers as in angle_bounds
    /// @return faces of the input that are in these parts
    std::vector<Index> go_back(const std::vector<std::size_t>& groups);

private:
    void carry(MeshPiece& own, std::vector<FlatPart> before);
    void make_exact(MeshPiece& own) const;
    std::vector<FlatPart> laid(const MeshPiece& own, const std::vector<std::vector<Index>>& faces,
                               MapPurpose purpose = MapPurpose::result) const;

    std::vector<MeshPiece>& pieces_;
    const PartsOptions& options_;
    ExecutionContext& context_;
};

}  // namespace koebe
