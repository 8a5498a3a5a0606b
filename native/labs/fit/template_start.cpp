#include "fit/template_start.h"

#include "planar/planar_predicates.h"
#include "shape/assignment.h"
#include "shape/domain_alignment.h"

#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr int most_rounds = 10;  // of alignment and assignment
constexpr int shares = 10;       // of an automorphism that are tried, each half of the one before

/// The inner loops at the least sum of squared differences of centres and radii. On straight ways between circles
/// assigned so, no centres meet.
std::vector<int> nearest_match(const std::vector<Circle>& wanted, const std::vector<Circle>& circles,
                               const ExecutionContext& context)
{
    const auto count = static_cast<Eigen::Index>(wanted.size()) - 1;
    MatrixXd cost(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < count; ++j)
            cost(i, j) = std::norm(wanted[i + 1].center - circles[j + 1].center) +
                         std::pow(wanted[i + 1].radius - circles[j + 1].radius, 2);
    std::vector<int> match{0};
    for (const int j : least_cost_assignment(cost, context)) match.push_back(j + 1);
    return match;
}

std::vector<Circle> images_of(const Moebius& map, const std::vector<Circle>& circles)
{
    std::vector<Circle> images{Circle{}};
    for (std::size_t k = 1; k < circles.size(); ++k) images.push_back(map(circles[k]));
    return images;
}

DomainAlignment best_alignment(const std::vector<Circle>& wanted, const std::vector<Circle>& domain,
                               const ExecutionContext& context)
{
    DomainAlignment best = align_domains(wanted, domain, {}, context);
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<int> match = nearest_match(wanted, images_of(best.map, domain), context);
        if (match == best.match) break;
        DomainAlignment next = align_domains(wanted, domain, std::move(match), context);
        if (next.residual >= best.residual) break;
        best = std::move(next);
    }
    return best;
}

std::size_t count_folded(const Triangles& triangles, const PlanarPoints& uv)
{
    std::size_t count = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (!(signed_area(uv, triangles, f) > 0.0)) ++count;
    return count;
}

PlanarPoints image_under(const Moebius& map, const PlanarPoints& uv)
{
    PlanarPoints result(uv.rows(), 2);
    for (Eigen::Index v = 0; v < uv.rows(); ++v) {
        const Complex z = map(Complex(uv(v, 0), uv(v, 1)));
        result.row(v) << z.real(), z.imag();
    }
    return result;
}

/// The same turn, and a share of the hyperbolic way.
Moebius share_of(const Moebius& map, double share)
{
    const double length = std::abs(map.a);
    const Complex a = length > 0.0 ? std::tanh(share * std::atanh(length)) / length * map.a : Complex(0.0);
    return {a, map.turn};
}

}  // namespace

TemplateStart lay_over_template(const std::vector<Circle>& domain, const std::vector<Circle>& wanted,
                                std::vector<int> match, const Triangles& triangles, const PlanarPoints& uv,
                                const ExecutionContext& context)
{
    TemplateStart start{{0}, domain, uv};
    if (wanted.size() < 2) return start;
    const DomainAlignment alignment = match.empty() ? best_alignment(wanted, domain, context)
                                                    : align_domains(wanted, domain, std::move(match), context);
    start.match = alignment.match;
    const std::size_t most = count_folded(triangles, uv);
    double share = 1.0;
    for (int i = 0; i <= shares; ++i, share = i == shares ? 0.0 : 0.5 * share) {
        const Moebius map = share_of(alignment.map, share);
        start.uv = image_under(map, uv);
        start.circles = images_of(map, domain);
        if (count_folded(triangles, start.uv) <= most) break;
    }
    return start;
}

}  // namespace koebe
