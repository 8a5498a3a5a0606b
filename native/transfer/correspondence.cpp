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

Correspondence correspond(const MappedSurface& source, const MappedSurface& target,
                          const CorrespondenceOptions& options, const ExecutionContext& context)
{
    require_own_circles(source.loops);
    require_own_circles(target.loops);
    const std::vector<Circle> circles = circles_of(source.loops);
    Correspondence result;
    result.alignment = align_domains(circles, circles_of(target.loops), options.match, context);
    result.uv = planar(result.alignment.map(complex(target.uv)));
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
    context.checkpoint();
    result.places = nearest_triangles(result.uv, target.triangles, source.uv);
    result.points.resize(source.uv.rows(), 3);
    for (Eigen::Index v = 0; v < source.uv.rows(); ++v)
        result.points.row(v) =
            result.places.weights.row(v) * target.vertices(target.triangles.row(result.places.face[v]), Eigen::all);
    return result;
}

}  // namespace koebe
