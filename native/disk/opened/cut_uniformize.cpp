#include "opened/cut_uniformize.h"

#include "canonical/corner_map.h"
#include "core/errors.h"
#include "execution/peak_memory.h"
#include "execution/side_by_side.h"
#include "execution/stopwatch.h"
#include "foldover/convex_polygons.h"
#include "mesh/topology.h"
#include "opened/cut_sheet.h"
#include "opened/cut_warnings.h"
#include "opened/disk_packing.h"
#include "pipeline/map_input.h"
#include "pipeline/uniformize.h"
#include "quality/take_verdict.h"
#include "surface/importance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double opening_share = 0.1;  // share of the progress
constexpr double small_share = 0.1;    // share of all faces: smaller pieces are mapped side by side
constexpr double least_share = 0.1;    // dimensionless: least radius of a disk over the mean one
constexpr int most_packings = 5;       // pieces flipped by rounding are drawn twice as large each time

/// The piece that gets a vertex named in the options, and the vertex's number there.
struct NamedVertex {
    Index vertex = -1;
    std::size_t piece = 0;
    Index local = -1;
};

NamedVertex find_named(const std::vector<SurfacePiece>& pieces, const CanonicalMesh& mesh, Index vertex, bool on_loop,
                       const char* what)
{
    if (vertex < 0) return {};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& names = pieces[i].source_vertex;
        if (std::ranges::find(names, vertex) == names.end()) continue;
        const std::vector<char> boundary =
            boundary_mask(analyze_surface(pieces[i].triangles, static_cast<Index>(names.size())));
        for (std::size_t v = 0; v < names.size(); ++v)
            if (names[v] == vertex && (boundary[v] != 0) == on_loop) return {vertex, i, static_cast<Index>(v)};
    }
    Index name = vertex;
    mesh.name_vertex(name);
    throw InputError("vertex " + std::to_string(name) + " cannot be the " + what + ": it lies " +
                         (on_loop ? "on no boundary loop" : "inside no piece"),
                     ElementKind::vertices, {vertex});
}

class PieceMapper {
public:
    PieceMapper(const OpenedSurface& opened, const CanonicalMesh& mesh, const UniformizeOptions& options)
        : opened_(opened),
          options_(options),
          outer_(find_named(opened.pieces, mesh, options.outer == OuterLoop::vertex ? options.outer_vertex : -1, true,
                            "outer loop's")),
          center_(find_named(opened.pieces, mesh, options.center, false, "centre")),
          point_(find_named(opened.pieces, mesh, options.point, true, "point"))
    {
    }

    /// @param failure the error of a piece that has no map, unless it is set
    MappedPiece map(std::size_t i, ExecutionContext& context, std::exception_ptr& failure) const
    {
        const SurfacePiece& piece = opened_.pieces[i];
        MappedPiece mapped{piece.source_face, {}, {}};
        const UniformizeOptions own = options_for(i);
        try {
            mapped.map = uniformize_here(piece.vertices, piece.triangles, own, context);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError& error) {
            fail(piece, error, mapped);
            if (!failure) failure = std::current_exception();
        } catch (const InputError& error) {  // a piece without any extent
            if (own.outer == OuterLoop::vertex || own.center >= 0 || own.point >= 0) throw;
            fail(piece, error, mapped);
            if (!failure) failure = std::current_exception();
        }
        return mapped;
    }

