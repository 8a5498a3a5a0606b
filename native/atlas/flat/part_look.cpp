#include "flat/part_look.h"

#include "planar/planar_predicates.h"

namespace koebe {
namespace {

constexpr double dense = 4.0;  // times its own area: such a face wastes texels

}  // namespace

PartLook look_of(const FlatPart& flat)
{
    PartLook look;
    const VectorXd areas = face_areas(flat.vertices, flat.surface.triangles);
    for (Index f = 0; f < static_cast<Index>(areas.size()); ++f) {
        const double area = signed_area(flat.points, flat.surface.triangles, f);
        look.area += area;
        if (area > dense * areas[f]) look.wasted += area;
    }
    for (const VertexLoop& loop : flat.surface.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            look.length += (flat.points.row(loop[i]) - flat.points.row(loop[(i + 1) % loop.size()])).norm();
    return look;
}

}  // namespace koebe
