#include "quality/verdict.h"

#include "execution/thread_share.h"
#include "quality/stored_uv.h"

#include <array>
#include <utility>

namespace koebe {
namespace {

/// Sums of the verdict over some faces.
struct VerdictSums {
    AngleSums angles;
    double area = 0.0, lost = 0.0;
    std::vector<Index> flipped, below_resolution;

    void add(Index f, const StoredFace& stored, bool mapped, const FlatTriangle& flat)
    {
        area += flat.area();
        if (!mapped) {
            if (!(stored.area() != 0.0)) lost += flat.area();
            return;
        }
        if (stored.flipped()) {
            lost += flat.area();
            flipped.push_back(f);
            if (stored.below_resolution()) below_resolution.push_back(f);
        }
        if (flat.has_angles())
            angles.add(angle_errors(flat, stored.b.u - stored.a.u, stored.b.v - stored.a.v, stored.c.u - stored.a.u,
                                    stored.c.v - stored.a.v));
    }
};

std::vector<char> mask_of(const std::vector<Index>& faces, Eigen::Index count)
{
    std::vector<char> mask(static_cast<std::size_t>(count), 0);
    for (const Index f : faces) mask[static_cast<std::size_t>(f)] = 1;
    return mask;
}

/// @param point the StoredPoint of a face's corner
template <class Point>
Verdict judge_faces(const Vertices& vertices, const Triangles& triangles, const Point& point,
                    const std::vector<Index>& turned, const std::vector<Index>& left_out)
{
    constexpr std::size_t at_a_time = 65536;
    const std::size_t faces = static_cast<std::size_t>(triangles.rows());
    const FlatFaces flat(vertices, triangles);
    const std::vector<char> is_turned = mask_of(turned, triangles.rows()), is_out = mask_of(left_out, triangles.rows());
    std::vector<VerdictSums> parts((faces + at_a_time - 1) / at_a_time);
    in_pieces(faces, at_a_time, [&](std::size_t begin, std::size_t end) {
        VerdictSums sums;
        for (std::size_t f = begin; f < end; ++f) {
            const Index own = static_cast<Index>(f);
            const std::array<int, 3> order = is_turned[f] != 0 ? std::array{0, 2, 1} : std::array{0, 1, 2};
            const StoredFace stored(point(own, order[0]), point(own, order[1]), point(own, order[2]));
            sums.add(own, stored, is_out[f] == 0, flat(own, order));
        }
        parts[begin / at_a_time] = std::move(sums);
    });
    Verdict verdict;
    // Sums of fixed pieces, in their order: any number of threads gives the same last digits.
    VerdictSums all;
    for (const VerdictSums& part : parts) {
        all.angles.add(part.angles);
        all.area += part.area;
        all.lost += part.lost;
        verdict.flipped.insert(verdict.flipped.end(), part.flipped.begin(), part.flipped.end());
        verdict.below_resolution.insert(verdict.below_resolution.end(), part.below_resolution.begin(),
                                        part.below_resolution.end());
    }
    verdict.lost_area = all.area > 0.0 ? all.lost / all.area : 0.0;
    verdict.angle_error_stored_deg = all.angles.error();
    return verdict;
}

}  // namespace

Verdict judge_corners(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                      const std::vector<Index>& turned, const std::vector<Index>& left_out)
{
    const auto point = [&](Index f, int k) {
        return StoredPoint{as_stored(uv(3 * f + k, 0)), as_stored(uv(3 * f + k, 1))};
    };
    return judge_faces(vertices, triangles, point, turned, left_out);
}

Verdict judge_disk(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                   const std::vector<Index>& turned)
{
    const auto point = [&](Index f, int k) { return stored_point(points, triangles(f, k)); };
    return judge_faces(vertices, triangles, point, turned, {});
}

std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& points)
{
    return found_in_pieces(static_cast<Index>(triangles.rows()),
                           [&](Index f) { return StoredFace(triangles, points, f).flipped(); });
}

}  // namespace koebe
