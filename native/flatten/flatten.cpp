#include "flatten/flatten.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/errors.h"
#include "cut/edge_runs.h"
#include "execution/memory_limit.h"
#include "execution/peak_memory.h"
#include "execution/side_by_side.h"
#include "flatten/allowance.h"
#include "flatten/labels.h"
#include "flatten/seams.h"
#include "flatten/sheets.h"
#include "linear/dense_spd.h"
#include "parts/layout.h"
#include "planar/boundary_crossings.h"
#include "quality/angle_error.h"
#include "quality/shared_warnings.h"
#include "relax/even_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double least_piece = 0.1, most_piece = 1e6;  // mm across
constexpr double most_lost = 0.01;                     // of the area, in smaller pieces

constexpr double fewest_cuts = 50.0;    // a price at which nothing is cut but what has to be
constexpr double few_bends = 0.02;      // share of vertices
constexpr Index some_bends = 16;        // vertices
constexpr double straight = 1e-4;       // radians
constexpr int most_rounds = 12;         // of further relaxation,
constexpr double worth_a_round = 0.97;  // of the stretch
constexpr double negligible = 1e-9;     // stretch
constexpr double true_to_size = 1e-3;   // stretch in the mean

std::string in_millimetres(double length)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", length);
    return text;
}

double extent_of(const FlatPart& part)
{
    return (part.points.colwise().maxCoeff() - part.points.colwise().minCoeff()).maxCoeff();
}

double image_area(const PlanarPoints& p, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector2d a = p.row(triangles(f, 1)) - p.row(triangles(f, 0));
    const Eigen::RowVector2d b = p.row(triangles(f, 2)) - p.row(triangles(f, 0));
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

bool is_one_to_one(const FlatPart& part, const PlanarPoints& at)
{
    if (!at.allFinite()) return false;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
        if (!(image_area(at, part.surface.triangles, f) > 0.0)) return false;
    return crossing_boundary_edges(part.surface.loops, at, 0.0).empty() &&
           turned_loops(part.surface.loops, at, 0.0).empty();
}

[[noreturn]] void throw_overlapping(const FlatPart& part)
{
    throw SolverError("a piece of " + counted(part.faces.size(), "face") + " overlaps itself when it is laid flat",
                      ElementKind::faces, part.faces);
}

/// Repairs a part that is not one to one as parts are repaired, in a unit square of its own.
void require_one_to_one(FlatPart& part, ExecutionContext& context)
{
    if (is_one_to_one(part, part.points)) return;
    const Eigen::RowVector2d low = part.points.colwise().minCoeff();
    const double extent = extent_of(part);
    PlanarPoints uv = (part.points.rowwise() - low) / extent;
    if (!uv.allFinite()) throw_overlapping(part);
    repair_flips(part, uv, context);
    embed_safely(part, uv, context);
    if (!is_one_to_one(part, uv)) throw_overlapping(part);
    double image = 0.0;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f) image += image_area(uv, part.surface.triangles, f);
    part.points = uv * std::sqrt(face_areas(part.vertices, part.surface.triangles).sum() / image);
}

