#include "foldover/untangle.h"

#include "core/sort_unique.h"
#include "execution/thread_share.h"
#include "foldover/untangle_patch.h"
#include "quality/stored_uv.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr int ring_counts[] = {2, 4, 8, 16};
constexpr PatchShape shapes[] = {PatchShape::surface, PatchShape::equilateral};
constexpr std::size_t most_tries = 16;  // single vertices tried in turn for one patch
constexpr int most_rounds = 12;         // rounds of freeing vertices

using Place = TangledMap::Place;

class Untangler {
public:
    Untangler(TangledMap& map, RepairEffort& effort, const ExecutionContext& context, const UntangleOptions& options)
        : map_(map), effort_(effort), context_(context), options_(options)
    {
    }

    UntangleReport run()
    {
        UntangleReport report;
        const auto share = static_cast<std::size_t>(options_.share * static_cast<double>(effort_.left()));
        const std::size_t limit = effort_.spent() + share;
        effort_.set_limit(limit - share / 4);
        nudge_faces(report);
        for (const int rings : ring_counts)
            for (const PatchBoundary boundary : {PatchBoundary::held, PatchBoundary::sliding})
                for (const PatchShape shape : shapes) {
                    if (report.tangled.empty()) return report;
                    if (boundary == PatchBoundary::sliding && !options_.slide) continue;
                    for (const auto& patch : patches_around(map_, report.tangled, rings, boundary))
                        report.repairs += repair_patch(map_, patch, shape, boundary, effort_, context_);
                    report.tangled = map_.tangled();
                }
        effort_.set_limit(limit);
        for (int round = 0; round < most_rounds && !report.tangled.empty() && !effort_.exhausted(); ++round) {
            bool progress = false;
            for (const auto& patch : patches_around(map_, report.tangled, 2, freedom())) {
                const std::size_t before = map_.tangled(patch).size();
                if (before == 0) continue;
                const auto freed = free_some(patch, round);
                report.freed.insert(report.freed.end(), freed.begin(), freed.end());
                progress = progress || map_.tangled(patch).size() < before;
            }
            report.tangled = map_.tangled();
            if (!progress && round >= 2) break;
        }
        nudge_faces(report);  // vertices that slid may be too near to each other
        std::erase_if(report.freed, [&](Index v) { return map_.near_circle(v); });
        std::sort(report.freed.begin(), report.freed.end());
        return report;
    }

private:
    void nudge_faces(UntangleReport& report)
    {
        for (const Index f : map_.tangled()) report.repairs += nudge_face(map_, f);
        report.tangled = map_.tangled();
    }

    PatchBoundary freedom() const { return options_.slide ? PatchBoundary::sliding : PatchBoundary::freed; }

    /// Loop vertices on inner circles within some rings of the patch's tangled faces, nearest first.
    std::vector<Index> candidates(const std::vector<Index>& patch, int rings) const
    {
        std::vector<Index> result;
        std::vector<Index> faces = map_.tangled(patch);
        for (int ring = 0; ring <= rings; ++ring) {
            std::vector<Index> met;
            for (const Index f : faces)
                for (int k = 0; k < 3; ++k)
                    if (const Index v = map_.triangles()(f, k);
                        map_.loop_of(v) > 0 && map_.place(v) == Place::on_circle)
                        met.push_back(v);
            sort_unique(met);
            for (const Index v : met)
                if (std::find(result.begin(), result.end(), v) == result.end()) result.push_back(v);
            std::vector<Index> wider;
            for (const auto& group : patches_around(map_, map_.tangled(patch), ring + 1, freedom()))
                wider.insert(wider.end(), group.begin(), group.end());
            faces = std::move(wider);
        }
        return result;
    }

    /// Whether the tangled faces of a patch became fewer with the present freedom.
    bool attempt(const std::vector<Index>& patch)
    {
        bool better = false;
        for (const int rings : {2, 4, 8})
            for (const PatchShape shape : shapes) {
                const auto tangled = map_.tangled(patch);
                if (tangled.empty()) return true;
                if (effort_.exhausted()) return better;
                for (const auto& wider : patches_around(map_, tangled, rings, freedom()))
                    better = repair_patch(map_, wider, shape, freedom(), effort_, context_) || better;
            }
        return better;
    }

    /// Frees one vertex if that improves the patch, else all loop vertices of its tangled faces.
    std::vector<Index> free_some(const std::vector<Index>& patch, int round)
    {
        std::vector<Index> near = candidates(patch, round);
        for (std::size_t i = 0; i < std::min(near.size(), most_tries); ++i) {
            if (effort_.exhausted()) return {};
            map_.set_place(near[i], Place::off_circle);
            if (attempt(patch)) return {near[i]};
            map_.set_place(near[i], Place::on_circle);
        }
        for (const Index v : near) map_.set_place(v, Place::off_circle);
        if (attempt(patch)) return near;
        for (const Index v : near) map_.set_place(v, Place::on_circle);
        return {};
    }

    TangledMap& map_;
    RepairEffort& effort_;
    const ExecutionContext& context_;
    const UntangleOptions& options_;
};

}  // namespace

UntangleReport untangle(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                        const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                        const ExecutionContext& context, const UntangleOptions& options)
{
    const auto tangled = [&](Eigen::Index f) {
        const StoredFace face(surface.triangles, uv, f);
        return face.doubtful() && !face.below_resolution();
    };
    if (found_in_pieces(surface.triangles.rows(), tangled).empty()) return {};
    TangledMap map(vertices, surface, loops, circles, off_circle, uv);
    for (const Index v : options.held) map.hold(v);
    RepairEffort own(surface.triangles.rows());
    return Untangler(map, options.effort ? *options.effort : own, context, options).run();
}

}  // namespace koebe
