// A triangulated disk whose inner vertices can be taken out and put back.
#pragma once

#include "core/types.h"

#include <array>
#include <functional>
#include <vector>

namespace koebe {

/// To take a vertex out, it is slid along an edge into a neighbour. Then a fan of faces round this neighbour fills the
/// polygon of the vertex's neighbours. The complex must stay simplicial: the vertex and the neighbour have only two
/// common neighbours, the two on their common faces (Dey, Edelsbrunner, Guha and Nekhayev 1999, "link condition"). So
/// if a drawing without the vertex is one to one, the polygon has a kernel to which the vertex can return, at least
/// near the neighbour.
///
/// Every face stands for a number of faces of the whole mesh: the faces that it has replaced.
class DiskComplex {
public:
    using Face = std::array<Index, 3>;

    /// @param outer the disk's only boundary loop, whose vertices stay
    DiskComplex(const Triangles& triangles, Index vertex_count, const std::vector<Index>& outer);

    Index vertex_count() const { return static_cast<Index>(around_.size()); }
    bool outer(Index vertex) const { return outer_[vertex] != 0; }
    bool present(Index vertex) const { return !around_[vertex].empty(); }
    /// Faces round a vertex in no particular order.
    const std::vector<Index>& around(Index vertex) const { return around_[vertex]; }
    const Face& face(Index f) const { return faces_[f]; }
    double weight(Index f) const { return weights_[f]; }  ///< number of faces that the face stands for
    bool alive(Index f) const { return alive_[f] != 0; }
    Index face_count() const { return static_cast<Index>(faces_.size()); }  ///< dead faces included
    Triangles triangles() const;                                            ///< the faces that are alive

    /// The face's corners, turned so that this vertex comes first.
    Face seen_from(Index vertex, Index f) const;
    /// Neighbours of an inner vertex, counter-clockwise, and the face from each neighbour to the next.
    void link(Index vertex, std::vector<Index>& neighbours, std::vector<Index>& faces) const;

    /// Takes a vertex out. @param chords whether a new edge may join two outer vertices
    /// @param wrong of the neighbours that can take it the one with the fewest new faces that are wrong takes it, by a
    /// new face and the number of faces it stands for; empty: the one with the fewest faces
    /// @return false if no neighbour can take it
    bool take_out(Index vertex, bool chords, const std::function<bool(const Face&, double)>& wrong = {});
    std::size_t taken_out() const { return removals_.size(); }
    /// Undoes the last take_out. @return the vertex
    Index put_back();

private:
    struct Removal {
        Index vertex;
        std::vector<Index> old_faces;
        Index first_new;
    };

    Index heir(const std::vector<Index>& link, const std::vector<Index>& faces, bool chords,
               const std::function<bool(const Face&, double)>& wrong);
    void add(Index f);
    void drop(Index f);

    std::vector<Face> faces_;
    std::vector<double> weights_;
    std::vector<char> alive_, outer_;
    std::vector<std::vector<Index>> around_;
    std::vector<Removal> removals_;
    mutable std::vector<Index> next_, next_face_;  // scratch of link
    std::vector<char> marked_;                     // scratch of heir
};

}  // namespace koebe
