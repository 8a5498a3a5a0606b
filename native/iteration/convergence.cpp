#include "iteration/convergence.h"

#include "circles/circle_fit.h"

#include <cmath>

namespace koebe {

CircleState circle_state(const std::vector<VectorXcd>& images, Circle (*fit)(const VectorXcd&))
{
    CircleState state;
    for (const VectorXcd& image : images) {
        state.circles.push_back(fit(image));
        state.mean_roundness += roundness(image, state.circles.back()) / static_cast<double>(images.size());
    }
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

}  // namespace koebe