    /// Replaces the piece's numbers by the input's.
    static void rename(const SurfacePiece& piece, UniformizeResult& map)
    {
        const auto rename_all = [](std::vector<Index>& numbers, const std::vector<Index>& names) {
            for (Index& number : numbers) number = names[static_cast<std::size_t>(number)];
        };
        for (LoopReport& loop : map.loops) {
            rename_all(loop.vertices, piece.source_vertex);
            rename_all(loop.off_circle, piece.source_vertex);
        }
        rename_all(map.distortion.flipped, piece.source_face);
        rename_all(map.distortion.below_resolution, piece.source_face);
        for (Index* named : {&map.center, &map.point})
            if (*named >= 0) *named = piece.source_vertex[static_cast<std::size_t>(*named)];
    }

private:
    UniformizeOptions options_for(std::size_t i) const
    {
        UniformizeOptions own = options_;
        own.most_lost = 1.0;  // the verdict is about all pieces in their final places
        own.center = center_.piece == i ? center_.local : -1;
        own.point = point_.piece == i ? point_.local : -1;
        if (own.outer == OuterLoop::vertex) {
            own.outer_vertex = outer_.piece == i ? outer_.local : -1;
            if (own.outer_vertex < 0) own.outer = OuterLoop::automatic;
        }
        own.vertex_names = opened_.pieces[i].source_vertex;
        own.face_names = opened_.pieces[i].source_face;
        if (!own.importance.empty()) {
            own.importance.clear();
            for (const Index v : opened_.pieces[i].source_vertex)
                own.importance.push_back(options_.importance[static_cast<std::size_t>(v)]);
        }
        return own;
    }

    static void fail(const SurfacePiece& piece, const KoebeError& error, MappedPiece& mapped)
    {
        mapped.mapped = false;
        mapped.map.uv = PlanarPoints::Zero(piece.vertices.rows(), 2);
        mapped.map.vertex_count = static_cast<Index>(piece.vertices.rows());
        mapped.map.face_count = static_cast<Index>(piece.triangles.rows());
        mapped.map.warnings.push_back(
            {WarningKind::not_converged, std::string("no map: ") + error.name() + ", " + error.what()});
    }

    const OpenedSurface& opened_;
    const UniformizeOptions& options_;
    NamedVertex outer_, center_, point_;
};

/// @param importance (V') or empty
double area_of(const SurfacePiece& piece, double unit, const VectorXd& importance)
{
    double area = 0.0;
    const VectorXd factors = importance.size() > 0 ? importance_factors(piece.triangles, importance)
                                                   : VectorXd::Ones(piece.triangles.rows());
    for (Eigen::Index f = 0; f < piece.triangles.rows(); ++f) {
        const auto face = piece.triangles.row(f);
        const Eigen::RowVector3d a = piece.vertices.row(face[0]) / unit;
        const Eigen::RowVector3d ab = piece.vertices.row(face[1]) / unit - a,
                                 ac = piece.vertices.row(face[2]) / unit - a;
        area += 0.5 * ab.cross(ac).norm() * factors[f];
    }
    return area;
}

/// Radii of disks with the areas of the pieces. Important pieces and the smallest pieces get larger disks.
/// @param importance (V) of the mesh, or empty
std::vector<double> radii_by_area(const std::vector<SurfacePiece>& pieces, const std::vector<double>& importance)
{
    double least = 1.0;
    for (const SurfacePiece& piece : pieces)
        for (const Index v : piece.source_vertex)
            if (!importance.empty()) least = std::min(least, importance[static_cast<std::size_t>(v)]);
    const auto own_importance = [&](const SurfacePiece& piece) {
        VectorXd own(importance.empty() ? 0 : static_cast<Eigen::Index>(piece.source_vertex.size()));
        for (Eigen::Index v = 0; v < own.size(); ++v)
            own[v] = importance[static_cast<std::size_t>(piece.source_vertex[static_cast<std::size_t>(v)])] - least;
        return own;
    };
    double unit = 0.0;
    for (const SurfacePiece& piece : pieces) unit = std::max(unit, piece.vertices.cwiseAbs().maxCoeff());
    std::vector<double> radii;
    for (const SurfacePiece& piece : pieces)
        radii.push_back(std::sqrt(area_of(piece, unit > 0.0 ? unit : 1.0, own_importance(piece)) / std::numbers::pi));
    double squares = 0.0;
    for (const double radius : radii) squares += radius * radius;
    const double mean = std::sqrt(squares / static_cast<double>(radii.size()));
    for (double& radius : radii) radius = std::max(radius, mean > 0.0 ? least_share * mean : 1.0);
    return radii;
}

/// Packs disks into the square [-1, 1]^2. @param margin in sides of the square
std::vector<Circle> packed(const std::vector<double>& radii, double margin)
{
    std::vector<Circle> disks = pack_disks(radii, margin);
    for (Circle& disk : disks) disk = {2.0 * disk.center - Complex(1.0, 1.0), 2.0 * disk.radius};
    return disks;
}

