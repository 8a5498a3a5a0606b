// Numbers and coordinates of any mesh that follow from its shape alone, and the way back to the input's numbers.
#pragma once

#include "core/errors.h"
#include "core/numbering.h"
#include "core/types.h"
#include "quality/report.h"

#include <algorithm>
#include <vector>

namespace koebe {

struct CanonicalMesh {
    Vertices vertices;                     ///< (V, 3) within the unit ball, rounded to a grid; unused vertices at 0
    Triangles triangles;                   ///< (F, 3) each with its corners in the input's cyclic order
    std::vector<Index> original_vertices;  ///< the input's vertex for each vertex; unused vertices come last
    std::vector<Index> original_faces;     ///< the input's face for each face
    std::vector<char> first_corners;       ///< of each face: the corner that is first in the input
    Eigen::Matrix3d turn;                  ///< as in CanonicalPosition

    /// The canonical number of an input's vertex. Numbers that are negative or too large stay unchanged.
    Index vertex(Index original) const;
    /// The input's values in the order of the canonical vertices or faces; empty if there are no values.
    template <class Value>
    std::vector<Value> of_vertices(const std::vector<Value>& values) const
    {
        return taken(values, original_vertices);
    }
    template <class Value>
    std::vector<Value> of_faces(const std::vector<Value>& values) const
    {
        return taken(values, original_faces);
    }

    // Back to the input's numbers, in place.
    void name_vertex(Index& v) const { name(v, original_vertices); }
    void name_face(Index& f) const { name(f, original_faces); }
    void name_path(std::vector<Index>& vertices) const;      ///< keeps the path's order
    void name_loop(VertexLoop& loop) const;                  ///< then its lowest vertex comes first
    void name_vertices(std::vector<Index>& vertices) const;  ///< then ascending
    void name_faces(std::vector<Index>& faces) const;        ///< then ascending
    void name_elements(ElementKind kind, std::vector<Index>& elements) const;
    void name_report(MapReport& report) const;
    /// (3F, n) rows of the corners of all faces.
    template <class Rows>
    void name_corners(Rows& rows) const
    {
        Rows named(rows.rows(), rows.cols());
        for (std::size_t f = 0; f < original_faces.size(); ++f)
            for (Eigen::Index k = 0; k < 3; ++k)
                named.row(3 * static_cast<Eigen::Index>(original_faces[f]) + k) =
                    rows.row(3 * static_cast<Eigen::Index>(f) + (first_corners[f] + k) % 3);
        rows = std::move(named);
    }
    /// (F) values of the faces.
    template <class Value>
    void name_values(std::vector<Value>& of_face) const
    {
        std::vector<Value> named(of_face.size());
        for (std::size_t f = 0; f < of_face.size(); ++f) named[original_faces[f]] = of_face[f];
        of_face = std::move(named);
    }

private:
    template <class Value>
    static std::vector<Value> taken(const std::vector<Value>& values, const std::vector<Index>& names)
    {
        return values.size() == names.size() ? values_at(values, names) : values;  // the reader reports the wrong size
    }
    static void name(Index& number, const std::vector<Index>& names)
    {
        if (number >= 0 && number < static_cast<Index>(names.size())) number = names[number];
    }
};

/// A patch is a set of faces joined over edges in one orientation. Each patch is numbered from an edge of its own
/// (canonical_walk.h), larger patches first. Faces that name a vertex twice, or repeat another face, come last.
/// Positions are as in canonical_form.h.
/// @return the unchanged input if its arrays are not a mesh (empty, not finite, out of range, at one point): the reader
/// reports it
CanonicalMesh canonical_mesh(const Vertices& vertices, const Triangles& triangles);

/// Throws the error with its numbers changed to the input's. @throws error
[[noreturn]] void throw_named(const CanonicalMesh& mesh, const KoebeError& error);

/// Calls work on the canonical mesh. Returns the result in the input's numbers, so the result follows from the shape
/// alone.
/// @param work (const CanonicalMesh&) -> Result @param name (const CanonicalMesh&, Result&): to the input's numbers
template <class Work, class Name>
auto in_canonical_form(const Vertices& vertices, const Triangles& triangles, const Work& work, const Name& name)
{
    const CanonicalMesh mesh = canonical_mesh(vertices, triangles);
    try {
        auto result = work(mesh);
        name(mesh, result);
        return result;
    } catch (const KoebeError& error) {
        throw_named(mesh, error);
    }
}

}  // namespace koebe
