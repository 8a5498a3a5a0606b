#include "quality/verdict.h"

#include "core/thread_share.h"
#include "quality/stored_uv.h"

#include <array>
#include <utility>

namespace koebe {
namespace {

/// A face in the order in which a reader goes round it.
struct ReadFace {
    StoredFace stored;
    std::array<int, 3> corners;
    bool mapped = true;
};

/// What some faces add to the verdict.
struct VerdictSums {
    AngleSums angles;
    double area = 0.0, lost = 0.0;
    std::vector<Index> flipped, below_resolution;

    void add(Index f, const ReadFace& face, const FlatTriangle& flat)
    {
        const StoredFace& stored = face.stored;
        area += flat.area();
        if (!face.mapped) {
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

/// @param read the ReadFace of a face
template <class Read>
Verdict judge_faces(const Vertices& vertices, const Triangles& triangles, const Read& read)
{
    constexpr std::size_t at_a_time = 65536;
    const std::size_t faces = static_cast<std::size_t>(triangles.rows());
    const FlatFaces flat(vertices, triangles);
    std::vector<VerdictSums> parts((faces + at_a_time - 1) / at_a_time);
    in_pieces(faces, at_a_time, [&](std::size_t begin, std::size_t end) {
        VerdictSums sums;
        for (std::size_t f = begin; f < end; ++f) {
            const ReadFace face = read(static_cast<Index>(f));
            sums.add(static_cast<Index>(f), face, flat(static_cast<Eigen::Index>(f), face.corners));
        }
        parts[begin / at_a_time] = std::move(sums);
    });
    Verdict verdict;
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
    const std::vector<char> is_turned = mask_of(turned, triangles.rows()), is_out = mask_of(left_out, triangles.rows());
    return judge_faces(vertices, triangles, [&](Index f) {
        const std::array<int, 3> corners = is_turned[f] != 0 ? std::array{0, 2, 1} : std::array{0, 1, 2};
        const auto point = [&](int k) {
            return StoredPoint{as_stored(uv(3 * f + k, 0)), as_stored(uv(3 * f + k, 1))};
        };
        return ReadFace{{point(corners[0]), point(corners[1]), point(corners[2])}, corners, is_out[f] == 0};
    });
}

Verdict judge_disk(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                   const std::vector<char>& first_corners)
{
    return judge_faces(vertices, triangles, [&](Index f) {
        const int first = first_corners.empty() ? 0 : first_corners[static_cast<std::size_t>(f)];
        return ReadFace{StoredFace(triangles, points, f, first), {first, (first + 1) % 3, (first + 2) % 3}};
    });
}

std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& points)
{
    return found_in_pieces(static_cast<Index>(triangles.rows()),
                           [&](Index f) { return StoredFace(triangles, points, f).flipped(); });
}

}  // namespace koebe
