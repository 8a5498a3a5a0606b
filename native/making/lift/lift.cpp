#include "lift/lift.h"

#include "core/all_elements.h"
#include "core/counted.h"
#include "core/enum_words.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "execution/peak_memory.h"
#include "execution/run_on_copies.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"
#include "lift/bent_mesh.h"
#include "lift/bridges.h"
#include "lift/clipped_outlines.h"
#include "lift/flat_domain.h"
#include "lift/image_relief.h"
#include "lift/kept_sheet.h"
#include "lift/meeting_faces.h"
#include "lift/pattern_file.h"
#include "lift/patterns.h"
#include "lift/placed_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace koebe {
namespace {

constexpr double cells_across = 12.0;  // of the root of the area, if no size is given

/// Checks loops and Euler characteristic of the sheet against what the outlines must have made of them.
void require_expected_topology(const Surface& before, const KeptSheet& sheet, Index holes, LiftResult& result)
{
    const Surface after = analyze_surface(sheet.triangles, static_cast<Index>(sheet.vertices.rows()));
    result.loops_before = static_cast<int>(before.loops.size());
    result.loops_after = static_cast<int>(after.loops.size());
    result.euler_before = before.euler_characteristic;
    result.euler_after = after.euler_characteristic;
    if (result.loops_after != result.loops_before + holes || result.euler_after != result.euler_before - holes ||
        !after.reoriented.empty())
        throw SolverError("the pattern has made " + std::to_string(result.loops_after - result.loops_before) +
                          " holes in place of " + std::to_string(holes) + ", and lowered the Euler characteristic by " +
                          std::to_string(result.euler_before - result.euler_after));
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

PatternOptions pattern_options(const FlatDomain& domain, const LiftOptions& options)
{
    const FlatSheet& sheet = domain.sheet();
    PatternOptions chosen;
    chosen.size = options.size.value_or(std::sqrt(sheet.area) / cells_across);
    chosen.bridge = options.bridge.value_or(0.2 * chosen.size);
    chosen.repeats = options.repeats;
    chosen.seed = static_cast<std::uint64_t>(options.seed);
    chosen.turn = options.turn;
    chosen.rows = options.rows;
    chosen.hole = domain.hole;
    chosen.whole = options.rim == LiftRim::whole;
    if (!(chosen.size > 0.0))
        throw InputError("the surface has no area: no size for the pattern", ElementKind::faces,
                         all_elements(sheet.triangles.rows()));
    return chosen;
}

/// The sheet in faces as fine as the image, and its heights.
RaisedSheet image_relief(const FlatDomain& whole, const GreyImage& image, const LiftOptions& options, KeptSheet& sheet,
                         LiftResult& result)
{
    const FlatSheet& domain = whole.sheet();
    const ImagePlace place{std::max(1, options.repeats), whole.sphere ? whole.sphere->home_scale : 0.0};
    const double edge = pixel_edge(domain, image, place);
    result.size = options.size.value_or(edge * domain.mean_scale);
    FineSheet fine = refined_sheet(domain, edge, options.size);
    RaisedSheet raised;
    raised.height = *options.height * image_values(domain, fine, image, place);
    raised.triangles = fine.triangles;
    raised.uv = fine.uv;
    raised.patch.assign(fine.triangles.rows(), 0);
    raised.source = numbers_below(fine.vertices.rows());
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

std::vector<DrawnOutline> built_in_outlines(const FlatDomain& domain, const std::string& name,
                                            const LiftOptions& options, LiftResult& result)
{
    const PatternOptions chosen = pattern_options(domain, options);
    result.size = chosen.size;
    result.bridge = chosen.bridge;
    DrawnPattern pattern = domain.sphere ? built_in_pattern_on_sphere(*domain.sphere, name, chosen)
                                         : built_in_pattern(domain.flat, name, chosen, &domain.walked());
    result.bend = pattern.bend;
    return std::move(pattern.outlines);
}

void warn_of_thin_bridges(const FlatDomain& domain, const Overlay& overlay, const std::vector<char>& keep, double width,
                          LiftResult& result, const ExecutionContext& context)
{
    ThinBridges thin = thin_bridges(domain.walked(), overlay, keep, width, context);
    result.thin_bridges = thin.count;
    result.thinnest_bridge = thin.thinnest;
    if (thin.count > 0)
        result.warnings.push_back({WarningKind::thin_bridges,
                                   counted(static_cast<std::size_t>(thin.count), "bridge") +
                                       " thinner than asked for: the thinnest is " + formatted("%.4g", *thin.thinnest),
                                   std::move(thin.faces), "Ask for a wider bridge, or make the map more even (even)"});
}

/// The sheet with the pattern's outlines in it, and those raised or cut out.
RaisedSheet outlined_sheet(const FlatDomain& domain, std::vector<DrawnOutline> outlines, int open,
                           const LiftOptions& options, KeptSheet& sheet, LiftResult& result,
                           const ExecutionContext& context)
{
    // Draw the outlines into the faces.
    const std::vector<FlatSheet> charts = domain.sphere ? domain.sphere->charts : std::vector<FlatSheet>();
    ClippedOverlay drawn;
    if (domain.filled) {
        drawn = draw_clipped_outlines(*domain.filled, std::move(outlines), charts, options.perforate);
    } else {
        drawn.overlay = draw_outlines(domain.sheet(), std::move(outlines), charts);
        drawn.outlines = static_cast<Index>(std::ranges::count(drawn.overlay.outlines, false, &DrawnOutline::hole));
        drawn.holes = options.perforate ? drawn.outlines : 0;
    }
    const Overlay& overlay = drawn.overlay;
    result.left_out = overlay.left_out;
    result.left_out.open = open;
    result.outlines = drawn.outlines;
    if (result.outlines == 0)
        throw InputError("no outline of the pattern fits the surface: give another size (left out at a hole, a rim or "
                         "a cut: " +
                         std::to_string(result.left_out.at_border) + ")");
    // Keep the faces on the surface, without the outlines that are cut out.
    std::vector<char> keep(overlay.region.size(), 1);
    for (std::size_t f = 0; f < keep.size(); ++f)
        keep[f] = domain.walked().on_surface(overlay.face[f]) && !(options.perforate && overlay.region[f] >= 0);
    if (std::ranges::find(keep, 1) == keep.end()) throw InputError("an outline covers the surface: nothing is left");
    if (options.perforate && options.bridge)
        warn_of_thin_bridges(domain, overlay, keep, *options.bridge, result, context);
    sheet = kept_faces(overlay, keep, static_cast<Index>(domain.sheet().vertices.rows()));
    require_expected_topology(domain.surface, sheet, drawn.holes, result);
    return raised_sheet(sheet, options.height);
}

PatternPlace place_of(const FlatDomain& domain, const LiftOptions& options)
{
    return {.in_disk = options.shape == LiftShape::disk || domain.sphere,
            .on_sphere = domain.sphere.has_value(),
            .size = options.size,
            .repeats = options.repeats,
            .turn = options.turn};
}

/// The outlines of a drawing, and warnings about it.
std::vector<DrawnOutline> outlines_of(const SvgDrawing& drawing, const FlatDomain& domain, const LiftOptions& options,
                                      LiftResult& result)
{
    const FlatSheet& sheet = domain.placing_sheet();
    // The drawing where the options lay it.
    PlacedDrawing placed = placed_drawing(
        sheet, domain.filled ? *domain.filled : sheet, drawing, place_of(domain, options), options.perforate,
        options.rim == LiftRim::whole ? std::optional(options.bridge.value_or(0.0)) : std::nullopt);
    for (DrawnOutline& outline : placed.outlines) outline.chart = domain.middle_chart();
    result.size = placed.size;
    result.islands = placed.islands;
    // What is not as the drawing shows it.
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
                                   "Convert text to paths, and clip paths too, first"});
    }
    return std::move(placed.outlines);
}

