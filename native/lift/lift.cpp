#include "lift/lift.h"

#include "core/counted.h"
#include "core/enum_words.h"
#include "execution/detachable_run.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "io/extension.h"
#include "io/file_bytes.h"
#include "lift/flat_domain.h"
#include "lift/grey_image.h"
#include "lift/patterns.h"
#include "lift/placed_drawing.h"
#include "lift/raised.h"
#include "lift/relief.h"
#include "lift/solid.h"
#include "lift/svg_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double cells_across = 12.0;  // of the root of the area, if no size is given

struct KeptSheet {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;
    std::vector<Index> original, patch;
    std::vector<Index> face;  // the surface's face of each
};

bool in_pattern(const Overlay& overlay, Index face)
{
    return overlay.region[face] >= 0 && !overlay.outlines[overlay.region[face]].hole;
}

/// The faces to keep, and their vertices in their order.
KeptSheet kept_faces(const Overlay& overlay, const std::vector<char>& keep, Index original_count)
{
    const Index count = static_cast<Index>(overlay.vertices.rows());
    std::vector<Index> number(count, -1);
    KeptSheet sheet;
    std::vector<Index> corners;
    for (Index f = 0; f < static_cast<Index>(overlay.triangles.rows()); ++f) {
        if (!keep[f]) continue;
        for (int k = 0; k < 3; ++k) {
            number[overlay.triangles(f, k)] = 0;
            corners.push_back(overlay.triangles(f, k));
            sheet.uv.push_back(overlay.uv[3 * f + k]);
        }
        sheet.patch.push_back(in_pattern(overlay, f) ? 1 : 0);
        sheet.face.push_back(overlay.face[f]);
    }
    std::vector<Index> used;
    for (Index v = 0; v < count; ++v) {
        if (number[v] < 0) continue;
        number[v] = static_cast<Index>(used.size());
        used.push_back(v);
        sheet.original.push_back(v < original_count ? v : -1);
    }
    sheet.vertices = overlay.vertices(used, Eigen::all);
    sheet.normals = overlay.normals(used, Eigen::all);
    for (Index& v : corners) v = number[v];
    sheet.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return sheet;
}

/// Checks loops and Euler characteristic of the sheet against what the outlines must have made of them.
void require_foretold(const Surface& before, const KeptSheet& sheet, Index holes, LiftResult& result)
{
    const Surface after = analyze_surface(sheet.triangles, static_cast<Index>(sheet.vertices.rows()));
    result.loops_before = static_cast<int>(before.loops.size());
    result.loops_after = static_cast<int>(after.loops.size());
    result.euler_before = before.euler_characteristic;
    result.euler_after = after.euler_characteristic;
    if (result.loops_after != result.loops_before + holes || result.euler_after != result.euler_before - holes ||
        !after.reoriented.empty())
        throw SolverError("the pattern has made " + std::to_string(result.loops_after - result.loops_before) +
                          " holes in place of " + std::to_string(holes));
}

