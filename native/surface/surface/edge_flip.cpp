#include "surface/edge_flip.h"

#include "core/connectivity.h"

namespace koebe {

void flip_edge(Triangles& triangles, EdgeLengths& lengths, std::vector<Index>& twin, Index h, double diagonal)
{
    const Index t = twin[h];
    const Index bc = next_halfedge(h), ca = previous_halfedge(h);
    const Index ad = next_halfedge(t), db = previous_halfedge(t);
    const Index a = origin(triangles, h), b = origin(triangles, t);
    const Index c = origin(triangles, ca), d = origin(triangles, db);

    struct Side {
        double length;
        Index twin;
    };
    const auto side = [&](Index e) { return Side{lengths.data()[e], twin[e]}; };
    const Side side_bc = side(bc), side_ca = side(ca), side_ad = side(ad), side_db = side(db);

    const Index f = 3 * face_of(h), g = 3 * face_of(t);
    const auto write = [&](Index base, Index p, Index q, Index r, const Side& qr, const Side& rp) {
        triangles.data()[base] = p;
        triangles.data()[base + 1] = q;
        triangles.data()[base + 2] = r;
        lengths.data()[base] = diagonal;
        lengths.data()[base + 1] = qr.length;
        lengths.data()[base + 2] = rp.length;
    };
    write(f, d, c, a, side_ca, side_ad);
    write(g, c, d, b, side_db, side_bc);
    const auto link = [&](Index slot, Index other) {
        twin[slot] = other;
        if (other != no_twin) twin[other] = slot;
    };
    // A side may be glued to another side of the same quadrilateral: translate such twins first.
    const auto moved = [&](Index other) {
        if (other == bc) return g + 2;
        if (other == ca) return f + 1;
        if (other == ad) return f + 2;
        if (other == db) return g + 1;
        return other;
    };
    link(f, g);
    link(f + 1, moved(side_ca.twin));
    link(f + 2, moved(side_ad.twin));
    link(g + 1, moved(side_db.twin));
    link(g + 2, moved(side_bc.twin));
}

}  // namespace koebe
