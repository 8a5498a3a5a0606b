#include "transfer/correspondence.h"

#include "bending/bend_between.h"
#include "circles/same_circles.h"
#include "core/complex_places.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/uv_resolution.h"
#include "quality/distortion.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"
#include "surface/harmonic_map.h"
#include "transfer/compact_domain.h"
#include "transfer/landmark_alignment.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

std::vector<Circle> circles_of(const std::vector<LoopReport>& loops)
{
    std::vector<Circle> circles;
    for (const LoopReport& loop : loops) circles.push_back(loop.circle);
    return circles;
}

VectorXcd complex(const PlanarPoints& points) { return points.col(0) + Complex(0.0, 1.0) * points.col(1); }

PlanarPoints planar(const VectorXcd& z)
{
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

/// Vertices of all rims, and the displacement of each.
struct Rims {
    std::vector<Index> vertices;
    VectorXcd way;
};

/// Each rim is moved and scaled with its circle.
Rims rims_to_move(const CompactDomain& domain, const std::vector<Circle>& from, const std::vector<Circle>& to,
                  const PlanarPoints& uv)
{
    Rims rims;
    std::vector<Complex> way;
    for (std::size_t k = 0; k < to.size(); ++k)
        for (const Index v : domain.loops[k]) {
            if (k > 0 && std::ranges::binary_search(domain.off_circle, v)) continue;
            const Complex here = complex_at(uv, v);
            rims.vertices.push_back(v);
            way.push_back(to[k].center + (here - from[k].center) * (to[k].radius / from[k].radius) - here);
        }
    rims.way = Eigen::Map<const VectorXcd>(way.data(), static_cast<Eigen::Index>(way.size()));
    return rims;
}

/// Moves the rims in steps; the inside follows by the harmonic displacement of the present domain. A step that turns
/// faces over is halved. Fast, but gives up where tubes make the faces around a hole large.
std::optional<PlanarPoints> moved_harmonically(const CompactDomain& domain, const std::vector<Circle>& from,
                                               const std::vector<Circle>& to, const PlanarPoints& uv,
                                               const ExecutionContext& context)
{
    constexpr double shortest_step = 1.0 / 32.0;  // of the way
    const Triangles& triangles = domain.surface.triangles;
    const Rims rims = rims_to_move(domain, from, to, uv);
    const std::size_t flipped = flipped_faces(triangles, uv).size();
    VectorXcd now = complex(uv);
    for (double reached = 0.0, step = 1.0; reached < 1.0;) {
        context.checkpoint();
        const double share = std::min(step, 1.0 - reached);
        PlanarPoints bent = planar(now + harmonic_map(triangles, edge_lengths(planar(now), triangles),
                                                      static_cast<Index>(uv.rows()), rims.vertices, share * rims.way));
        if (bent.allFinite() && flipped_faces(triangles, bent).size() <= flipped) {
            now = complex(bent);
            reached += share;
        } else if ((step = 0.5 * share) < shortest_step) {
            return {};
        }
    }
    return planar(now);
}

}  // namespace

std::optional<PlanarPoints> with_fitted_holes(const std::vector<Circle>& source, const MappedSurface& target,
                                              const DomainAlignment& alignment, const PlanarPoints& uv,
                                              ExecutionContext& context)
{
    const CompactDomain domain = compact(target);
    const PlanarPoints aligned = uv(domain.original, Eigen::all);
    std::vector<Circle> from(source.size()), to(source.size());
    for (std::size_t k = 1; k < source.size(); ++k) {
        const auto own = static_cast<std::size_t>(alignment.match[k]);
        from[own] = alignment.map(domain.circles[own]);
        to[own] = source[k];
    }
    if (same_circles(from, to)) return uv;
    // The least distortion is found from a map that is near it, or along the way of the circles. It takes 0.2 ms a
    // face.
    constexpr Eigen::Index most_faces = 20000;  // beyond, a harmonic map stays as it is
    std::optional<PlanarPoints> fitted = moved_harmonically(domain, from, to, aligned, context);
    if (fitted && domain.surface.triangles.rows() > most_faces) {
        PlanarPoints moved = uv;
        moved(domain.original, Eigen::all) = *fitted;
        return moved;
    }
    const BendingInput input{domain.surface.triangles,
                             domain.loops,
                             domain.off_circle,
                             aligned,
                             fitted.value_or(aligned),
                             domain.areas,
                             std::vector<TemplateRim>(source.size())};
    BendingResult bent = bend_between(input, fitted ? to : from, to, {}, context);
    if (bent.arrived) fitted = std::move(bent.uv);
    if (!fitted) return {};
    PlanarPoints result = uv;
    result(domain.original, Eigen::all) = *fitted;
    return result;
}

namespace {

/// Places of landmarks in the two domains, the target's as it is.
struct LandmarkPlaces {
    std::vector<SurfacePoint> on_target;
    VectorXcd now, wanted;
};

LandmarkPlaces landmark_places(const MappedSurface& source, const MappedSurface& target,
                               const std::vector<Landmark>& landmarks)
{
    const auto count = static_cast<Eigen::Index>(landmarks.size());
    LandmarkPlaces places{{}, VectorXcd(count), VectorXcd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const Landmark& landmark = landmarks[i];
        const Eigen::RowVector2d on_target = landmark.target.of(target.uv, target.triangles),
                                 on_source = landmark.source.of(source.uv, source.triangles);
        places.on_target.push_back(landmark.target);
        places.now[i] = Complex(on_target[0], on_target[1]);
        places.wanted[i] = Complex(on_source[0], on_source[1]);
    }
    return places;
}

LandmarkMap bent_to_landmarks(const MappedSurface& source, const MappedSurface& target, const Correspondence& found,
                              const PlanarPoints& aligned, const LandmarkPlaces& places, bool extremal,
                              ExecutionContext& context)
{
    std::vector<Circle> circles(target.loops.size());
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const std::size_t own = k == 0 ? 0 : found.alignment.match[k];
        circles[own] = found.fitted ? source.loops[k].circle : found.alignment.map(target.loops[own].circle);
    }
    return map_with_landmarks(target, circles, aligned, found.uv, places.on_target, places.wanted, extremal, context);
}