/// Takes pieces away that nobody can cut out. @param unit mm @return their faces, rising
std::vector<Index> leave_out_crumbs(std::vector<FlatPart>& parts, double unit)
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
std::vector<FlatPiece> pieces_of_parts(const std::vector<FlatPart>& parts, double unit, double allowance, int threads,
                                       ExecutionContext& context)
{
    std::vector<FlatPiece> pieces(parts.size());
    side_by_side(parts.size(), threads, context, [&](std::size_t k, ExecutionContext&) {
        FlatPiece& piece = pieces[k];
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

class StretchSum {
public:
    void add(double area, double stretch)
    {
        area_ += area;
        sum_ += area * stretch;
        most_ = std::max(most_, stretch);
    }
    Stretch result() const { return {area_ > 0.0 ? 100.0 * sum_ / area_ : 0.0, 100.0 * most_}; }

private:
    double area_ = 0.0, sum_ = 0.0, most_ = 0.0;
};

FlatTriangle laid_flat(const Vertices& vertices, const Eigen::RowVector3i& face)
{
    const Eigen::RowVector3d a = vertices.row(face[1]) - vertices.row(face[0]);
    const Eigen::RowVector3d b = vertices.row(face[2]) - vertices.row(face[0]);
    const double length = a.norm();
    return {length, a.dot(b) / length, a.cross(b).norm() / length};
}

/// How much the lengths of a face differ from those on the surface at most. @param corners three rows
double stretch_of(const FlatTriangle& flat, const Eigen::Matrix<double, 3, 2>& corners)
{
    const Eigen::RowVector2d a = (corners.row(1) - corners.row(0)) / flat.p1x;
    const Eigen::RowVector2d b = (corners.row(2) - corners.row(0) - flat.p2x * a) / flat.p2y;
    const double same = std::hypot(a[0] + b[1], a[1] - b[0]), mirrored = std::hypot(a[0] - b[1], a[1] + b[0]);
    return std::max(0.5 * (same + mirrored) - 1.0, 1.0 - 0.5 * (same - mirrored));
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
    PatternPiece piece{part.kind, part.faces};
    const Eigen::RowVector2d size = at.colwise().maxCoeff() - at.colwise().minCoeff();
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
                                 const std::vector<Index>& crumbs)
{
    std::vector<Warning> warnings;
    if (!without_area.empty()) {
        std::vector<Index> faces;
        for (const LeftOutFace& face : without_area) faces.push_back(face.face);
        warnings.push_back({WarningKind::collapsed_faces,
                            counted(faces.size(), "face") + " of no area or like another, in no piece", faces});
    }
    if (!crumbs.empty())
        warnings.push_back({WarningKind::left_out,
                            counted(crumbs.size(), "face") + " left out, in pieces under a tenth of a millimetre",
                            crumbs});
    warn_reoriented(layout.reoriented, warnings);
    if (!layout.not_even.empty()) warn_not_even(layout.not_even, warnings);
    return warnings;
}

/// Whether all but few inner vertices lie flat, as on cones, rolled sheets and boxes.
bool is_bent_at_few_vertices(const Vertices& vertices, const Triangles& triangles)
{
    VectorXd angle = VectorXd::Zero(vertices.rows());
    std::vector<char> inner(static_cast<std::size_t>(vertices.rows()), 1);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto place = [&](int c) -> Eigen::RowVector3d { return vertices.row(triangles(f, (k + c) % 3)); };
            const Eigen::RowVector3d a = place(1) - place(0), b = place(2) - place(0);
            angle[triangles(f, k)] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    for_each_edge(triangles, static_cast<Index>(vertices.rows()), [&](std::span<const Index> halfedges) {
        if (halfedges.size() != 1) return;
        inner[origin(triangles, halfedges[0])] = inner[target(triangles, halfedges[0])] = 0;
    });
    Index bends = 0;
    for (Eigen::Index v = 0; v < angle.size(); ++v)
        bends += inner[v] && angle[v] > 0.0 && !(std::abs(angle[v] - 2.0 * std::numbers::pi) < straight);
    return bends <= some_bends + few_bends * static_cast<double>(vertices.rows());
}

void add_stretch(const FlatPart& part, StretchSum& sum)
{
    const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
        const FlatTriangle flat = laid_flat(part.vertices, part.surface.triangles.row(f));
        Eigen::Matrix<double, 3, 2> corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = part.points.row(part.surface.triangles(f, k));
        if (flat.has_angles()) sum.add(areas[f], stretch_of(flat, corners));
    }
}

double mean_stretch(const FlatPart& part)
{
    StretchSum sum;
    add_stretch(part, sum);
    return 0.01 * sum.result().mean;
}

double mean_stretch(const std::vector<FlatPart>& parts)
{
    StretchSum sum;
    for (const FlatPart& part : parts) add_stretch(part, sum);
    return 0.01 * sum.result().mean;
}

/// The parts relaxed further, as long as that brings something. Where loops were in each other's way, they may be apart
/// by now.
void relax_further(std::vector<FlatPart>& parts, int threads, ExecutionContext& context)
{
    side_by_side(parts.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
        FlatPart& part = parts[k];
        std::vector<RoundLoop> none;
        double before = mean_stretch(part);
        for (int round = 0; round < most_rounds && before > negligible; ++round) {
            make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, none}, 1.0, packed_side,
                      own);
            const double now = mean_stretch(part);
            if (!(now < worth_a_round * before)) return;
            before = now;
        }
    });
}