void draw_left_out(const std::vector<LeftOutFace>& left_out, const Triangles& triangles, PlanarPoints& uv)
{
    const auto corner_with = [&](Index f, Index vertex) {
        for (Eigen::Index k = 0; k < 3; ++k)
            if (triangles(f, k) == vertex) return k;
        return Eigen::Index{-1};
    };
    for (const LeftOutFace& out : left_out) {
        Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
        for (Eigen::Index k = 2; k >= 0 && out.like >= 0; --k)
            if (const Eigen::Index at = corner_with(out.like, triangles(out.face, k)); at >= 0) {
                point = uv.row(3 * static_cast<Eigen::Index>(out.like) + at);
                if (!out.degenerate) uv.row(3 * static_cast<Eigen::Index>(out.face) + k) = point;
            }
        if (out.degenerate)
            for (Eigen::Index k = 0; k < 3; ++k) uv.row(3 * static_cast<Eigen::Index>(out.face) + k) = point;
    }
}

/// @param polygon, options in the numbers of the canonical mesh
CutUniformizeResult cut_map_and_pack(const CanonicalMesh& mesh, const std::vector<Index>& polygon,
                                     const UniformizeOptions& options, ExecutionContext& context)
{
    const Vertices& vertices = mesh.vertices;
    const Triangles& triangles = mesh.triangles;
    const Stopwatch run;
    CutUniformizeResult result;
    result.method = options.method;
    result.engine = options.engine;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    require_importance(options, result.vertex_count);
    // Cut the surface open, into pieces of genus 0 with a boundary.
    context.begin_stage("cut", 0.0, opening_share);
    OpenedSurface opened = open_surface(vertices, triangles, {.polygon = polygon}, context);
    const double opening = run.elapsed();
    // Map each piece: large ones one after another with all threads, small ones side by side.
    const PieceMapper mapper(opened, mesh, options);
    const double all = static_cast<double>(triangles.rows());
    double done = 0.0;
    result.converged = true;
    result.even = options.even;
    std::vector<std::exception_ptr> failures(opened.pieces.size());
    result.pieces.resize(opened.pieces.size());
    std::vector<std::size_t> small;
    for (std::size_t i = 0; i < opened.pieces.size(); ++i) {
        const double faces = static_cast<double>(opened.pieces[i].triangles.rows());
        if (faces < small_share * all) {
            small.push_back(i);
            continue;
        }
        ExecutionContext own(
            [&](double fraction, const std::string& stage) {
                context.report(opening_share + (1.0 - opening_share) * (done + fraction * faces) / all, stage);
            },
            {}, [&context] { context.checkpoint(); });
        result.pieces[i] = mapper.map(i, own, failures[i]);
        done += faces;
    }
    if (!small.empty()) {
        context.begin_stage("iterate", opening_share + (1.0 - opening_share) * done / all, 1.0);
        side_by_side(small.size(), options.threads, context, [&](std::size_t k, ExecutionContext& own) {
            result.pieces[small[k]] = mapper.map(small[k], own, failures[small[k]]);
        });
    }
    // One report of all maps. Only if no piece has a map, the first failure is the answer.
    std::exception_ptr failure;
    for (std::size_t i = 0; i < result.pieces.size(); ++i) {
        const MappedPiece& piece = result.pieces[i];
        if (!failure) failure = failures[i];
        result.converged = result.converged && piece.mapped && piece.map.converged;
        result.seconds += piece.map.seconds;
        if (piece.mapped) result.even = std::min(*result.even, piece.map.even.value_or(0.0));
        result.overlaps += piece.map.overlaps;
        for (std::size_t f = 0; f < piece.faces.size(); ++f)
            if (opened.pieces[i].turned[f]) result.turned.push_back(piece.faces[f]);
    }
    std::ranges::sort(result.turned);
    if (failure && std::ranges::none_of(result.pieces, &MappedPiece::mapped)) std::rethrow_exception(failure);

    // Pack the disks. Where rounding at its place flips a face of a piece, its disk gets larger.
    Sheet sheet(opened.pieces);
    std::vector<double> radii = radii_by_area(opened.pieces, options.importance);
    std::vector<Circle> places;
    for (int round = 0; round < most_packings; ++round) {
        places = packed(radii, margin_in_square(options.margin, options.pixels));
        sheet.place(result.pieces, places);
        if (places.size() == 1) break;
        for (const std::size_t i : sheet.flipped_pieces())
            if (result.pieces[i].mapped) sheet.turn_back(i, places[i], result.pieces[i], context);
        const std::vector<std::size_t> flipped = sheet.flipped_pieces();
        if (flipped.empty()) break;
        for (const std::size_t i : flipped) radii[i] *= 2.0;
    }
    sheet.mend(polygon, result.pieces, places, context);
    for (std::size_t i = 0; i < places.size(); ++i) {
        result.pieces[i].place = places[i];
        PieceMapper::rename(opened.pieces[i], result.pieces[i].map);
    }
    // UVs of all faces, those left out too, and the verdict on them as stored.
    result.uv = sheet.corners(result.face_count);
    draw_left_out(opened.left_out, triangles, result.uv);
    result.cuts = std::move(opened.cuts);
    result.left_out = std::move(opened.left_out);
    std::vector<Index> left_out;
    for (const LeftOutFace& out : result.left_out) left_out.push_back(out.face);
    result.distortion = {sheet.distortion(), judge_corners(vertices, triangles, result.uv, result.turned, left_out)};
    result.handles = opened.handles;
    result.converged =
        result.converged && result.distortion.flipped.size() == result.distortion.below_resolution.size();
    result.warnings = cut_warnings(result);
    warn_concave_polygons({vertices, triangles, polygon, result.turned, {}, false, left_out}, result.uv,
                          result.warnings);
    take_verdict({.most_lost = options.most_lost, .done = true}, result);
    result.seconds.topology += opening;
    result.seconds.total = run.elapsed();
    result.peak_memory_mb = peak_memory_mb();
    context.report(1.0, "finish");
    return result;
}

