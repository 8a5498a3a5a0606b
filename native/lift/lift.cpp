#include "lift/lift.h"

#include "core/counted.h"
#include "core/enum_words.h"
#include "execution/detachable_run.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "lift/flat_domain.h"
#include "lift/patterns.h"
#include "lift/raised.h"
#include "lift/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr double cells_across = 12.0;  // of the root of the area, if no size is given

struct KeptSheet {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;
    std::vector<Index> original, patch;
};

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
        sheet.patch.push_back(overlay.region[f] >= 0 ? 1 : 0);
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

void add_warnings(const MapReport& map, LiftResult& result)
{
    result.warnings = map.warnings;
    if (const LeftOut& left = result.left_out; left.all() > 0) {
        std::string reasons;
        const auto add = [&](Index number, const std::string& reason) {
            if (number > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(number) + " " + reason;
        };
        add(left.at_border, "at a hole, a rim or a cut");
        add(left.too_fine, "too small for 32-bit UVs");
        add(left.crossing, "that meet another");
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

void finish_sheet(const KeptSheet& sheet, const LiftOptions& options, LiftResult& result)
{
    RaisedSheet raised = raised_sheet(sheet, options.height);
    result.vertices = sheet.vertices(raised.source, Eigen::all);
    result.original.assign(raised.source.size(), -1);
    for (std::size_t v = 0; v < raised.source.size(); ++v)
        if (raised.height[static_cast<Eigen::Index>(v)] == 0.0) result.original[v] = sheet.original[raised.source[v]];
    if (options.height)
        result.vertices = moved_along(result.vertices, sheet.normals(raised.source, Eigen::all), raised.height,
                                      without_walls(raised));
    result.triangles = std::move(raised.triangles);
    result.uv.resize(static_cast<Eigen::Index>(raised.uv.size()), 2);
    for (std::size_t c = 0; c < raised.uv.size(); ++c)
        result.uv.row(static_cast<Eigen::Index>(c)) << raised.uv[c].real(), raised.uv[c].imag();
    result.patch = std::move(raised.patch);
}

void finish_solid(const KeptSheet& sheet, const LiftOptions& options, LiftResult& result)
{
    const double half = 0.5 * *options.thickness;
    if (options.height.value_or(0.0) <= -2.0 * half)
        throw InputError("the pattern is sunk through the solid: the height must be above minus the thickness");
    const RaisedSheet raised = raised_sheet(sheet, options.height);
    const Vertices outside =
        moved_along(sheet.vertices(raised.source, Eigen::all), sheet.normals(raised.source, Eigen::all),
                    (raised.height.array() + half).matrix(), without_walls(raised));
    const Vertices inside =
        moved_along(sheet.vertices, sheet.normals, VectorXd::Constant(sheet.vertices.rows(), -half), sheet.triangles);
    Solid solid = closed_solid(outside, raised.triangles, inside, sheet.triangles);
    result.vertices = std::move(solid.vertices);
    result.triangles = std::move(solid.triangles);
    result.patch = std::move(solid.patch);
    result.original.assign(result.vertices.rows(), -1);
    const std::vector<Index> twin = pair_halfedges(result.triangles, static_cast<Index>(result.vertices.rows()));
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] == no_twin || origin(result.triangles, h) != target(result.triangles, twin[h]))
            throw SolverError("the solid is not closed", ElementKind::faces, {face_of(h)});
}

LiftResult lift_here(const Vertices& vertices, const Triangles& triangles, const std::string& name,
                     const LiftOptions& options, ExecutionContext& context)
{
    const Stopwatch clock;
    if (options.perforate == options.height.has_value()) throw InputError("either perforate, or give a height");
    FlatDomain domain = flat_domain(vertices, triangles, options, context);
    context.checkpoint();
    LiftResult result;
    const PatternOptions chosen = pattern_options(domain.sheet, options);
    result.shape = options.shape;
    result.pattern = name;
    result.size = chosen.size;
    result.bridge = chosen.bridge;
    result.converged = domain.map.converged;
    result.distortion = domain.map.distortion;
    result.seconds = domain.map.seconds;

    DrawnPattern pattern = built_in_pattern(domain.sheet, name, chosen);
    context.checkpoint();
    result.bend = pattern.bend;
    const Overlay overlay = draw_outlines(domain.sheet, std::move(pattern.outlines));
    context.checkpoint();
    result.left_out = overlay.left_out;
    result.outlines = static_cast<Index>(overlay.outlines.size());
    if (result.outlines == 0)
        throw InputError("no outline of the pattern fits the surface: give another size (left out at a hole, a rim or "
                         "a cut: " +
                         std::to_string(result.left_out.at_border) + ")");

    std::vector<char> keep(overlay.region.size(), 1);
    if (options.perforate)
        for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = overlay.region[f] < 0;
    const KeptSheet sheet = kept_faces(overlay, keep, static_cast<Index>(vertices.rows()));
    require_foretold(domain.surface, sheet, options.perforate ? result.outlines : 0, result);
    if (options.thickness)
        finish_solid(sheet, options, result);
    else
        finish_sheet(sheet, options, result);
    add_warnings(domain.map, result);
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
