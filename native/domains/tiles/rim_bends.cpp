#include "tiles/rim_bends.h"

#include "core/connectivity.h"
#include "core/uv_resolution.h"
#include "tiles/tile.h"

#include <algorithm>
#include <cmath>

namespace koebe {

void bend_rims(const PeriodicSurface& domain, VectorXcd& places, FlatMap& map)
{
    constexpr double arc = 0.7, deepest = 0.25;  // depth over the squared width, and over the width
    constexpr double steps = 32.0;               // grid steps between neighbours
    const Triangles& triangles = domain.surface.triangles;
    const double height = places[domain.loops[1].front()].imag();
    VectorXd depth = VectorXd::Zero(domain.surface.vertex_count);
    for (int rim = 0; rim < 2; ++rim) {
        const VertexLoop& loop = domain.loops[rim];
        const Index n = static_cast<Index>(loop.size());
        std::vector<Index> place(domain.surface.vertex_count, -1);
        for (Index b = 0; b < n; ++b) place[loop[b]] = b;
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            const Index a = origin(triangles, h), b = target(triangles, h);
            if (domain.surface.twin[h] == no_twin || place[a] < 0 || place[b] < 0) continue;
            const double width = places[b].real() - places[a].real() + domain.shifts[0][h];
            if (rim == 0 ? width <= 0.0 : width >= 0.0) continue;  // its twin looks along the rim
            double thinnest = std::abs(width);
            std::vector<double> along;  // from a to b on the rim
            for (Index i = place[a]; i != place[b]; i = (i + 1) % n) {
                along.push_back(std::abs(std::remainder(places[loop[i]].real() - places[a].real(), 1.0)));
                if (along.size() > 1 && along.back() < along[along.size() - 2])
                    along.back() = 1.0 - along.back();  // past half a turn
                const double step =
                    std::abs(std::remainder(places[loop[(i + 1) % n]].real() - places[loop[i]].real(), 1.0));
                if (step > 0.0) thinnest = std::min(thinnest, step);
            }
            const double w = std::abs(width), grid = uv_grid * std::max(1.0, height);
            const double bend = std::min(std::max(arc, steps * grid / (thinnest * thinnest)), deepest / w);
            along.push_back(w);
            for (std::size_t i = 0; i < along.size(); ++i) {
                double& own = depth[loop[(place[a] + static_cast<Index>(i)) % n]];
                own = std::max(own, bend * (2.0 * along[i] - w) * (2.0 * along[i] - w));
            }
        }
        for (const Index v : loop) {
            if (depth[v] == 0.0) continue;
            places[v] += Complex(0.0, rim == 0 ? depth[v] : -depth[v]);
            if (depth[v] > uv_resolution) map.off_circle.push_back(v);
        }
    }
    std::ranges::sort(map.off_circle);
}

}  // namespace koebe
