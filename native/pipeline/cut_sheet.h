// All pieces of a cut surface as one mesh, to judge them where they lie.
#pragma once

#include "circles/circle.h"
#include "pipeline/cut_uniformize.h"
#include "quality/distortion.h"

#include <vector>

namespace koebe {

class Sheet {
public:
    explicit Sheet(const std::vector<SurfacePiece>& pieces);

    /// Puts each piece's unit disk onto its circle in [-1, 1]^2.
    void place(const std::vector<MappedPiece>& mapped, const std::vector<Circle>& places);

    /// Doubles the radii of the pieces with flips above resolution. @return whether there are any
    bool enlarge_flipped(std::vector<double>& radii) const;

    /// Of all pieces as one; flipped and below_resolution by the input's faces.
    Distortion distortion() const;

    /// (3F, 2) u and v of the corners of the input's faces; NaN where a face is in no piece.
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
