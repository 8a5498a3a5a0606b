#include "iteration/convergence.h"

#include <cmath>

namespace koebe {

CircleState circle_state(const std::vector<VectorXcd>& images)
{
    CircleState state;
    std::vector<Roundness> loops;
    for (const VectorXcd& image : images) {
        state.circles.push_back(fit_circle_least_squares(image));
        loops.push_back(roundness(image, state.circles.back()));
    }
    state.mean_roundness = mean_roundness(loops);
    return state;
}

double circle_change(const CircleState& before, const CircleState& after)
{
    double squares = 0.0;
    for (std::size_t k = 0; k < after.circles.size(); ++k) {
        const Circle old = before.circles.empty() ? Circle{{0.0, 0.0}, 0.0} : before.circles[k];
        const double radius_change = after.circles[k].radius - old.radius;
        squares += std::norm(after.circles[k].center - old.center) + radius_change * radius_change;
    }
    return std::sqrt(squares);
}

bool has_converged(const CircleState& before_sweep, const CircleState& after, double tolerance)
{
    return after.circles.size() == 2 || circle_change(before_sweep, after) < tolerance;
}

bool is_at_standstill(const std::vector<double>& changes)
{
    constexpr std::size_t patience = 10;  // rounds
    return changes.size() > patience && !(changes.back() < changes[changes.size() - 1 - patience]);
}

}  // namespace koebe
