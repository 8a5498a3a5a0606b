#include "canonical/canonical_form.h"

#include "canonical/canonical_position.h"
#include "canonical/canonical_walk.h"
#include "core/connectivity.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

class Canonicalizer {
public:
    Canonicalizer(const Surface& surface, const Vertices& vertices)
        : surface_(surface), positions_(scaled_position(surface, vertices))
    {
    }

    CanonicalForm run()
    {
        const JoinedFaces faces{surface_.triangles, surface_.twin, surface_.vertex_count};
        number(walk_from(faces, first_halfedges(faces, positions_)));
        Vertices numbered(form_.original_vertices.size(), 3);
        each_rows(numbered.rows(), [&](Eigen::Index first, Eigen::Index count) {
            for (Eigen::Index v = first; v < first + count; ++v)
                numbered.row(v) = positions_.row(form_.original_vertices[v]);
        });
        positions_ = {};
        CanonicalPosition position = turned_position(form_.surface.triangles, std::move(numbered));
        form_.vertices = std::move(position.vertices);
        form_.thinnest = position.thinnest;
        return std::move(form_);
    }

private:
    /// Numbers faces in the order of the walk, each from the corner where it is entered.
    void number(FaceWalk walk)
    {
        const Index face_count = static_cast<Index>(surface_.triangles.rows());
        Surface& surface = form_.surface;
        const std::vector<Index> entered = std::move(walk.entered);
        form_.original_vertices = std::move(walk.vertices);
        rank_.assign(surface_.vertex_count, -1);
        each_rows(static_cast<Eigen::Index>(form_.original_vertices.size()), [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index v = first; v < first + n; ++v) rank_[form_.original_vertices[v]] = static_cast<Index>(v);
        });
        form_.original_faces.resize(face_count);
        std::vector<Index> first_halfedge(face_count);  // of each face, in the new numbers
        each_rows(face_count, [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index f = first; f < first + n; ++f) {
                const Index h = entered[f];
                form_.original_faces[f] = face_of(h);
                first_halfedge[face_of(h)] = static_cast<Index>(3 * f) + (3 - h % 3) % 3;
            }
        });
        surface.triangles.resize(face_count, 3);
        surface.twin.resize(3 * static_cast<std::size_t>(face_count));
        each_rows(face_count, [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index f = first; f < first + n; ++f) {
                Index h = entered[f];
                for (int k = 0; k < 3; ++k, h = next_halfedge(h)) {
                    surface.triangles(f, k) = rank_[origin(surface_.triangles, h)];
                    const Index twin = surface_.twin[h];
                    Index& other = surface.twin[3 * f + k];
                    other = twin == no_twin ? no_twin : first_halfedge[face_of(twin)];
                    for (Index step = twin % 3; step > 0; --step) other = next_halfedge(other);
                }
            }
        });
        surface.vertex_count = static_cast<Index>(form_.original_vertices.size());
        surface.euler_characteristic = surface_.euler_characteristic;
        surface.genus = surface_.genus;
        surface.reoriented = surface_.reoriented;
        surface.unused = surface_.unused;
        for (VertexLoop loop : surface_.loops) {
            for (Index& v : loop) v = rank_[v];
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
            surface.loops.push_back(std::move(loop));
        }
        std::sort(surface.loops.begin(), surface.loops.end());
    }

    const Surface& surface_;
    Vertices positions_;
    std::vector<Index> rank_;
    CanonicalForm form_;
};

}  // namespace

CanonicalForm canonical_form(const Surface& surface, const Vertices& vertices)
{
    return Canonicalizer(surface, vertices).run();
}

}  // namespace koebe
