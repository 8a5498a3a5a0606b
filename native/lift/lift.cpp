#include "lift/lift.h"

#include "core/counted.h"
#include "execution/detachable_run.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "lift/flat_domain.h"
#include "lift/patterns.h"
#include "lift/relief.h"
#include "lift/solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr double cells_across = 12.0;  // of the root of the area, if no size is given
constexpr double ramp_share = 0.25;    // of the way to an outline's middle

struct Sheet {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;
    std::vector<Index> original, patch;
};

/// The faces to keep, and their vertices in their order.
Sheet kept_faces(const Overlay& overlay, const std::vector<char>& keep, Index original_count)
{
    const Index count = static_cast<Index>(overlay.vertices.rows());
    std::vector<Index> number(count, -1);
    Sheet sheet;
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
void require_foretold(const Surface& before, const Sheet& sheet, Index holes, LiftResult& result)
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

void finish_sheet(Sheet sheet, const VectorXd& heights, LiftResult& result)
{
    if (heights.size() > 0) {
        const Vertices raised = sheet.vertices + (sheet.normals.array().colwise() * heights.array()).matrix();
        std::vector<Index> turned = overturned_faces(sheet.vertices, raised, sheet.triangles);
        if (!turned.empty())
            throw InputError("the height is more than the surface's bends allow: faces would turn over",
                             ElementKind::faces, std::move(turned));
        for (std::size_t v = 0; v < sheet.original.size(); ++v)
            if (heights[static_cast<Eigen::Index>(v)] != 0.0) sheet.original[v] = -1;
        sheet.vertices = raised;
    }
    result.vertices = std::move(sheet.vertices);
    result.triangles = std::move(sheet.triangles);
    result.uv.resize(static_cast<Eigen::Index>(sheet.uv.size()), 2);
    for (std::size_t c = 0; c < sheet.uv.size(); ++c)
        result.uv.row(static_cast<Eigen::Index>(c)) << sheet.uv[c].real(), sheet.uv[c].imag();
    result.original = std::move(sheet.original);
    result.patch = std::move(sheet.patch);
}

void finish_solid(const Sheet& sheet, const VectorXd& heights, double thickness, LiftResult& result)
{
    const VectorXd half = VectorXd::Constant(sheet.vertices.rows(), 0.5 * thickness);
    const VectorXd out = heights.size() > 0 ? (half + heights).eval() : half;
    if (out.minCoeff() <= -0.5 * thickness)
        throw InputError("the pattern is sunk through the solid: the height must be above minus the thickness");
    Solid solid = thicken(sheet.vertices, sheet.triangles, sheet.normals, out, half);
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
    if (options.perforate == options.height.has_value())
        throw InputError("either perforate, or give a height");
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

    Pattern pattern = built_in_pattern(domain.sheet, name, chosen);
    context.checkpoint();
    result.bend = pattern.bend;
    if (options.height) pattern.outlines = with_inner_outlines(domain.sheet, pattern.outlines, ramp_share);
    const Overlay overlay = draw_outlines(domain.sheet, std::move(pattern.outlines));
    context.checkpoint();
    result.left_out = overlay.left_out;
    result.outlines = static_cast<Index>(overlay.outlines.size()) / (options.height ? 2 : 1);
    if (result.outlines == 0)
        throw InputError("no outline of the pattern fits the surface: give another size (left out at a hole, a rim or "
                         "a cut: " + std::to_string(result.left_out.at_border) + ")");

    std::vector<char> keep(overlay.region.size(), 1);
    if (options.perforate)
        for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = overlay.region[f] < 0;
    const Sheet sheet = kept_faces(overlay, keep, static_cast<Index>(vertices.rows()));
    VectorXd heights;
    if (options.height) {
        const VectorXd all = *options.height * relief_heights(overlay);
        heights.resize(sheet.vertices.rows());
        Eigen::Index at = 0;
        std::vector<char> used(all.size(), 0);
        for (Eigen::Index c = 0; c < overlay.triangles.size(); ++c) used[overlay.triangles.data()[c]] = 1;
        for (Eigen::Index v = 0; v < all.size(); ++v)
            if (used[v]) heights[at++] = all[v];
    }
    require_foretold(domain.surface, sheet, options.perforate ? result.outlines : 0, result);
    if (options.thickness)
        finish_solid(sheet, heights, *options.thickness, result);
    else
        finish_sheet(sheet, heights, result);
    add_warnings(domain.map, result);
    result.peak_memory_mb = peak_memory_mb();
    result.seconds.total = clock.elapsed();
    return result;
}

}  // namespace

const char* to_string(LiftShape shape) noexcept
{
    switch (shape) {
    case LiftShape::disk: return "disk";
    case LiftShape::ring: return "ring";
    case LiftShape::torus: return "torus";
    case LiftShape::parts: return "parts";
    }
    return "disk";
}

LiftResult lift(const Vertices& vertices, const Triangles& triangles, const std::string& pattern,
                const LiftOptions& options, ExecutionContext& context)
{
    return run_detachable<LiftResult>(context, [vertices, triangles, pattern, options](ExecutionContext& own) {
        return lift_here(vertices, triangles, pattern, options, own);
    });
}

}  // namespace koebe