/// The faces of the surface of those that meet, for a sheet or a solid over it.
std::vector<Index> faces_below(const std::vector<Index>& meeting, const KeptSheet& sheet, std::size_t outer)
{
    std::vector<Index> faces;
    for (const Index f : meeting) {
        const std::size_t number = static_cast<std::size_t>(f), own = number < outer ? number : number - outer;
        if (own < sheet.face.size()) faces.push_back(sheet.face[own]);  // others are walls
    }
    sort_unique(faces);
    return faces;
}

void warn_of_crossings(const MeetingFaces& meeting, std::vector<Index> faces, LiftResult& result)
{
    result.crossings = meeting.pairs;
    if (meeting.pairs > 0)
        result.warnings.push_back({WarningKind::crossings,
                                   "distant places of the result meet: " +
                                       counted(static_cast<std::size_t>(meeting.pairs), "pair") + " of faces",
                                   std::move(faces), "Lower the thickness or the height there"});
}

void lift_outlines(const FlatDomain& domain, const Triangles& given, const PatternFile& file, const std::string& name,
                   const LiftOptions& options, LiftResult& result, ExecutionContext& context)
{
    // Raise the image, or draw the outlines and raise or cut them out.
    KeptSheet sheet;
    RaisedSheet raised;
    if (file.image) {
        raised = image_relief(domain, *file.image, options, sheet, result);
        require_expected_topology(domain.surface, sheet, 0, result);
    } else {
        std::vector<DrawnOutline> outlines = file.drawing ? outlines_of(*file.drawing, domain, options, result)
                                                          : built_in_outlines(domain, name, options, result);
        context.checkpoint();
        raised = outlined_sheet(domain, std::move(outlines), file.drawing ? file.drawing->open : 0, options, sheet,
                                result, context);
    }
    context.checkpoint();
    // Close the sheet to a solid, if it has a thickness.
    const std::size_t outer = raised.patch.size();
    const std::vector<Index> source = raised.source;
    if (options.thickness)
        finish_solid(sheet, raised, options, result);
    else
        finish_sheet(sheet, std::move(raised), options, result);
    tell_places(sheet, domain.sheet().vertices, given, source, outer, result);
    warn_of_left_out(result);
    // A relief or a solid may cross itself.
    if (!options.thickness && !options.height) return;
    context.checkpoint();
    const MeetingFaces meeting = meeting_faces(result.vertices, result.triangles, context);
    if (!meeting.all)
        throw InputError("the thickness or height is far more than the surface has room for: too many faces would meet",
                         ElementKind::faces, faces_below(meeting.faces, sheet, outer));
    warn_of_crossings(meeting, faces_below(meeting.faces, sheet, outer), result);
}

