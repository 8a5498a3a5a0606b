#include "opened/cut_sheet.h"

#include "core/numbering.h"
#include "foldover/convex_polygons.h"
#include "foldover/untangle.h"
#include "mesh/topology.h"
#include "quality/shared_warnings.h"
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

std::vector<std::size_t> Sheet::flipped_pieces() const
{
    std::vector<std::size_t> flipped;
    for (const Index f : flipped_faces(triangles_, points_))
        if (!StoredFace(triangles_, points_, f).below_resolution() && (flipped.empty() || flipped.back() != piece_[f]))
            flipped.push_back(piece_[f]);
    return flipped;
}

void Sheet::turn_back(std::size_t piece, const Circle& place, MappedPiece& mapped, const ExecutionContext& context)
{
    const SurfacePiece& own = pieces_[piece];
    const Surface surface = analyze_surface(own.triangles, static_cast<Index>(own.vertices.rows()));
    std::vector<VertexLoop> loops;
    std::vector<Circle> circles;
    std::vector<Index> off_circle, held;
    for (const LoopReport& loop : mapped.map.loops) {
        loops.push_back(loop.vertices);
        circles.push_back({place.center + place.radius * loop.circle.center, place.radius * loop.circle.radius});
        off_circle.insert(off_circle.end(), loop.off_circle.begin(), loop.off_circle.end());
    }
    std::ranges::sort(off_circle);
    for (const Index v : {mapped.map.center, mapped.map.point})
        if (v >= 0) held.push_back(v);
    auto rows = points_.middleRows(first_vertex_[piece], own.vertices.rows());
    PlanarPoints points = rows;
    // In units of the piece: only proportions of lengths count.
    const Vertices vertices = own.vertices / std::max(own.vertices.cwiseAbs().maxCoeff(), 1e-300);
    const UntangleReport report =
        untangle(vertices, surface, loops, circles, off_circle, points, context, {.held = held});
    rows = points;
    points.rowwise() -= Eigen::RowVector2d(place.center.real(), place.center.imag());
    mapped.map.uv = points / place.radius;
    for (LoopReport& loop : mapped.map.loops) {
        for (const Index v : report.freed)
            if (std::ranges::find(loop.vertices, v) != loop.vertices.end()) loop.off_circle.push_back(v);
        std::ranges::sort(loop.off_circle);
    }
    std::vector<Index> freed;
    for (const Index v : report.freed) freed.push_back(own.source_vertex[static_cast<std::size_t>(v)]);
    warn_off_circle(std::move(freed), mapped.map.warnings);
}

void Sheet::mend(const std::vector<Index>& polygon, std::vector<MappedPiece>& mapped, const std::vector<Circle>& places,
                 const ExecutionContext& context)
{
    if (polygon.empty()) return;
    const std::vector<Index> own = values_at(polygon, faces_);
    std::vector<Index> held;
    for (std::size_t i = 0; i < mapped.size(); ++i)
        for (const Index v : {mapped[i].map.center, mapped[i].map.point})
            if (v >= 0) held.push_back(static_cast<Index>(first_vertex_[i]) + v);
    const std::vector<Index> turned;
    if (!mend_disk_polygons({vertices_, triangles_, own, turned, held}, points_, context)) return;
    for (std::size_t i = 0; i < mapped.size(); ++i) {
        PlanarPoints points = points_.middleRows(first_vertex_[i], pieces_[i].vertices.rows());
        points.rowwise() -= Eigen::RowVector2d(places[i].center.real(), places[i].center.imag());
        mapped[i].map.uv = points / places[i].radius;
    }
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
