#include "flatten/flatten.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/types.h"
#include "even/even_map.h"
#include "execution/execution.h"
#include "execution/memory_limit.h"
#include "execution/side_by_side.h"
#include "flat/flat_part.h"
#include "flat/flat_repair.h"
#include "flatten/allowance.h"
#include "flatten/notches.h"
#include "flatten/seams.h"
#include "flatten/sheets.h"
#include "flatten/stretch.h"
#include "flow/flat_layout.h"
#include "linear/dense_spd.h"
#include "parts/flat_mesh.h"
#include "planar/planar_predicates.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr int most_relaxations = 12;         // of further relaxation,
constexpr double worth_a_relaxation = 0.97;  // of the stretch
constexpr double negligible = 1e-9;          // stretch

PlanarPoints laid_face_by_face(const FlatPart& part)
{
    const Triangles& triangles = part.surface.triangles;
    const EdgeLengths lengths = edge_lengths(part.vertices, triangles);
    const VectorXcd z = positions_from_edges(triangles, lengths, unfolded_edges(triangles, lengths, part.surface.twin),
                                             part.surface.vertex_count);
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

/// Unfolds the part face by face, and takes the result if it is one to one and less stretched. Then relaxes it as long
/// as that helps.
void stretch_less(FlatPart& part, ExecutionContext& context)
{
    double before = mean_stretch(part);
    FlatPart other = part;
    try {
        other.points = laid_face_by_face(part);
    } catch (const SolverError&) {  // faces without area
        other.points.setZero();
    }
    if (lies_one_to_one(other, other.points))
        if (const double now = mean_stretch(other); now < before) {
            part = std::move(other);
            before = now;
        }
    std::vector<RoundLoop> none;
    for (int round = 0; round < most_relaxations && before > negligible; ++round) {
        make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, none}, 1.0, packed_side,
                  context);
        const double now = mean_stretch(part);
        if (!(now < worth_a_relaxation * before)) return;
        before = now;
    }
}

constexpr double price_true_to_size = 0.0037;          // of a piece: patterns may stretch less than UVs
constexpr double least_piece = 0.1, most_piece = 1e6;  // mm across
constexpr double most_lost = 0.01;                     // of the area, in smaller pieces

std::string in_millimetres(double length) { return formatted("%.3g mm", length); }

double extent_of(const FlatPart& part) { return box_size(part.points).maxCoeff(); }

[[noreturn]] void throw_overlapping(const FlatPart& part)
{
    throw SolverError("a piece of " + counted(part.faces.size(), "face") + " overlaps itself when it is laid flat",
                      ElementKind::faces, part.faces);
}

/// Repairs a part that is not one to one as parts are repaired, in a unit square of its own.
void require_one_to_one(FlatPart& part, ExecutionContext& context)
{
    if (lies_one_to_one(part, part.points)) return;
    const Eigen::RowVector2d low = part.points.colwise().minCoeff();
    const double extent = extent_of(part);
    PlanarPoints uv = (part.points.rowwise() - low) / extent;
    if (!uv.allFinite()) throw_overlapping(part);
    repair_flips(part, uv, context);
    embed_safely(part, uv, context);
    if (!lies_one_to_one(part, uv)) throw_overlapping(part);
    double image = 0.0;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
        image += signed_area(uv, part.surface.triangles, f);
    part.points = uv * std::sqrt(face_areas(part.vertices, part.surface.triangles).sum() / image);
}

/// Takes pieces away that nobody can cut out. @param unit mm @return their faces, rising
std::vector<Index> leave_out_tiny_pieces(std::vector<FlatPart>& parts, double unit)
{
    std::vector<Index> faces;
    double lost = 0.0, largest = 0.0;
    for (const FlatPart& part : parts) {
        const double extent = unit * extent_of(part);
        if (!(extent <= most_piece))
            throw InputError("a piece is " + in_millimetres(extent) + " long: the units are too large for the mesh",
                             ElementKind::faces, part.faces);
        largest = std::max(largest, extent);
        if (extent >= least_piece) continue;
        lost += face_areas(part.vertices, part.surface.triangles).sum();
        faces.insert(faces.end(), part.faces.begin(), part.faces.end());
    }
    std::ranges::sort(faces);
    if (lost > most_lost || largest < least_piece)
        throw InputError("pieces are too small to be cut out, the largest piece is " + in_millimetres(largest) +
                             " long: the units are too small for the mesh",
                         ElementKind::faces, faces);
    std::erase_if(parts, [&](const FlatPart& part) { return unit * extent_of(part) < least_piece; });
    return faces;
}

