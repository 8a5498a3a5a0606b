#include "surface/intrinsic_metric.h"

#include "core/connectivity.h"
#include "execution/thread_share.h"
#include "surface/edge_flip.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

double mollify(EdgeLengths& lengths, double margin)
{
    const double least = margin * lengths.mean();
    constexpr std::size_t at_a_time = 32768;
    const std::size_t faces = static_cast<std::size_t>(lengths.rows());
    std::vector<double> most((faces + at_a_time - 1) / at_a_time, 0.0);
    in_pieces(faces, at_a_time, [&](std::size_t begin, std::size_t end) {
        double added = 0.0;
        for (Eigen::Index f = static_cast<Eigen::Index>(begin); f < static_cast<Eigen::Index>(end); ++f)
            for (int k = 0; k < 3; ++k) {
                const double excess = lengths(f, (k + 1) % 3) + lengths(f, (k + 2) % 3) - lengths(f, k);
                added = std::max(added, least - excess);
            }
        most[begin / at_a_time] = added;
    });
    const double added = most.empty() ? 0.0 : *std::max_element(most.begin(), most.end());
    if (added > 0.0) lengths.array() += added;
    return added;
}

/// The state of Lawson's algorithm: half-edge 3 f + k is edge k of face f.
class DelaunayFlipper {
public:
    DelaunayFlipper(IntrinsicMetric& metric, const Surface& surface, std::vector<VectorXd>* carried)
        : triangles_(metric.triangles),
          lengths_(metric.lengths),
          twin_(metric.twin),
          flips_(metric.flips),
          carried_(carried),
          loop_of_(surface.vertex_count, -1)
    {
        for (std::size_t k = 0; k < surface.loops.size(); ++k)
            for (const Index v : surface.loops[k]) loop_of_[v] = static_cast<Index>(k);
    }

    void run()
    {
        const Index halfedge_count = static_cast<Index>(twin_.size());
        const EdgeLengths halves = half_cotangents(lengths_);
        std::vector<Index> stack = found_in_pieces(halfedge_count, [&](Index h) {
            return twin_[h] > h && -2.0 * (halves.data()[h] + halves.data()[twin_[h]]) > tolerance;
        });
        // Lawson's algorithm ends; the bound only guards against round-off on cocircular quadrilaterals.
        const std::size_t most = 20 * twin_.size() + 1000;
        while (!stack.empty() && flips_.size() < most) {
            const Index h = stack.back();
            stack.pop_back();
            if (twin_[h] == no_twin || excess(h) <= tolerance || !may_flip(h)) continue;
            const Index f = face_of(h), g = face_of(twin_[h]);
            carry(h);
            flip(h);
            for (const Index face : {f, g})
                for (Index e = 3 * face; e < 3 * face + 3; ++e)
                    if (twin_[e] != no_twin) stack.push_back(e);
        }
    }

    /// Flips the same edges. @return whether all could be
    bool repeat(const std::vector<Index>& flips)
    {
        for (const Index h : flips) {
            if (!crosses_edge(h)) return false;
            flip(h);
        }
        return true;
    }

    /// Whether no edge that may be flipped is far from Delaunay. @param halves half_cotangents of the lengths
    bool nearly_delaunay(const EdgeLengths& halves) const
    {
        const double* half = halves.data();
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
            if (twin_[h] > h && -2.0 * (half[h] + half[twin_[h]]) > most_excess && may_flip(h)) return false;
        return true;
    }

private:
    static constexpr double tolerance = 1e-9;   // on the sum of cotangents, dimensionless
    static constexpr double most_excess = 0.2;  // of a triangulation that may be kept

    void flip(Index h)
    {
        flip_edge(triangles_, lengths_, twin_, h, std::abs(opposite_diagonal(h)));
        flips_.push_back(h);
    }

    double length(Index h) const { return lengths_.data()[h]; }

