// The map of koebe uniformize, ricci and sequence.
#pragma once

#include "cli/commands/map_kind.h"
#include "cli/options/loop_options.h"
#include "core/counted.h"
#include "pipeline/convex_disk.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

namespace koebe::cli {

using MapFunction =
    std::function<UniformizeResult(const Vertices&, const Triangles&, const UniformizeOptions&, ExecutionContext&)>;

class UniformizeKind final : public DiskKind<UniformizeResult> {
public:
    /// @param map not needed where compute() is not called
    explicit UniformizeKind(const MapRequest& request, MapFunction map = {}) : DiskKind(request), map_(std::move(map))
    {
    }

    UniformizeResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        UniformizeOptions options = request_.options;
        name_mapped_vertices(input, options);
        UniformizeResult result = with_filed_faces(input, [&] {
            require_fitting_vertices(input, options);
            UniformizeResult made = map_(input.polygons.vertices, input.triangulation.triangles, options, context);
            make_polygons_convex(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face, made,
                                 context);
            return made;
        });
        input.give_to_joined(result.uv);
        add_input_warnings(input, result.warnings);
        return result;
    }
    std::string first_words(const UniformizeResult& result) const override
    {
        double roundness = 0.0;
        for (const LoopReport& loop : result.loops) roundness = std::max(roundness, loop.roundness.paper);
        return counted(result.loops.size(), "loop") + ", " + counted(static_cast<std::size_t>(result.sweeps), "sweep") +
               ", roundness " + formatted("%.1e", roundness);
    }

private:
    MapFunction map_;
};

}  // namespace koebe::cli
