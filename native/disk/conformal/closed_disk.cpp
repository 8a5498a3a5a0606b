#include "conformal/closed_disk.h"

#include "core/errors.h"

#include <string>
#include <vector>

namespace koebe {
namespace {

constexpr double rounding = 1e-9;  // disk units

}  // namespace

void require_in_closed_disk(const VectorXcd& positions)
{
    if (!positions.allFinite()) throw SolverError("the map has positions that are not finite");
    std::vector<Index> outside;
    for (Eigen::Index v = 0; v < positions.size(); ++v)
        if (std::abs(positions[v]) > 1.0 + rounding) outside.push_back(static_cast<Index>(v));
    if (!outside.empty())
        throw SolverError("the map takes " + std::to_string(outside.size()) +
                              " vertices out of the unit disk: faces round them are too obtuse (vertices listed)",
                          ElementKind::vertices, outside);
}

}  // namespace koebe