/// The pieces in mm, with their allowances.
std::vector<PieceShape> pieces_of_parts(const std::vector<FlatPart>& parts, double unit, double allowance, int threads,
                                        ExecutionContext& context)
{
    std::vector<PieceShape> pieces(parts.size());
    side_by_side(parts.size(), threads, context, [&](std::size_t k, ExecutionContext&) {
        PieceShape& piece = pieces[k];
        const Eigen::RowVector2d low = parts[k].points.colwise().minCoeff();
        piece.points = unit * (parts[k].points.rowwise() - low);
        piece.loops = parts[k].surface.loops;
        if (!(allowance > 0.0)) return;
        piece.allowance = allowance_rings(piece.loops, piece.points, allowance);
        if (piece.allowance.empty())
            throw SolverError("the allowance of a piece of " + counted(parts[k].faces.size(), "face") +
                                  " cannot be drawn",
                              ElementKind::faces, parts[k].faces);
    });
    return pieces;
}

/// @param unit mm
void measure_stretch(const PartsLayout& layout, double unit, FlattenResult& result)
{
    const Vertices vertices = unit * layout.vertices;
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    StretchSum all;
    for (PatternPiece& piece : result.pieces) {
        StretchSum own;
        for (const Index f : piece.faces) {
            const FlatTriangle flat = laid_flat(vertices, layout.triangles.row(f));
            if (!flat.has_angles()) continue;
            const double stretch = stretch_of(flat, layout.uv.middleRows<3>(3 * static_cast<Eigen::Index>(f)));
            own.add(areas[f], stretch);
            all.add(areas[f], stretch);
        }
        piece.stretch = own.result();
    }
    result.stretch = all.result();
}

double length_along(const std::vector<Index>& path, const auto& points)
{
    double length = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) length += (points.row(path[i]) - points.row(path[i - 1])).norm();
    return length;
}

PatternSeam report_seam(const Seam& seam, const std::vector<FlatPart>& parts, const std::vector<PlanarPoints>& at,
                        double unit)
{
    const SeamSide& first = seam.sides.front();
    PatternSeam report{unit * length_along(first.path, parts[first.part].vertices), seam.closed, {}, {}};
    for (const SeamSide& side : seam.sides) {
        report.pieces.push_back(static_cast<int>(side.part) + 1);
        report.lengths.push_back(length_along(side.path, at[side.part]));
    }
    return report;
}

PatternPiece report_piece(const FlatPart& part, const PlanarPoints& at, int sheet)
{
    PatternPiece piece{.kind = part.kind};
    const Eigen::RowVector2d size = box_size(at);
    piece.width = size[0];
    piece.height = size[1];
    for (VertexLoop loop : part.surface.loops) {
        loop.push_back(loop.front());
        piece.outline += length_along(loop, at);
    }
    piece.darts = static_cast<int>(part.tips.size());
    piece.sheet = sheet;
    return piece;
}

std::vector<Warning> warnings_of(const PartsLayout& layout, const std::vector<LeftOutFace>& without_area,
                                 const std::vector<Index>& tiny)
{
    std::vector<Warning> warnings;
    if (!without_area.empty()) {
        std::vector<Index> faces;
        for (const LeftOutFace& face : without_area) faces.push_back(face.face);
        warnings.push_back({WarningKind::collapsed_faces,
                            counted(faces.size(), "face") + " of no area or like another, in no piece", faces});
    }
    if (!tiny.empty())
        warnings.push_back({WarningKind::left_out,
                            counted(tiny.size(), "face") + " left out, in pieces under a tenth of a millimetre", tiny});
    warn_reoriented(layout.reoriented, warnings);
    if (!layout.not_even.empty()) warn_not_even(layout.not_even, warnings);
    return warnings;
}

FlatMesh cut_and_flat(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      ExecutionContext& context)
{
    PartsOptions cutting;
    cutting.darts = options.darts;
    cutting.polygon = options.polygon;
    cutting.threads = options.threads;
    cutting.even = 1.0;
    cutting.roomy = false;
    cutting.loops = LoopForm::free;
    cutting.price = options.price.value_or(price_true_to_size);
    FlatMesh mesh = flat_mesh(vertices, triangles, cutting, context);
    side_by_side(mesh.parts.size(), options.threads, context,
                 [&](std::size_t k, ExecutionContext& own) { stretch_less(mesh.parts[k], own); });
    return mesh;
}