void warn_of_left_out(LiftResult& result)
{
    if (const LeftOut& left = result.left_out; left.all() > 0) {
        std::string reasons;
        const auto add = [&](Index number, const std::string& reason) {
            if (number > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(number) + " " + reason;
        };
        add(left.at_border, "at a hole, a rim or a cut");
        add(left.too_fine, "too small for 32-bit UVs");
        add(left.crossing, "that meet another");
        add(left.open, "that do not close");
        result.warnings.push_back(
            {WarningKind::left_out,
             counted(static_cast<std::size_t>(left.all()), "outline") + " of the pattern left out: " + reasons,
             left.faces});
    }
}

PatternOptions pattern_options(const FlatSheet& sheet, const LiftOptions& options)
{
    PatternOptions chosen;
    chosen.size = options.size.value_or(std::sqrt(sheet.area) / cells_across);
    chosen.bridge = options.bridge.value_or(0.2 * chosen.size);
    chosen.repeats = options.repeats;
    chosen.seed = static_cast<std::uint64_t>(options.seed);
    if (!(chosen.size > 0.0)) throw InputError("the surface has no area: no size for the pattern");
    return chosen;
}

/// The sheet with its outlines at a height, or as it is.
RaisedSheet raised_sheet(const KeptSheet& sheet, const std::optional<double>& height)
{
    std::vector<Index> up = sheet.patch;
    if (!height) std::ranges::fill(up, 0);
    return raise_faces(sheet.triangles, sheet.uv, up, static_cast<Index>(sheet.vertices.rows()), height.value_or(0.0));
}

/// Faces that are no walls: they keep their direction when they move.
Triangles without_walls(const RaisedSheet& raised)
{
    const auto walls = std::ranges::count(raised.patch, 2);
    return raised.triangles.topRows(raised.triangles.rows() - static_cast<Eigen::Index>(walls));
}

/// As moved_along, with the surface's faces in the error.
Vertices moved_sheet(const Vertices& vertices, const Vertices& normals, const VectorXd& by, const Triangles& triangles,
                     const std::vector<Index>& face)
{
    try {
        return moved_along(vertices, normals, by, triangles);
    } catch (const InputError& error) {
        std::vector<Index> faces;
        for (const Index f : error.elements()) faces.push_back(face[f]);
        std::ranges::sort(faces);
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        throw InputError(error.what(), ElementKind::faces, std::move(faces));
    }
}

void finish_sheet(const KeptSheet& sheet, RaisedSheet raised, const LiftOptions& options, LiftResult& result)
{
    result.vertices = sheet.vertices(raised.source, Eigen::all);
    result.original.assign(raised.source.size(), -1);
    for (std::size_t v = 0; v < raised.source.size(); ++v)
        if (raised.height[static_cast<Eigen::Index>(v)] == 0.0) result.original[v] = sheet.original[raised.source[v]];
    if (options.height)
        result.vertices = moved_sheet(result.vertices, sheet.normals(raised.source, Eigen::all), raised.height,
                                      without_walls(raised), sheet.face);
    result.triangles = std::move(raised.triangles);
    result.uv.resize(static_cast<Eigen::Index>(raised.uv.size()), 2);
    for (std::size_t c = 0; c < raised.uv.size(); ++c)
        result.uv.row(static_cast<Eigen::Index>(c)) << raised.uv[c].real(), raised.uv[c].imag();
    result.patch = std::move(raised.patch);
}

void finish_solid(const KeptSheet& sheet, const RaisedSheet& raised, const LiftOptions& options, LiftResult& result)
{
    const double half = 0.5 * *options.thickness;
    if (options.height.value_or(0.0) <= -2.0 * half)
        throw InputError("the pattern is sunk through the solid: the height must be above minus the thickness");
    const Vertices outside =
        moved_sheet(sheet.vertices(raised.source, Eigen::all), sheet.normals(raised.source, Eigen::all),
                    (raised.height.array() + half).matrix(), without_walls(raised), sheet.face);
    const Vertices inside = moved_sheet(sheet.vertices, sheet.normals, VectorXd::Constant(sheet.vertices.rows(), -half),
                                        sheet.triangles, sheet.face);
    Solid solid = closed_solid(outside, raised.triangles, inside, sheet.triangles);
    result.vertices = std::move(solid.vertices);
    result.triangles = std::move(solid.triangles);
    result.patch = std::move(solid.patch);
    result.original.assign(result.vertices.rows(), -1);
    const std::vector<Index> twin = pair_halfedges(result.triangles, static_cast<Index>(result.vertices.rows()));
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] == no_twin || origin(result.triangles, h) != target(result.triangles, twin[h]))
            throw SolverError("the solid is not closed");
}

/// What a pattern's file holds; nothing for a built-in pattern.
struct PatternFile {
    std::optional<SvgDrawing> drawing;
    std::optional<GreyImage> image;
};

PatternFile read_pattern(const std::string& pattern, const LiftOptions& options)
{
    const bool is_file = is_pattern_file(pattern), is_image = is_file && io::lower_extension(pattern) == ".png";
    if (options.turn != 0.0 && (!is_file || is_image)) throw InputError("a turn is for drawings");
    if (!is_file) return {};
    if (options.bridge) throw InputError("a bridge is for the built-in patterns: a file has its own");
    if (!is_image) return {.drawing = parse_svg(io::read_bytes(pattern)), .image = {}};
    if (!options.height) throw InputError("an image is a relief: give the height of white");
    if (options.shape == LiftShape::parts) throw InputError("an image is for disks, rings and tori: parts have cuts");
    if (options.repeats > 1 && options.shape == LiftShape::disk)
        throw InputError("repeats of an image are for rings and tori: a disk does not repeat");
    return {.drawing = {}, .image = parse_png(io::read_bytes(pattern))};
}

/// The sheet in faces as fine as the image, and its heights.
RaisedSheet image_relief(const FlatSheet& domain, const GreyImage& image, const LiftOptions& options, KeptSheet& sheet,
                         LiftResult& result)
{
    const ImagePlace place{std::max(1, options.repeats)};
    const double edge = pixel_edge(domain, image, place);
    result.size = options.size.value_or(edge * domain.mean_scale);
    FineSheet fine = refined_sheet(domain, edge, options.size);
    RaisedSheet raised;
    raised.height = *options.height * image_values(domain, fine, image, place);
    raised.triangles = fine.triangles;
    raised.uv = fine.uv;
    raised.patch.assign(fine.triangles.rows(), 0);
    raised.source.resize(fine.vertices.rows());
    std::iota(raised.source.begin(), raised.source.end(), 0);
    sheet.original = raised.source;
    std::fill(sheet.original.begin() + domain.vertices.rows(), sheet.original.end(), -1);
    sheet.patch = raised.patch;
    sheet.face = std::move(fine.face);
    sheet.vertices = std::move(fine.vertices);
    sheet.normals = std::move(fine.normals);
    sheet.triangles = std::move(fine.triangles);
    sheet.uv = std::move(fine.uv);
    return raised;
}

