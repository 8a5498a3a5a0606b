// koebe fill IN OUT
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/mesh_input.h"
#include "cli/subcommand.h"
#include "cli/validators.h"

#include "core/errors.h"
#include "geometry/hole_filling.h"
#include "io/atomic_file.h"
#include "io/obj_writer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>

namespace koebe::cli {
namespace {

struct Request {
    std::string input, output;
    std::vector<Index> loops;
    bool quiet = false;
};

/// Polygons with a group for each: 0 the surface, k + 1 the patch of loop k.
struct GroupedPolygons {
    PolygonMesh mesh;
    std::vector<Index> group;
};

void add_polygon(GroupedPolygons& result, std::span<const Index> polygon, bool turned, Index group)
{
    auto& corners = result.mesh.corners;
    if (turned)
        corners.insert(corners.end(), polygon.rbegin(), polygon.rend());
    else
        corners.insert(corners.end(), polygon.begin(), polygon.end());
    result.mesh.face_begin.push_back(static_cast<Index>(corners.size()));
    result.group.push_back(group);
}

/// The polygons as filed, turned where their triangles were, and then the patches.
GroupedPolygons join(const MeshInput& input, const FilledSurface& filled)
{
    const Triangles& triangles = input.triangulation.triangles;
    std::vector<char> turned(static_cast<std::size_t>(input.polygons.face_count()), 0);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        turned[input.triangulation.face[t]] = !(triangles.row(t).array() == filled.triangles.row(t).array()).all();

    GroupedPolygons result;
    result.mesh.vertices = filled.vertices;
    for (Index f = 0; f < input.polygons.face_count(); ++f)
        add_polygon(result, input.polygons.face(f), turned[f], 0);
    for (Eigen::Index t = triangles.rows(); t < filled.triangles.rows(); ++t)
        add_polygon(result, {filled.triangles.row(t).data(), 3}, false, filled.label[t] + 1);
    return result;
}

std::vector<std::string> group_names(const std::vector<Index>& groups)
{
    std::vector<std::string> names{"surface"};
    for (Index k = 0; k < *std::ranges::max_element(groups); ++k) names.push_back("patch_" + std::to_string(k));
    return names;
}

int run(const Request& request)
{
    const auto begin = std::chrono::steady_clock::now();
    const CancelToken token = cancel_on_signal();
    require_writable(request.output);
    const MeshInput input = read_mesh_input(request.input, token);
    const FilledSurface filled =
        with_filed_faces(input, [&] {
            return fill_holes(input.polygons.vertices, input.triangulation.triangles,
                              request.loops.empty() ? std::nullopt : std::optional(request.loops));
        });
    const GroupedPolygons joined = join(input, filled);
    AtomicFile file(request.output);
    write_obj_with_groups(file, joined.mesh, joined.group, group_names(joined.group));
    if (token.cancelled()) throw Cancelled();
    file.commit();

    if (!request.quiet) {
        const std::set<Index> groups(joined.group.begin(), joined.group.end());
        std::printf("%s: %zu loops filled, %d faces added, %.2f s\n", request.output.c_str(), groups.size() - 1,
                    joined.mesh.face_count() - input.polygons.face_count(),
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return done;
}

}  // namespace

Subcommand add_fill(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("fill", "fill the holes of a surface");
    options->add_option("IN", request->input, "surface with holes: OBJ, OFF, PLY or STL")->required();
    options->add_option("OUT", request->output, "OBJ to write, with the groups surface, patch_0, patch_1, …")
        ->required();
    options
        ->add_option("--loops", request->loops,
                     "boundary loops to fill, as 0,2: by rank of their lowest vertices (default all)")
        ->delimiter(',')
        ->check(whole_number(0));
    options->add_flag("--quiet", request->quiet, "no result line");
    return {options, [request] { return run(*request); }};
}

}  // namespace koebe::cli