FlattenResult compute(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      const Page& page, const std::function<double()>& length_of_unit, ExecutionContext& context)
{
    MapClock clock;
    require_memory_for_faces(triangles.rows());
    fix_product_blocks();
    // Cut, lay flat, and leave out pieces that nobody can cut out.
    FlatMesh mesh = cut_and_flat(vertices, triangles, options, context);
    const double unit = millimetres(options.units) * length_of_unit();
    std::vector<FlatPart>& parts = mesh.parts;
    std::vector<Index> tiny = leave_out_tiny_pieces(parts, unit);
    std::erase_if(tiny, [&](Index f) { return f >= static_cast<Index>(triangles.rows()); });
    clock.take(mesh.seconds);
    // Allowances around the pieces, places on the pages, and seams that both sides show.
    context.begin_stage("pack", 0.9, 1.0);
    side_by_side(parts.size(), options.threads, context,
                 [&](std::size_t k, ExecutionContext& own) { require_one_to_one(parts[k], own); });
    const std::vector<PieceShape> pieces = pieces_of_parts(parts, unit, options.allowance, options.threads, context);
    PlacedPieces placed = place_pieces(pieces, options.allowance, page);
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (!lies_one_to_one(parts[k], placed.points[k])) throw_overlapping(parts[k]);
    const std::vector<Seam> seams = find_seams(parts, mesh.layout.vertices);
    mark_seams(seams, parts, placed);
    number_pieces(parts, placed);

    // Report seams and pieces in mm.
    FlattenResult result;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    for (const Seam& seam : seams) {
        result.seams.push_back(report_seam(seam, parts, placed.points, unit));
        result.cut_length += result.seams.back().length;
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
        result.pieces.push_back(report_piece(parts[k], placed.points[k], placed.sheet[k]));
        result.darts += static_cast<Index>(parts[k].tips.size());
    }
    // UVs of the input's corners, and their distortion.
    const std::vector<LeftOutFace> left_out = mesh.left_out;
    PartsLayout layout = layout_at(std::move(mesh), placed.points);
    for (std::size_t k = 0; k < result.pieces.size(); ++k) result.pieces[k].faces = layout.parts[k].faces;
    measure_stretch(layout, unit, result);
    std::vector<Index> mapped;
    for (std::size_t f = 0; f < layout.part.size(); ++f)
        if (layout.part[f] >= 0) mapped.push_back(static_cast<Index>(f));
    const ComputedDistortion distortion = distortion_of_parts(layout, layout.uv / layout.uv.maxCoeff(), mapped);
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    result.distortion = {distortion, {areas(tiny).sum(), distortion.angle_error_deg, {}, {}}};
    result.uv = uv_of_input(layout, triangles);
    result.turned = layout.reoriented;
    result.even = layout.even;
    result.converged = true;
    result.warnings = warnings_of(layout, left_out, tiny);
    result.part = std::move(layout.part);
    result.pattern = std::move(placed.pattern);
    clock.finish(result, context);
    return result;
}

}  // namespace

FlattenResult flatten(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      ExecutionContext& context)
{
    const std::optional<Page> page = page_named(options.page);
    if (!page) throw InputError("the page of the pattern " + page_help(options.page));
    if (options.price && (!(*options.price > 0.0) || !std::isfinite(*options.price)))
        throw InputError("the price must be positive");
    if (!(options.darts >= 0.0 && options.darts <= 1.0)) throw InputError("darts must be from 0 to 1");
    if (!(options.allowance >= 0.0 && options.allowance <= 100.0))
        throw InputError("the allowance must be from 0 to 100 mm");
    const auto compute_here = [page = *page, vertices, triangles](const CanonicalMesh& mesh, const FlattenOptions& here,
                                                                  ExecutionContext& own) {
        const auto length_of_unit = [&] { return root_of_area(vertices, triangles); };
        return compute(mesh.vertices, mesh.triangles, here, page, length_of_unit, own);
    };
    const auto name = [](const CanonicalMesh& mesh, FlattenResult& result) {
        mesh.name_values(result.part);
        for (PatternPiece& piece : result.pieces) mesh.name_faces(piece.faces);
    };
    return corner_map<FlattenResult>(vertices, triangles, options, context, compute_here, name);
}

}  // namespace koebe
