// What a uniformization is asked for.
#pragma once

#include "core/types.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_mesh_options.h"

#include <vector>

namespace koebe {

enum class Engine { condensed, mesh };  ///< docs/method.md: eliminated once, or patches as real triangles
/// automatic: the longest, but with Balance::area the one with the least area distortion.
enum class OuterLoop { automatic, longest, vertex };
enum class Balance { none, area };  ///< area: the disk automorphism with the least area distortion

struct UniformizeOptions : IterationOptions {
    Engine engine = Engine::condensed;
    KoebeMeshOptions mesh;  ///< with Engine::mesh
    OuterLoop outer = OuterLoop::automatic;
    Index outer_vertex = -1;  ///< with OuterLoop::vertex: a vertex of the loop to put on the unit circle
    Balance balance = Balance::none;
    Index center = -1, point = -1;  ///< vertices, one inside that goes to 0, one of the outer loop to 1; -1: none
    /// With Balance::area, of each vertex, 0 to 1: the balance takes the surface there for most_important^w times as
    /// large in length, so that it gets more texels; empty: all alike. Equal ones change nothing.
    std::vector<double> importance = {};
    bool polish = false;               ///< least angle error with the circles as they are, at the end (angle_polish.h)
    double even = 0.0;                 ///< 0: conformal, 1: true to size (pipeline/even_disk.h)
    LoopForm loops = LoopForm::round;  ///< with `even`
    bool repair = true;  ///< false: as the iteration leaves it, faces may be turned over; for maps that are only judged
    /// What warnings call vertices and faces, where the surface is a piece of another one; empty: their own numbers.
    std::vector<Index> vertex_names = {}, face_names = {};
    int threads = 0;  ///< at most; 0: all cores. A large surface is mapped on all of them, small pieces of a cut mesh
                      ///< go side by side; the result is the same for any number

    /// Without those of the mesh engine, which has its own.
    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("method", &UniformizeOptions::method);
        visit("engine", &UniformizeOptions::engine);
        visit("outer", &UniformizeOptions::outer);
        visit("center", &UniformizeOptions::center);
        visit("point", &UniformizeOptions::point);
        SweepOptions::each_option(visit);
        visit("balance", &UniformizeOptions::balance);
        visit("importance", &UniformizeOptions::importance);
        visit("polish", &UniformizeOptions::polish);
        visit("even", &UniformizeOptions::even);
        visit("loops", &UniformizeOptions::loops);
        visit("threads", &UniformizeOptions::threads);
    }
};

}  // namespace koebe
