// Edge lengths without a surface in space: mollified, and flipped to intrinsic Delaunay.
#pragma once

#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <optional>
#include <vector>

namespace koebe {

struct IntrinsicMetricOptions {
    bool mollify = true;
    bool delaunay = true;
    double margin = 1e-6;  ///< of the mean edge length: by how much a + b > c must hold (Sharp and Crane 2020)
};

/// A triangulation of the same vertices by geodesics, given by its edge lengths.
struct IntrinsicMetric {
    Triangles triangles;
    EdgeLengths lengths;
    std::vector<Index> twin;     ///< (3F) opposite half-edges: flips may leave two edges between the same vertices
    double mollification = 0.0;  ///< added to every edge length, in the unit of the positions
    std::vector<Index> flips;    ///< the half-edges that were flipped, one after the other
};

/// The surface's metric, made safe for a Laplacian with nonnegative weights inside.
///
/// Mollification adds one length to every edge so that each triangle inequality holds with a margin (Sharp and
/// Crane 2020, section 4.5). Flips make opposite angles of every edge sum to at most pi (Fisher et al. 2006;
/// Bobenko and Springborn 2007), but for those whose new edge would join two vertices of one boundary loop: it would
/// take the flux from the vertices between (docs/numerics.md, "The metric").
/// @param carried closed 1-forms, one number per half-edge of the surface (one_form.h): those of the result's
/// half-edges
IntrinsicMetric intrinsic_metric(const Vertices& vertices, const Surface& surface,
                                 const IntrinsicMetricOptions& options = {}, std::vector<VectorXd>* carried = nullptr);

/// The metric with the vertices elsewhere, triangulated by the flips of another: so a matrix of its edges has the same
/// pattern. Nothing where a flip is impossible now, or an edge is far from Delaunay: the cotangents opposite to it of a
/// sum below -0.2.
/// @param last of the same surface with its vertices elsewhere, by the same options
/// @param halves of the result's lengths: half_cotangents, which are found on the way
std::optional<IntrinsicMetric> metric_with_flips_of(const IntrinsicMetric& last, const Vertices& vertices,
                                                    const Surface& surface, EdgeLengths* halves = nullptr,
                                                    const IntrinsicMetricOptions& options = {});

}  // namespace koebe