/// The pattern's mesh in place of the surface.
void lift_mesh(const FlatDomain& domain, const PatternMesh& mesh, const LiftOptions& options, LiftResult& result,
               ExecutionContext& context)
{
    BentMesh bent = bent_mesh(domain.placing_sheet(), mesh.vertices, mesh.triangles, place_of(domain, options),
                              options.height.value_or(1.0));
    if (bent.triangles.rows() == 0)
        throw InputError("no part of the mesh fits the surface: its parts lie outside of the map, or over a hole, a "
                         "rim or a cut. Give another size",
                         ElementKind::faces, std::move(bent.left_at));
    context.checkpoint();
    // Report parts and faces that were left out or are turned over.
    result.size = bent.size;
    result.loops_before = static_cast<int>(domain.surface.loops.size());
    result.euler_before = domain.surface.euler_characteristic;
    if (bent.left_out > 0) {
        result.left_out.at_border = bent.left_out;
        result.left_out.faces = bent.left_at;
        result.warnings.push_back({WarningKind::left_out,
                                   counted(static_cast<std::size_t>(bent.left_out), "part") +
                                       " of the mesh left out: outside of the map, or over a hole, a rim or a cut",
                                   std::move(bent.left_at)});
    }
    if (bent.upside_down > 0)
        result.warnings.push_back({WarningKind::flipped, counted(static_cast<std::size_t>(bent.upside_down), "face") +
                                                             " of the pattern without a positive area in the UVs: "
                                                             "its walls and undersides"});
    result.vertices = std::move(bent.vertices);
    result.triangles = std::move(bent.triangles);
    result.patch.assign(bent.uv.size() / 3, 0);
    result.original.assign(result.vertices.rows(), -1);
    result.uv = planar_points(bent.uv);
    // Faces that meet on the surface, and did not in the pattern.
    const auto meeting_of = [&](const Vertices& vertices, const Triangles& triangles) {
        const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
        return meeting_faces(vertices, joined_corners(vertices, triangles, 1e-9 * diagonal), context);
    };
    const MeetingFaces before = meeting_of(mesh.vertices, mesh.triangles);
    const MeetingFaces meeting = meeting_of(result.vertices, result.triangles);
    if (!meeting.all && before.all)
        throw InputError("the mesh's heights are far more than the surface has room for: too many faces would meet");
    if (meeting.pairs > 0 && before.pairs == 0) warn_of_crossings(meeting, {}, result);
    result.crossings = meeting.pairs;
}

LiftResult lift_here(const Vertices& vertices, const Triangles& triangles, const std::string& name,
                     const LiftOptions& options, ExecutionContext& context)
{
    const Stopwatch clock;
    const ThreadShare threads(0);
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
    if (file.mesh)
        lift_mesh(domain, *file.mesh, options, result, context);
    else
        lift_outlines(domain, triangles, file, name, options, result, context);
    result.vertex_count = static_cast<Index>(result.vertices.rows());
    result.face_count = static_cast<Index>(result.triangles.rows());
    result.peak_memory_mb = peak_memory_mb();
    result.seconds.total = clock.elapsed();
    return result;
}

}  // namespace

const char* to_string(LiftShape shape) noexcept
{
    return word_of(shape, std::array{"disk", "ring", "torus", "sphere", "parts"});
}

LiftResult lift(const Vertices& vertices, const Triangles& triangles, const std::string& pattern,
                const LiftOptions& options, ExecutionContext& context)
{
    return run_on_copies<LiftResult>(context, lift_here, vertices, triangles, pattern, options);
}

}  // namespace koebe
