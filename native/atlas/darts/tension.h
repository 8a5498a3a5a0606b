// The forces between the two sides of a path in a relaxed part. A cut along the path would release them.
#pragma once

#include "cut/seamed_mesh.h"
#include "even/even_forces.h"
#include "flat/flat_part.h"

#include <vector>

namespace koebe {

/// A surface's edges, to look for paths. Edges inside a polygon and on the boundary belong to no path.
/// @param polygon, shown as in FlatPart: edges that are shown count as longer. If `shown` is empty, lengths are lengths
/// on the surface
SeamedMesh seamed(const Vertices& vertices, const Surface& surface, const std::vector<Index>& polygon,
                  const std::vector<double>& shown);
SeamedMesh seamed(const FlatPart& flat, const std::vector<double>& shown = {});

/// (F) The weights of the energies of a part's faces, by how well they are seen; empty: 1.
VectorXd weights_of_faces(const FlatPart& flat);

/// The forces in a part relaxed for this E (even/even_forces.h), with the sizes and weights of its faces.
EvenForces forces_in(const FlatPart& flat, double even);

/// (F) 1 for faces whose energy is above tuning::strained. @param energy, areas (F)
std::vector<int> strained_faces(const VectorXd& energy, const VectorXd& areas);

/// Whether a part is flat in truth (even/even_map.h): it needs no cuts.
bool is_true_to_size(const FlatPart& flat);

class Tension {
public:
    Tension(const FlatPart& flat, const EvenForces& forces);

    /// The force between the sides of a path at one of its vertices. Real part: how much the left side is pulled
    /// forward against the right side. Imaginary part: how much both sides are pulled apart. Both stay the same if the
    /// path runs in the other direction.
    /// @param from the vertex before @param to the vertex after; -1 at the boundary, where the path ends
    Complex at(Index v, Index from, Index to) const;

private:
    /// A neighbour of a vertex, and its place among the neighbours, counter-clockwise.
    struct Neighbour {
        Index vertex;
        Index place;
    };

    void add_ring(Index v, Index leaving, const EvenForces& forces);
    Index place_of(Index v, Index neighbour) const;
    Complex pull_of_left(Index v, Index from, Index to) const;
    Complex whole(Index v) const { return sums_[begin_[v + 1] - 1]; }

    const FlatPart& flat_;
    // The rings of all vertices, one after the other. From each neighbour to the next one lies a face. Behind the last
    // face stands the last neighbour on the boundary, or the first neighbour again.
    std::vector<std::size_t> begin_;     // (V + 1)
    std::vector<Neighbour> neighbours_;  // of each ring by rising vertices
    std::vector<Complex> sums_;          // of the forces of the ring's faces before this place
};

}  // namespace koebe
