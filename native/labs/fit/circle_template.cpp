#include "fit/circle_template.h"

#include "core/counted.h"
#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace koebe {
namespace {

void require_one_for_each(std::size_t count, std::size_t circles, const char* things)
{
    if (count != 0 && count != circles)
        throw InputError("the template has " + counted(circles, "circle") + " and " + std::to_string(count) + " " +
                         things);
}

void require_round(const std::vector<Circle>& circles, std::size_t k)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError("circle " + std::to_string(k) + " of the template " + why, ElementKind::loops,
                         {static_cast<Index>(k)});
    };
    const Circle& circle = circles[k];
    if (!std::isfinite(circle.center.real()) || !std::isfinite(circle.center.imag()) || !std::isfinite(circle.radius))
        refuse("is not finite");
    if (!(circle.radius >= least_template_gap))
        refuse("has the radius " + formatted("%.3g", circle.radius) + ": at least 1e-6 is needed");
    if (!(std::abs(circle.center) + circle.radius <= 1.0 - least_template_gap))
        refuse("is not inside the unit circle: the gap must be at least 1e-6");
}

void require_finite_pin(const TemplateRim& rim)
{
    if (rim.pin && !std::isfinite(rim.pin->angle)) throw InputError("the angle of a pinned vertex is not finite");
}

}  // namespace

void require_feasible(const CircleTemplate& wanted)
{
    const std::size_t count = wanted.circles.size();
    require_one_for_each(wanted.names.size(), count, "names");
    require_one_for_each(wanted.loops.size(), count, "loops");
    require_one_for_each(wanted.rims.size(), count, "rims");
    for (std::size_t k = 0; k < count; ++k) require_round(wanted.circles, k);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t j = k + 1; j < count; ++j) {
            const Circle &a = wanted.circles[k], &b = wanted.circles[j];
            if (!(std::abs(a.center - b.center) - a.radius - b.radius >= least_template_gap))
                throw InputError("circles " + std::to_string(k) + " and " + std::to_string(j) +
                                     " of the template meet: the gap must be at least 1e-6",
                                 ElementKind::loops, {static_cast<Index>(k), static_cast<Index>(j)});
        }
    std::set<int> named;
    for (const int loop : wanted.loops)
        if (!named.insert(loop).second)
            throw InputError("two circles of the template name the same loop", ElementKind::loops, {loop});
    require_finite_pin(wanted.outer);
    for (const TemplateRim& rim : wanted.rims) require_finite_pin(rim);
}

}  // namespace koebe