/// The warning that lists the holes of the source that the holes of the target do not reach.
Warning not_fitted(const DomainAlignment& alignment, const std::vector<Circle>& circles)
{
    Warning warning{WarningKind::not_fitted,
                    formatted("the holes could not be bent onto each other without turning faces over: they miss each "
                              "other by up to %.2g in the unit disk",
                              alignment.largest)};
    for (std::size_t k = 1; k < circles.size(); ++k)
        if (alignment.misses[k] > circle_tolerance) warning.elements.push_back(static_cast<Index>(k));
    return warning;
}

/// The warning that the loops may correspond otherwise.
Warning ambiguous_match(double margin)
{
    return {WarningKind::ambiguous_match,
            formatted("the loops may be matched wrongly: another match fits nearly as well (margin %.2g). Give the "
                      "match, or landmarks",
                      margin)};
}

/// Measures the distortion of the bending from the aligned domain, in the triangles in which it is linear.
void judge(Correspondence& result, const Triangles& linear, const CutMesh& mesh, const PlanarPoints& before,
           const PlanarPoints& uv)
{
    Vertices flat = Vertices::Zero(uv.rows(), 3);
    flat.leftCols<2>() = before;
    std::vector<Index> whole;
    const std::vector<Index> lost = folded_faces(linear, before);
    for (Index f = 0; f < static_cast<Index>(linear.rows()); ++f)
        if (!std::ranges::binary_search(lost, f)) whole.push_back(f);
    result.beltrami = measure_distortion(flat, linear(whole, Eigen::all), uv).beltrami;
    const std::vector<Index> folded = folded_faces(mesh.triangles, before);
    result.folded = static_cast<std::size_t>(std::ranges::count_if(
        folded_faces(mesh.triangles, uv), [&](Index f) { return !std::ranges::binary_search(folded, f); }));
}

/// Looks up the source's vertices in the target.
void look_up(Correspondence& result, const MappedSurface& source, const MappedSurface& target, const CutMesh& mesh,
             const PlanarPoints& uv)
{
    result.places = nearest_triangles(uv, mesh.triangles, source.uv);
    result.points.resize(source.uv.rows(), 3);
    for (Eigen::Index v = 0; v < source.uv.rows(); ++v) {
        if (!mesh.face.empty()) {
            const SurfacePoint whole = mesh.on_mesh(result.places.face[v], result.places.weights.row(v),
                                                    target.triangles, static_cast<Index>(target.uv.rows()));
            result.places.face[v] = whole.face;
            result.places.weights.row(v) = whole.weights;
        }
        result.points.row(v) =
            result.places.weights.row(v) * target.vertices(target.triangles.row(result.places.face[v]), Eigen::all);
    }
}

}  // namespace

Correspondence correspond(const MappedSurface& source, const MappedSurface& target,
                          const CorrespondenceOptions& options, ExecutionContext& context)
{
    const bool has_landmarks = !options.landmarks.empty();
    context.begin_stage("align", 0.0, 0.1);
    require_own_circles(source.loops);
    require_own_circles(target.loops);
    const std::vector<Circle> circles = circles_of(source.loops);
    Correspondence result;
    const LandmarkPlaces places = landmark_places(source, target, options.landmarks);
    const std::vector<Circle> others = circles_of(target.loops);
    result.alignment = options.match.empty() ? align_by_landmarks(circles, others, places.now, places.wanted, context)
                                             : align_domains(circles, others, options.match, context);
    if (result.alignment.margin < ambiguous_margin) result.warnings.push_back(ambiguous_match(result.alignment.margin));
    const AlignedDomain aligned =
        lay_by_landmarks(target.triangles, target.uv, circles, places.now, places.wanted, result.alignment.map);
    result.uv = aligned.uv;
    if (options.fit_holes && circles.size() > 1) {
        context.begin_stage("fit", 0.1, has_landmarks ? 0.3 : 0.9);
        try {
            std::optional<PlanarPoints> bent = with_fitted_holes(circles, target, result.alignment, result.uv, context);
            result.fitted = bent.has_value();
            if (bent) result.uv = std::move(*bent);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {  // only aligned, and `fitted` is false
        }
        if (!result.fitted) result.warnings.push_back(not_fitted(result.alignment, circles));
    }
    CutMesh mesh{target.triangles, {}, {}, {}};
    Triangles linear = target.triangles;
    PlanarPoints uv = result.uv;
    if (has_landmarks) {
        context.begin_stage("landmarks", 0.3, 0.9);
        LandmarkMap map =
            bent_to_landmarks(source, target, result, aligned.undistorted, places, options.extremal, context);
        mesh = std::move(map.mesh);
        linear = std::move(map.triangles);
        uv = std::move(map.uv);
        result.uv = uv.topRows(target.uv.rows());
    }
    context.begin_stage("finish", 0.9, 1.0);
    judge(result, linear, mesh, mesh.extended(aligned.undistorted, target.triangles), uv);
    look_up(result, source, target, mesh, uv);
    context.advance(1.0);
    return result;
}

}  // namespace koebe
