#include "pipeline/cut_sheet.h"

#include "quality/stored_uv.h"

#include <algorithm>
#include <cmath>

namespace koebe {

Sheet::Sheet(const std::vector<SurfacePiece>& pieces) : pieces_(pieces)
{
    Eigen::Index vertices = 0, faces = 0;
    for (const SurfacePiece& piece : pieces) {
        first_vertex_.push_back(vertices);
        vertices += piece.vertices.rows();
        faces += piece.triangles.rows();
    }
    vertices_.resize(vertices, 3);
    triangles_.resize(faces, 3);
    points_.resize(vertices, 2);
    Eigen::Index at = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Triangles& own = pieces[i].triangles;
        vertices_.middleRows(first_vertex_[i], pieces[i].vertices.rows()) = pieces[i].vertices;
        triangles_.middleRows(at, own.rows()) = own.array() + static_cast<Index>(first_vertex_[i]);
        at += own.rows();
        faces_.insert(faces_.end(), pieces[i].source_face.begin(), pieces[i].source_face.end());
        piece_.insert(piece_.end(), static_cast<std::size_t>(own.rows()), i);
    }
}

void Sheet::place(const std::vector<MappedPiece>& mapped, const std::vector<Circle>& places)
{
    for (std::size_t i = 0; i < mapped.size(); ++i) {
        auto points = points_.middleRows(first_vertex_[i], pieces_[i].vertices.rows());
        points = places[i].radius * mapped[i].map.uv;
        points.rowwise() += Eigen::RowVector2d(places[i].center.real(), places[i].center.imag());
    }
}

bool Sheet::enlarge_flipped(std::vector<double>& radii) const
{
    std::vector<char> flipped(pieces_.size(), 0);
    for (const Index f : flipped_faces(triangles_, points_))
        if (!StoredFace(triangles_, points_, f).below_resolution()) flipped[piece_[f]] = 1;
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (flipped[i]) radii[i] *= 2.0;
    return std::ranges::find(flipped, 1) != flipped.end();
}

Distortion Sheet::distortion() const
{
    Distortion distortion = measure_distortion(vertices_, triangles_, points_);
    for (auto* list : {&distortion.flipped, &distortion.below_resolution}) {
        for (Index& f : *list) f = faces_[f];
        std::ranges::sort(*list);
    }
    return distortion;
}

PlanarPoints Sheet::corners(Index face_count) const
{
    PlanarPoints uv = PlanarPoints::Constant(3 * static_cast<Eigen::Index>(face_count), 2, std::nan(""));
    for (std::size_t i = 0, f = 0; i < pieces_.size(); ++i)
        for (std::size_t own = 0; own < pieces_[i].source_face.size(); ++own, ++f)
            for (Eigen::Index k = 0; k < 3; ++k) {
                const Eigen::Index corner = pieces_[i].turned[own] && k > 0 ? 3 - k : k;
                const Index v = triangles_(static_cast<Eigen::Index>(f), k);
                uv.row(3 * static_cast<Eigen::Index>(faces_[f]) + corner) =
                    (0.5 * (1.0 + points_.row(v).array())).max(0.0).min(1.0);
            }
    return uv;
}

}  // namespace koebe
