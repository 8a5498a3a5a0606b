// A one-to-one map of a surface with its holes filled, which stays one to one in every move.
#pragma once

#include "circles/circle_fit.h"
#include "circles/circle_map.h"
#include "circles/moebius.h"
#include "ears/ears.h"
#include "embedding/convex_embedding.h"
#include "embedding/fixed_places.h"
#include "execution/execution.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "mesh/topology.h"

#include <cstddef>
#include <vector>

namespace koebe {

/// In every move, faces that are right stay right. A right face is upright; this includes the fans. A right face of the
/// surface is also upright as stored, if it is large enough for 32-bit UVs. The outer loop runs once round the circle.
/// A move that would break these rules is undone. As the fans stay upright, no loop crosses itself or another loop.
class FilledMap {
public:
    /// Weights, dimensionless.
    struct Pull {
        double rim = 0.0;       ///< of loop vertices to their circles
        double centre = 0.0;    ///< of fans' centres to the circles' centres
        double regular = 1e-3;  ///< of the fans, whose wanted shape is a regular polygon; the surface's faces weigh 1
        double place = 0.0;     ///< of the vertex for 0 to its place
        PatchShape shape = PatchShape::surface;  ///< wanted shape of the faces
    };

    /// Starts from convex_embedding. The rim gets more room where faces have too little (widened_rim.h).
    /// @param ears the rims of ears are not pulled to the circles of inner loops
    /// @param places vertices with fixed places; the centre is not at 0 if its faces would turn over there
    FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Ear>& ears, const VectorXcd& rim, FixedPlaces places, const ExecutionContext& context);

    /// Starts from a map with few wrong faces (mend_drawing). Only vertices near those that had to be replaced move.
    FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Ear>& ears, const CircleMap& map, FixedPlaces places, const ExecutionContext& context);
    /// Whether there is a start.
    bool started() const { return now_.points.rows() > 0; }

    /// Lowers the angle error of the surface's faces, and the pulls, by some Newton steps (foldover_free.h, strict).
    void relax(Pull pull, int iterations, const ExecutionContext& context);
    /// Puts pulled vertices onto their circles, where they slide from then on, unless a face would turn over.
    /// @return the number of vertices off their circles
    int snap();
    /// Lets the vertices of an inner loop leave its circle.
    void release(std::size_t loop);

    /// Sets whether the outer loop slides along the unit circle. At first it does.
    void let_rim_slide(bool slides);

    /// The state that moves change, kept to undo them.
    struct State {
        PlanarPoints points;
        std::vector<FoldoverProblem::Mobility> mobility;
        std::vector<Circle> circles;
    };
    /// Number of faces over all Newton steps so far.
    std::size_t work() const { return work_; }
    const State& state() const { return now_; }
    void return_to(State state) { now_ = std::move(state); }

    std::vector<Circle>& circles() { return now_.circles; }  ///< of the loops, the unit circle first
    Complex at(Index vertex) const { return {now_.points(vertex, 0), now_.points(vertex, 1)}; }
    Index fan_centre(std::size_t loop) const { return filled_.surface_vertices + static_cast<Index>(loop) - 1; }
    VectorXcd image_of(std::size_t loop) const;
    /// The roundness of a loop about its circle, without vertices that are not pulled.
    Roundness roundness_of(std::size_t loop) const;
    /// Vertices of an inner loop that are not on its circle. @param pulled only those that should be on it
    std::vector<Index> off_circle(std::size_t loop, bool pulled) const;
    PlanarPoints surface_points() const { return now_.points.topRows(surface_.vertex_count); }

private:
    using Mobility = FoldoverProblem::Mobility;

    FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Ear>& ears, FixedPlaces places);
    std::vector<char> wrong_faces() const;
    void hold_far_from(std::vector<Index> moving);
    void start(const VectorXcd& rim, const ExecutionContext& context);
    VectorXcd placed_rim(VectorXcd rim) const;
    bool move_by(Moebius moebius);
    bool move_center_by(double share);
    void bring_to_center(const ExecutionContext& context);
    bool approach_center(bool follows, const ExecutionContext& context);
    double area(Eigen::Index f) const;
    double longest_edge(Eigen::Index f) const;
    bool right(Eigen::Index f) const;
    bool moves(Eigen::Index f) const;
    bool star_right(Index vertex, const std::vector<char>& was_right) const;
    std::vector<char> right_faces() const;
    Eigen::Matrix2d fan_reference(Eigen::Index f, double area) const;
    FoldoverProblem problem(Pull pull) const;
    Complex on_circle(Index vertex) const;

    const Vertices& vertices_;
    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    FilledDisk filled_;
    std::vector<std::vector<Index>> around_;  // faces of each vertex
    std::vector<int> loop_of_;
    std::vector<char> pulled_;     // 1 for vertices that should be on circles of inner loops
    std::vector<double> caution_;  // per face: factor of its floor
    FixedPlaces places_;
    State now_;
    std::size_t work_ = 0;
    std::vector<Index> faces_;  // the surface's faces with vertices that move
    std::vector<char> still_;   // (V) 1 for vertices that never move; empty if there are none
};

}  // namespace koebe
