// How large an outline may be beside the border of a sheet.
#pragma once

#include "lift/flat_sheet.h"

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace koebe {

/// The border's edges in the UVs, with their copies by the periods, in squares.
class BorderRoom {
public:
    /// @param cell width of the squares in the UVs, about that of an outline
    BorderRoom(const FlatSheet& sheet, double cell);

    /// Whether no border is nearer to a closed polygon than `bridge`, or inside it.
    bool fits(const std::vector<Complex>& polygon, double bridge) const;

    /// The largest scale at which a polygon fits: 1, or less in steps of a twentieth, down to 0.3. If none fits, 1.
    double largest_scale(const std::function<std::vector<Complex>(double scale)>& polygon, double bridge) const;

private:
    struct Edge {
        Complex a, b;
    };
    std::pair<long, long> square_of(Complex z) const;

    double cell_;
    std::map<std::pair<long, long>, std::vector<Edge>> squares_;
};

/// Whether a polygon runs round a point, by the crossings of a ray.
bool runs_round(const std::vector<Complex>& polygon, Complex z);

}  // namespace koebe
