#include "report/fit_json.h"

#include "report/json.h"

namespace koebe {
namespace {

nlohmann::ordered_json mu_json(const FitBeltrami& mu)
{
    return {{"mean", mu.mean}, {"max", mu.max}, {"l2", mu.root_mean_square}, {"dilatation", mu.dilatation}};
}

}  // namespace

nlohmann::ordered_json to_json(const FitResult& result)
{
    nlohmann::ordered_json report = to_json(static_cast<const UniformizeResult&>(result));
    for (std::size_t k = 0; k < result.loops.size(); ++k) {
        report["loops"][k]["rank"] = result.ranks[k];
        if (k > 0 && !result.names.empty()) report["loops"][k]["name"] = result.names[k - 1];
    }
    report["fit"] = {{"mu", mu_json(result.of_faces)}, {"bending", mu_json(result.bending)},
                     {"residual", result.residual},    {"path", result.straight ? "straight" : "bows"},
                     {"steps", result.bending_steps},  {"newton_steps", result.newton_steps}};
    return report;
}

}  // namespace koebe
