// All pieces of a cut surface as one mesh, to judge them in their final places.
#pragma once

#include "circles/circle.h"
#include "opened/cut_uniformize.h"
#include "quality/distortion.h"

#include <vector>

namespace koebe {

class Sheet {
public:
    explicit Sheet(const std::vector<SurfacePiece>& pieces);

    /// Puts each piece's unit disk onto its circle in [-1, 1]^2.
    void place(const std::vector<MappedPiece>& mapped, const std::vector<Circle>& places);

    /// Pieces with flips above resolution, ascending. They can differ from the flips in the piece's own unit disk,
    /// because a small disk is rounded differently.
    std::vector<std::size_t> flipped_pieces() const;

    /// Turns flipped faces of a piece back in place (untangle), and changes the UVs in the piece's own disk in the same
    /// way.
    /// @param mapped still in the piece's own numbers
    void turn_back(std::size_t piece, const Circle& place, MappedPiece& mapped, const ExecutionContext& context);

    /// Makes polygons convex that are convex on the surface (mend_polygons), and changes the UVs in the pieces' own
    /// disks in the same way. @param polygon (F) of the input's faces, or empty
    void mend(const std::vector<Index>& polygon, std::vector<MappedPiece>& mapped, const std::vector<Circle>& places,
              const ExecutionContext& context);

    /// The distortion of all pieces together.
    ComputedDistortion distortion() const { return measure_distortion(vertices_, triangles_, points_); }

    /// (3F, 2) u and v of the corners of the input's faces; NaN for faces in no piece.
    PlanarPoints corners(Index face_count) const;

private:
    const std::vector<SurfacePiece>& pieces_;
    std::vector<Eigen::Index> first_vertex_;
    Vertices vertices_;
    Triangles triangles_;
    PlanarPoints points_;
    std::vector<Index> faces_;
    std::vector<std::size_t> piece_;
};

}  // namespace koebe