UniformizeOptions canonical_options(const CanonicalMesh& mesh, const UniformizeOptions& options)
{
    UniformizeOptions here = options;
    for (Index* vertex : {&here.outer_vertex, &here.center, &here.point}) *vertex = mesh.vertex(*vertex);
    here.importance = mesh.of_vertices(options.importance);
    return here;
}

void name_piece(const CanonicalMesh& mesh, MappedPiece& piece)
{
    mesh.name_faces(piece.faces);
    for (LoopReport& loop : piece.map.loops) {
        mesh.name_loop(loop.vertices);
        mesh.name_vertices(loop.off_circle);
    }
    for (Index* vertex : {&piece.map.center, &piece.map.point}) mesh.name_vertex(*vertex);
    mesh.name_report(piece.map);
}

void name_pieces(const CanonicalMesh& mesh, CutUniformizeResult& result)
{
    for (MappedPiece& piece : result.pieces) name_piece(mesh, piece);
    for (SurfaceCut& cut : result.cuts) {
        mesh.name_path(cut.vertices);
        if (cut.kind == CutKind::bow_tie) std::ranges::sort(cut.vertices);
    }
    for (LeftOutFace& out : result.left_out) {
        mesh.name_face(out.face);
        mesh.name_face(out.like);
    }
    std::ranges::sort(result.left_out, {}, &LeftOutFace::face);
}

}  // namespace

CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                         const std::vector<Index>& polygon, const UniformizeOptions& options,
                                         ExecutionContext& context)
{
    const auto compute = [polygon, options](const CanonicalMesh& mesh, ExecutionContext& own) {
        return cut_map_and_pack(mesh, mesh.of_faces(polygon), canonical_options(mesh, options), own);
    };
    return corner_map<CutUniformizeResult>(vertices, triangles, context, compute, name_pieces);
}

CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                         const std::vector<Index>& polygon, const UniformizeOptions& options)
{
    ExecutionContext context;
    return uniformize_with_cuts(vertices, triangles, polygon, options, context);
}

}  // namespace koebe
