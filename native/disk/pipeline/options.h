// The options of a uniformization.
#pragma once

#include "core/types.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_mesh_options.h"

#include <vector>

namespace koebe {

enum class Engine { condensed, mesh };  ///< docs/method.md: eliminated once, or disks as real triangles
/// automatic: the longest loop, with Balance::area the loop with the least area distortion.
enum class OuterLoop { automatic, longest, vertex };
enum class Balance { none, area };  ///< area: the disk automorphism with the least area distortion

struct UniformizeOptions : IterationOptions, EvennessOptions {
    Engine engine = Engine::condensed;
    KoebeMeshOptions mesh;  ///< with Engine::mesh
    OuterLoop outer = OuterLoop::automatic;
    Index outer_vertex = -1;  ///< with OuterLoop::vertex: a vertex of the outer loop
    Balance balance = Balance::none;
    Index center = -1, point = -1;  ///< an inner vertex to put at 0, a vertex of the outer loop to put at 1; -1: none
    /// With Balance::area, or `even` above 0: importance of each vertex, 0 to 1. They count lengths around a vertex of
    /// importance w most_important^w times, so that it gets more texels. Empty or all equal: no effect.
    std::vector<double> importance = {};
    bool polish = false;  ///< at the end, least angle error with the circles kept (angle_polish.h)
    bool repair = true;   ///< false: leave flipped faces as they are; for maps that are only judged
    double margin = 8.0;  ///< between the disks of a mesh that is cut, in pixels
    int pixels = 2048;    ///< side of the texture, for `margin`
    /// Names of vertices and faces in warnings, where the surface is a piece of another; empty: their own numbers.
    std::vector<Index> vertex_names = {}, face_names = {};
    int threads = 0;  ///< at most; 0: all cores. A large surface is mapped on all of them, small pieces of a cut mesh
                      ///< side by side. Any number gives the same result
};

}  // namespace koebe
