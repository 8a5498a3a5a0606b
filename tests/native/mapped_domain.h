// A flat circle domain, which is its own map.
#pragma once

#include "circle_domain.h"
#include "transfer/landmark_map.h"

namespace koebe::test {

inline MappedSurface mapped(const CircleDomain& domain)
{
    MappedSurface surface{lift(domain.points, Lift::plane), domain.triangles, {}, {}};
    surface.uv = surface.vertices.leftCols<2>();
    for (std::size_t k = 0; k < domain.loops.size(); ++k)
        surface.loops.push_back({{.vertices = domain.loops[k], .roundness = {}, .off_circle = {}}, domain.circles[k]});
    return surface;
}

}  // namespace koebe::test