std::vector<DrawnOutline> built_in_outlines(const FlatSheet& sheet, const std::string& name, const LiftOptions& options,
                                            LiftResult& result)
{
    const PatternOptions chosen = pattern_options(sheet, options);
    result.size = chosen.size;
    result.bridge = chosen.bridge;
    DrawnPattern pattern = built_in_pattern(sheet, name, chosen);
    result.bend = pattern.bend;
    return std::move(pattern.outlines);
}

/// The sheet with the pattern's outlines in it, and those raised or cut out.
RaisedSheet outlined_sheet(const FlatDomain& domain, std::vector<DrawnOutline> outlines, int open,
                           const LiftOptions& options, KeptSheet& sheet, LiftResult& result)
{
    const Overlay overlay = draw_outlines(domain.sheet, std::move(outlines));
    result.left_out = overlay.left_out;
    result.left_out.open = open;
    result.outlines = static_cast<Index>(std::ranges::count(overlay.outlines, false, &DrawnOutline::hole));
    if (result.outlines == 0)
        throw InputError("no outline of the pattern fits the surface: give another size (left out at a hole, a rim or "
                         "a cut: " +
                         std::to_string(result.left_out.at_border) + ")");
    std::vector<char> keep(overlay.region.size(), 1);
    if (options.perforate)
        for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = overlay.region[f] < 0;
    sheet = kept_faces(overlay, keep, static_cast<Index>(domain.sheet.vertices.rows()));
    return raised_sheet(sheet, options.height);
}

/// The outlines of a drawing, and warnings about it.
std::vector<DrawnOutline> outlines_of(const SvgDrawing& drawing, const FlatSheet& sheet, const LiftOptions& options,
                                      LiftResult& result)
{
    PlacedDrawing placed = placed_drawing(sheet, drawing,
                                          {.in_disk = options.shape == LiftShape::disk,
                                           .size = options.size,
                                           .repeats = options.repeats,
                                           .turn = options.turn,
                                           .cut_out = options.perforate});
    result.size = placed.size;
    result.islands = placed.islands;
    if (placed.islands > 0)
        result.warnings.push_back({WarningKind::left_out,
                                   counted(static_cast<std::size_t>(placed.islands), "island") +
                                       " inside outlines would hang on nothing, and fell out with them",
                                   std::move(placed.island_faces),
                                   "Draw bridges, as a stencil has, or raise the drawing"});
    if (!drawing.not_drawn.empty()) {
        std::string names;
        for (const std::string& one : drawing.not_drawn) names += (names.empty() ? "<" : ", <") + one + ">";
        result.warnings.push_back({WarningKind::not_kept,
                                   "the drawing's " + names + " is not drawn",
                                   {},
                                   "Convert text and clones to paths first"});
    }
    return std::move(placed.outlines);
}

LiftResult lift_here(const Vertices& vertices, const Triangles& triangles, const std::string& name,
                     const LiftOptions& options, ExecutionContext& context)
{
    const Stopwatch clock;
    if (options.perforate == options.height.has_value()) throw InputError("either perforate, or give a height");
    const PatternFile file = read_pattern(name, options);
    FlatDomain domain = flat_domain(vertices, triangles, options, context);
    context.checkpoint();
    LiftResult result;
    result.shape = options.shape;
    result.pattern = is_pattern_file(name) ? std::filesystem::path(name).filename().string() : name;
    result.converged = domain.map.converged;
    result.distortion = domain.map.distortion;
    result.seconds = domain.map.seconds;
    result.warnings = domain.map.warnings;

    KeptSheet sheet;
    RaisedSheet raised;
    if (file.image) {
        raised = image_relief(domain.sheet, *file.image, options, sheet, result);
    } else {
        std::vector<DrawnOutline> outlines = file.drawing ? outlines_of(*file.drawing, domain.sheet, options, result)
                                                          : built_in_outlines(domain.sheet, name, options, result);
        context.checkpoint();
        raised =
            outlined_sheet(domain, std::move(outlines), file.drawing ? file.drawing->open : 0, options, sheet, result);
    }
    context.checkpoint();
    require_foretold(domain.surface, sheet, options.perforate ? result.outlines : 0, result);
    if (options.thickness)
        finish_solid(sheet, raised, options, result);
    else
        finish_sheet(sheet, std::move(raised), options, result);
    warn_of_left_out(result);
    result.vertex_count = static_cast<Index>(result.vertices.rows());
    result.face_count = static_cast<Index>(result.triangles.rows());
    result.peak_memory_mb = peak_memory_mb();
    result.seconds.total = clock.elapsed();
    return result;
}

}  // namespace

const char* to_string(LiftShape shape) noexcept { return word_of(shape, std::array{"disk", "ring", "torus", "parts"}); }

LiftResult lift(const Vertices& vertices, const Triangles& triangles, const std::string& pattern,
                const LiftOptions& options, ExecutionContext& context)
{
    return run_detachable<LiftResult>(context, [vertices, triangles, pattern, options](ExecutionContext& own) {
        return lift_here(vertices, triangles, pattern, options, own);
    });
}

}  // namespace koebe