    /// Computes the forms on the edges of the two new faces of flip_edge: d-c, c-a, a-d and c-d, d-b, b-c.
    void carry(Index h)
    {
        if (carried_ == nullptr) return;
        const Index t = twin_[h], f = 3 * face_of(h), g = 3 * face_of(t);
        for (VectorXd& form : *carried_) {
            const double bc = form[next_halfedge(h)], ca = form[previous_halfedge(h)];
            const double ad = form[next_halfedge(t)], db = form[previous_halfedge(t)];
            form.segment<3>(f) << db + bc, ca, ad;
            form.segment<3>(g) << -(db + bc), db, bc;
        }
    }

    double cotangent(Index h) const
    {
        const double a = length(h), b = length(next_halfedge(h)), c = length(previous_halfedge(h));
        const double area = triangle_area(a, b, c);
        return (b * b + c * c - a * a) / (4.0 * std::max(area, 1e-300));
    }

    /// -(cot alpha + cot beta): positive where the edge is not Delaunay.
    double excess(Index h) const { return -(cotangent(h) + cotangent(twin_[h])); }

    bool may_flip(Index h) const
    {
        const Index c = origin(triangles_, previous_halfedge(h));
        const Index d = origin(triangles_, previous_halfedge(twin_[h]));
        return c != d && face_of(h) != face_of(twin_[h]) && (loop_of_[c] < 0 || loop_of_[c] != loop_of_[d]);
    }

    /// The apex of a triangle whose edge starts at 0 and lies along the real axis.
    Complex apex(double edge, double from_start, double from_end) const
    {
        const double x = (edge * edge + from_start * from_start - from_end * from_end) / (2.0 * edge);
        return {x, 2.0 * triangle_area(edge, from_start, from_end) / edge};
    }

    Complex above(Index h) const { return apex(length(h), length(previous_halfedge(h)), length(next_halfedge(h))); }
    Complex below(Index h) const
    {
        const Index t = twin_[h];
        return std::conj(apex(length(h), length(next_halfedge(t)), length(previous_halfedge(t))));
    }

    /// The vector from d to c, with the two triangles unfolded into the plane.
    Complex opposite_diagonal(Index h) const { return above(h) - below(h); }

    /// Whether d-c crosses the edge between its ends. Otherwise d-c is not a geodesic of the two triangles.
    bool crosses_edge(Index h) const
    {
        if (twin_[h] == no_twin || !may_flip(h)) return false;
        const Complex c = above(h), d = below(h);
        const double at = (c.real() * -d.imag() + d.real() * c.imag()) / (c.imag() - d.imag());
        return at > 0.0 && at < length(h);
    }

    Triangles& triangles_;
    EdgeLengths& lengths_;
    std::vector<Index>& twin_;
    std::vector<Index>& flips_;
    std::vector<VectorXd>* carried_;
    std::vector<Index> loop_of_;
};

/// The mesh's metric before any flip.
IntrinsicMetric metric_of_mesh(const Vertices& vertices, const Surface& surface, const IntrinsicMetricOptions& options)
{
    IntrinsicMetric metric;
    metric.triangles = surface.triangles;
    metric.lengths = edge_lengths(vertices, surface.triangles);
    metric.twin = surface.twin;
    metric.mollification = mollify(metric.lengths, options.margin);
    return metric;
}

}  // namespace

IntrinsicMetric intrinsic_metric(const Vertices& vertices, const Surface& surface,
                                 const IntrinsicMetricOptions& options, std::vector<VectorXd>* carried)
{
    IntrinsicMetric metric = metric_of_mesh(vertices, surface, options);
    if (options.delaunay) DelaunayFlipper(metric, surface, carried).run();
    return metric;
}

std::optional<IntrinsicMetric> metric_with_flips_of(const IntrinsicMetric& last, const Vertices& vertices,
                                                    const Surface& surface, EdgeLengths* halves,
                                                    const IntrinsicMetricOptions& options)
{
    IntrinsicMetric metric = metric_of_mesh(vertices, surface, options);
    DelaunayFlipper flipper(metric, surface, nullptr);
    if (!flipper.repeat(last.flips)) return {};
    EdgeLengths own = half_cotangents(metric.lengths);
    if (!flipper.nearly_delaunay(own)) return {};
    if (halves != nullptr) *halves = std::move(own);
    return metric;
}

}  // namespace koebe
