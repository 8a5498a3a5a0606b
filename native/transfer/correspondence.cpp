#include "transfer/correspondence.h"

#include "core/errors.h"
#include "quality/distortion.h"
#include "shape/conformal_module.h"
#include "surface/harmonic_map.h"

#include <algorithm>

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

/// Vertices of all rims, and the way that each has to go.
struct Rims {
    std::vector<Index> vertices;
    VectorXcd way;
};

/// The outer rim stays; the others are moved and scaled as their circles are.
Rims rims_to_move(const std::vector<Circle>& source, const MappedSurface& target, const DomainAlignment& alignment,
                  const PlanarPoints& uv)
{
    Rims rims{target.loops[0].vertices, {}};
    std::vector<Complex> way(rims.vertices.size(), 0.0);
    for (std::size_t k = 1; k < source.size(); ++k) {
        const LoopReport& loop = target.loops[alignment.match[k]];
        const Circle now = alignment.map(loop.circle);
        for (const Index v : loop.vertices) {
            if (std::ranges::binary_search(loop.off_circle, v)) continue;
            const Complex here(uv(v, 0), uv(v, 1));
            rims.vertices.push_back(v);
            way.push_back(source[k].center + (here - now.center) * (source[k].radius / now.radius) - here);
        }
    }
    rims.way = Eigen::Map<const VectorXcd>(way.data(), static_cast<Eigen::Index>(way.size()));
    return rims;
}

}  // namespace

std::optional<PlanarPoints> with_fitted_holes(const std::vector<Circle>& source, const MappedSurface& target,
                                              const DomainAlignment& alignment, const PlanarPoints& uv,
                                              const ExecutionContext& context)
{
    constexpr double shortest_step = 1.0 / 256.0;
    const Index vertex_count = static_cast<Index>(uv.rows());
    const Rims rims = rims_to_move(source, target, alignment, uv);
    const std::size_t flipped = flipped_faces(target.triangles, uv).size();
    VectorXcd now = complex(uv);
    for (double reached = 0.0, step = 1.0; reached < 1.0;) {
        context.checkpoint();
        const double share = std::min(step, 1.0 - reached);
        PlanarPoints bent = planar(now + harmonic_map(target.triangles, edge_lengths(planar(now), target.triangles),
                                                      vertex_count, rims.vertices, share * rims.way));
        if (bent.allFinite() && flipped_faces(target.triangles, bent).size() <= flipped) {
            now = complex(bent);
            reached += share;
        } else if ((step = 0.5 * share) < shortest_step) {
            return {};
        }
    }
    return planar(now);
}

namespace {

LandmarkMap bent_to_landmarks(const MappedSurface& source, const MappedSurface& target, const Correspondence& found,
                              const PlanarPoints& aligned, const std::vector<Landmark>& landmarks,
                              const ExecutionContext& context)
{
    std::vector<Circle> circles(target.loops.size());
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const std::size_t own = k == 0 ? 0 : found.alignment.match[k];
        circles[own] = found.fitted ? source.loops[k].circle : found.alignment.map(target.loops[own].circle);
    }
    std::vector<SurfacePoint> points;
    VectorXcd places(static_cast<Eigen::Index>(landmarks.size()));
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        points.push_back(landmarks[i].target);
        const Eigen::RowVector2d place = landmarks[i].source.of(source.uv, source.triangles);
        places[static_cast<Eigen::Index>(i)] = Complex(place[0], place[1]);
    }
    return map_with_landmarks(target, circles, aligned, found.uv, points, places, context);
}

/// What the bending has done to the aligned domain.
void judge(Correspondence& result, const MappedSurface& target, const CutMesh& mesh, const PlanarPoints& aligned,
           const PlanarPoints& uv)
{
    Vertices flat = Vertices::Zero(uv.rows(), 3);
    const PlanarPoints before = mesh.extended(aligned, target.triangles);
    flat.leftCols<2>() = before;
    result.beltrami = measure_distortion(flat, mesh.triangles, uv).beltrami;
    const std::vector<Index> lost = folded_faces(mesh.triangles, before), now = folded_faces(mesh.triangles, uv);
    result.folded = static_cast<std::size_t>(
        std::ranges::count_if(now, [&](Index f) { return !std::ranges::binary_search(lost, f); }));
}

/// Where the source's vertices lie.
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
                          const CorrespondenceOptions& options, const ExecutionContext& context)
{
    require_own_circles(source.loops);
    require_own_circles(target.loops);
    const std::vector<Circle> circles = circles_of(source.loops);
    Correspondence result;
    result.alignment = align_domains(circles, circles_of(target.loops), options.match, context);
    const VectorXcd aligned = result.alignment.map(complex(target.uv));
    result.uv = planar(aligned);
    if (options.fit_holes && circles.size() > 1) {
        try {
            std::optional<PlanarPoints> bent = with_fitted_holes(circles, target, result.alignment, result.uv, context);
            result.fitted = bent.has_value();
            if (bent) result.uv = std::move(*bent);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {  // aligned only, as `fitted` says
        }
    }
    CutMesh mesh{target.triangles, {}, {}, {}};
    PlanarPoints uv = result.uv;
    if (!options.landmarks.empty()) {
        LandmarkMap map = bent_to_landmarks(source, target, result, planar(aligned), options.landmarks, context);
        mesh = std::move(map.mesh);
        uv = std::move(map.uv);
        result.uv = uv.topRows(target.uv.rows());
    }
    context.checkpoint();
    judge(result, target, mesh, planar(aligned), uv);
    look_up(result, source, target, mesh, uv);
    return result;
}

}  // namespace koebe
