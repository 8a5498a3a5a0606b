// A metric given by edge lengths alone, mollified and flipped to intrinsic Delaunay.
#pragma once

#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <optional>
#include <vector>

namespace koebe {

struct IntrinsicMetricOptions {
    bool delaunay = true;
    double margin = 1e-6;  ///< a + b > c must hold by this much, in mean edge lengths (Sharp and Crane 2020)
};

/// A triangulation of the surface's vertices by geodesics, given by their lengths.
struct IntrinsicMetric {
    Triangles triangles;
    EdgeLengths lengths;
    std::vector<Index> twin;     ///< (3F) opposite half-edges: flips may leave two edges between the same vertices
    double mollification = 0.0;  ///< added to every edge length, in the unit of the positions
    std::vector<Index> flips;    ///< the flipped half-edges, in the order of the flips
};

/// Makes the surface's metric safe for a Laplacian whose weights inside are not negative, but where a flip is left out.
///
/// Mollification adds one length to every edge so that each triangle inequality holds with a margin (Sharp and Crane
/// 2020, section 4.5). Flips make opposite angles of every edge sum to at most pi (Fisher et al. 2006; Bobenko and
/// Springborn 2007). A flip is left out if its new edge would join two vertices of one boundary loop: it would take the
/// flux from the vertices between (docs/numerics.md, "The metric").
/// @param carried in: closed 1-forms on the surface's half-edges (one_form.h); out: on the result's half-edges
IntrinsicMetric intrinsic_metric(const Vertices& vertices, const Surface& surface,
                                 const IntrinsicMetricOptions& options = {}, std::vector<VectorXd>* carried = nullptr);

/// Repeats the flips of an earlier metric after the vertices have moved, so that matrices of the edges keep their
/// pattern. Returns nothing where a flip is no longer possible, or where an edge is far from Delaunay: its opposite
/// cotangents have a sum below -0.2.
/// @param last of the same surface with other positions, by the same options
/// @param halves out: half_cotangents of the result's lengths
std::optional<IntrinsicMetric> metric_with_flips_of(const IntrinsicMetric& last, const Vertices& vertices,
                                                    const Surface& surface, EdgeLengths* halves = nullptr,
                                                    const IntrinsicMetricOptions& options = {});

}  // namespace koebe