FlatMesh cut_and_flat(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      ExecutionContext& context)
{
    PartsOptions cutting;
    cutting.darts = options.darts;
    cutting.polygon = options.polygon;
    cutting.threads = options.threads;
    cutting.even = 1.0;
    cutting.loops = LoopForm::free;
    const bool is_mesh = vertices.rows() > 0 && triangles.rows() > 0 && vertices.allFinite() &&
                         triangles.minCoeff() >= 0 && triangles.maxCoeff() < vertices.rows();
    if (!options.price && is_mesh && is_bent_at_few_vertices(vertices, triangles)) {
        PartsOptions uncut = cutting;
        uncut.price = fewest_cuts;
        FlatMesh mesh = flat_mesh(vertices, triangles, uncut, context);
        relax_further(mesh.parts, options.threads, context);
        if (mean_stretch(mesh.parts) < true_to_size) return mesh;
    }
    if (options.price) cutting.price = *options.price;
    FlatMesh mesh = flat_mesh(vertices, triangles, cutting, context);
    relax_further(mesh.parts, options.threads, context);
    return mesh;
}

FlattenResult compute(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      const Page& page, const std::function<double()>& length_of_unit, ExecutionContext& context)
{
    require_memory_for_faces(triangles.rows());
    fix_product_blocks();
    FlatMesh mesh = cut_and_flat(vertices, triangles, options, context);
    const double unit = millimetres(options.units) * length_of_unit();
    std::vector<FlatPart>& parts = mesh.parts;
    const std::vector<Index> crumbs = leave_out_crumbs(parts, unit);
    context.begin_stage("pack", 0.9, 1.0);
    side_by_side(parts.size(), options.threads, context,
                 [&](std::size_t k, ExecutionContext& own) { require_one_to_one(parts[k], own); });
    const std::vector<FlatPiece> pieces = pieces_of_parts(parts, unit, options.allowance, options.threads, context);
    PlacedPieces placed = place_pieces(pieces, options.allowance, page);
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (!is_one_to_one(parts[k], placed.points[k])) throw_overlapping(parts[k]);
    const std::vector<Seam> seams = find_seams(parts, mesh.layout.vertices);
    mark_seams(seams, parts, placed);
    number_pieces(parts, placed);

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
    const std::vector<LeftOutFace> left_out = mesh.left_out;
    PartsLayout layout = laid_out(std::move(mesh), placed.points);
    measure_stretch(layout, unit, result);
    std::vector<Index> mapped;
    for (std::size_t f = 0; f < layout.part.size(); ++f)
        if (layout.part[f] >= 0) mapped.push_back(static_cast<Index>(f));
    const ComputedDistortion distortion = distortion_of(layout, layout.uv / layout.uv.maxCoeff(), mapped);
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    result.distortion = {distortion, {areas(crumbs).sum(), distortion.angle_error_deg, {}, {}}};
    result.uv = uv_of_input(layout, triangles);
    result.turned = layout.reoriented;
    result.even = layout.even;
    result.converged = true;
    result.warnings = warnings_of(layout, left_out, crumbs);
    result.part = std::move(layout.part);
    result.pattern = std::move(placed.pattern);
    result.peak_memory_mb = peak_memory_mb();
    return result;
}

}  // namespace

FlattenResult flatten(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                      ExecutionContext& context)
{
    const std::optional<Page> page = page_named(options.page);
    if (!page) throw InputError("page " + page_help(options.page));
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
