#include "core/vertex_weights.h"

#include "core/errors.h"

namespace koebe {

void require_weights(const std::string& name, const std::vector<double>& weights, Index vertex_count)
{
    if (weights.empty()) return;
    if (weights.size() != static_cast<std::size_t>(vertex_count))
        throw InputError("there must be " + name + " for each vertex: " + std::to_string(vertex_count) + ", not " +
                         std::to_string(weights.size()));
    std::vector<Index> bad;
    for (Index v = 0; v < vertex_count; ++v)
        if (!is_weight(weights[v])) bad.push_back(v);
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " vertices have " + name + " that is not from 0 to 1",
                         ElementKind::vertices, bad);
}

}  // namespace koebe
