#include "parts/layout.h"

#include "mesh/corner_order.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

/// Whether a face of both has its vertices in the same cyclic order.
bool is_turn_of(const Triangles& a, const Triangles& b, Index f)
{
    for (int c = 0; c < 3; ++c)
        if (a(f, 0) == b(f, c)) return a(f, 1) == b(f, (c + 1) % 3);
    return false;
}

/// Puts left-out faces where the face lies that they double.
void place_left_out(const std::vector<LeftOutFace>& left_out, PartsLayout& layout)
{
    for (const LeftOutFace& face : left_out) {
        if (face.like < 0) continue;
        for (int k = 0; k < 3; ++k) {
            const int corner = corner_with(layout.triangles, face.like, layout.triangles(face.face, k));
            layout.uv.row(3 * static_cast<Eigen::Index>(face.face) + k) =
                layout.uv.row(3 * static_cast<Eigen::Index>(face.like) + corner);
        }
    }
}

/// The layout of the undivided faces. All pieces of a face are in one part, and lie as the face does.
void join_pieces(const std::vector<Index>& face, const Triangles& undivided, PartsLayout& layout)
{
    const Index count = static_cast<Index>(undivided.rows());
    const Triangles pieces = layout.triangles;
    const PlanarPoints uv = layout.uv;
    const std::vector<Index> part = layout.part;
    layout.triangles.conservativeResize(count, 3);
    layout.uv.conservativeResize(3 * count, 2);
    layout.part.resize(static_cast<std::size_t>(count));
    for (std::size_t i = layout.part.size(); i < face.size(); ++i)
        if (part[i] >= 0) layout.triangles.row(face[i]) = undivided.row(face[i]);
    for (const Index f : layout.turned)
        if (f < count && layout.triangles.row(f) == undivided.row(f))
            std::swap(layout.triangles(f, 1), layout.triangles(f, 2));
    // Each corner is where a piece has it.
    for (std::size_t i = 0; i < face.size(); ++i)
        for (int k = 0; k < 3 && part[i] >= 0; ++k)
            for (int c = 0; c < 3; ++c)
                if (layout.triangles(face[i], k) == pieces(static_cast<Index>(i), c))
                    layout.uv.row(3 * face[i] + k) = uv.row(3 * static_cast<Eigen::Index>(i) + c);
    const auto is_piece = [&](Index f) { return f >= count; };
    for (std::vector<Index>* const faces : {&layout.reoriented, &layout.turned, &layout.crossing, &layout.not_even})
        std::erase_if(*faces, is_piece);
    for (PartReport& own : layout.parts) std::erase_if(own.faces, is_piece);
}

}  // namespace

void sum_cuts(FlatMesh& mesh)
{
    PartsLayout& layout = mesh.layout;
    layout.slit_length = layout.dart_length = 0.0;
    layout.darts = 0;
    for (const FlatPart& flat : mesh.parts) {
        layout.darts += static_cast<Index>(flat.tips.size());
        layout.dart_length += flat.dart_length;
        layout.slit_length += flat.slit;
    }
}

PartsLayout layout_at(FlatMesh mesh, const std::vector<PlanarPoints>& places, const std::vector<char>& mirrored)
{
    PartsLayout layout = std::move(mesh.layout);
    const Triangles triangles = layout.triangles;
    layout.uv = PlanarPoints::Zero(triangles.size(), 2);
    layout.part.assign(static_cast<std::size_t>(triangles.rows()), -1);
    for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
        FlatPart& flat = mesh.parts[k];
        layout.overlaps += !flat.one_to_one;
        // Corners in the order in which the part was mapped; backwards in a mirrored part.
        const bool is_mirrored = !mirrored.empty() && mirrored[k];
        for (std::size_t i = 0; i < flat.faces.size(); ++i) {
            const Index f = flat.faces[i];
            const auto row = flat.surface.triangles.row(static_cast<Eigen::Index>(i));
            layout.part[f] = static_cast<Index>(k);
            if (!flat.one_to_one) layout.crossing.push_back(f);
            for (int c = 0; c < 3; ++c) {
                const Index v = row[is_mirrored ? 2 - c : c];
                layout.triangles(f, c) = flat.original[v];
                layout.uv.row(3 * static_cast<Eigen::Index>(f) + c) = places[k].row(v);
            }
            const bool is_turned = !is_turn_of(layout.triangles, triangles, f);
            if (is_turned) layout.turned.push_back(f);
            if (is_turned != is_mirrored) layout.reoriented.push_back(f);
        }
        layout.parts.push_back(
            {flat.kind, std::move(flat.faces), std::move(flat.loops), off_round(flat, places[k]), 0.0});
    }
    std::ranges::sort(layout.reoriented);
    std::ranges::sort(layout.turned);
    std::ranges::sort(layout.crossing);
    place_left_out(mesh.left_out, layout);
    if (!mesh.divided.face.empty()) join_pieces(mesh.divided.face, mesh.undivided, layout);
    return layout;
}

PlanarPoints uv_of_input(const PartsLayout& layout, const Triangles& input)
{
    return in_corner_order(layout.uv, layout.triangles, input);
}

ComputedDistortion distortion_of_parts(const PartsLayout& layout, const PlanarPoints& uv,
                                       const std::vector<Index>& faces)
{
    PlanarPoints points(3 * static_cast<Eigen::Index>(faces.size()), 2);
    for (std::size_t i = 0; i < faces.size(); ++i)
        points.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
            2.0 * uv.middleRows<3>(3 * static_cast<Eigen::Index>(faces[i])).array() - 1.0;
    return measure_corner_distortion(layout.vertices, layout.triangles(faces, Eigen::all), points);
}

}  // namespace koebe
