// Makes a map with UVs per corner on a detachable thread, in canonical form.
#pragma once

#include "canonical/canonical_mesh.h"
#include "execution/detachable_run.h"
#include "execution/execution.h"
#include "execution/thread_share.h"

namespace koebe {

/// Maps a surface in canonical form and returns the result in the input's numbers, so the result follows from the shape
/// alone.
/// @param compute (const CanonicalMesh&, ExecutionContext&) -> Result; holds copies, as it may outlive the call
/// @param name (const CanonicalMesh&, Result&): renames the members that a CornerMapReport does not have
/// @param threads at most; 0: all cores
template <class Result, class Compute, class Name>
Result corner_map(const Vertices& vertices, const Triangles& triangles, ExecutionContext& context,
                  const Compute& compute, const Name& name, int threads = 1)
{
    return run_detachable<Result>(context, [vertices, triangles, compute, name, threads](ExecutionContext& own) {
        const ThreadShare share(threads);
        const auto compute_here = [&](const CanonicalMesh& mesh) { return compute(mesh, own); };
        const auto name_all = [&](const CanonicalMesh& mesh, Result& result) {
            mesh.name_corners(result.uv);
            mesh.name_faces(result.turned);
            mesh.name_report(result);
            name(mesh, result);
        };
        return in_canonical_form(vertices, triangles, compute_here, name_all);
    });
}

/// Maps with options. Their polygons are changed to the polygons of the canonical mesh.
/// @param compute (const CanonicalMesh&, Options&, ExecutionContext&) -> Result
template <class Result, class Options, class Compute, class Name>
Result corner_map(const Vertices& vertices, const Triangles& triangles, const Options& options,
                  ExecutionContext& context, const Compute& compute, const Name& name)
{
    const auto compute_here = [options, compute](const CanonicalMesh& mesh, ExecutionContext& own) {
        Options here = options;
        here.polygon = mesh.of_faces(options.polygon);
        return compute(mesh, here, own);
    };
    int threads = 1;
    if constexpr (requires { options.threads; }) threads = options.threads;
    return corner_map<Result>(vertices, triangles, context, compute_here, name, threads);
}

}  // namespace koebe
