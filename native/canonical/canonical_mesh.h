// Any mesh in numbers and coordinates that follow from its shape alone, and the way back to its own.
#pragma once

#include "core/errors.h"
#include "core/types.h"
#include "quality/report.h"

#include <algorithm>
#include <vector>

namespace koebe {

struct CanonicalMesh {
    Vertices vertices;                     ///< (V, 3) within the unit ball, on a grid; those of no face at 0
    Triangles triangles;                   ///< (F, 3) each with its corners in the input's cyclic order
    std::vector<Index> original_vertices;  ///< of the input, for each vertex; those of no face come last
    std::vector<Index> original_faces;     ///< of the input, for each face
    std::vector<char> first_corners;       ///< of each face: the corner that was the first of the input's
    Eigen::Matrix3d turn;                  ///< as CanonicalPosition has it

    /// A number of the input's vertex here; a negative one, and one that is too large, as it is.
    Index vertex(Index original) const;
    /// What the input has for each vertex or for each face; nothing if it has nothing.
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

    // The way back, in place.
    void name_vertex(Index& v) const { name(v, original_vertices); }
    void name_face(Index& f) const { name(f, original_faces); }
    void name_path(std::vector<Index>& vertices) const;      ///< which keeps its order
    void name_loop(VertexLoop& loop) const;                  ///< its lowest vertex first
    void name_vertices(std::vector<Index>& vertices) const;  ///< rising
    void name_faces(std::vector<Index>& faces) const;        ///< rising
    void name_elements(ElementKind kind, std::vector<Index>& elements) const;
    void name_report(MapReport& report) const;
    /// (3F, n) of the corners of all faces.
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
    /// (F) of each face.
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
        std::vector<Value> result;
        if (values.size() == names.size())
            for (const Index name : names) result.push_back(values[name]);
        else
            result = values;  // who reads them says what is wrong
        return result;
    }
    static void name(Index& number, const std::vector<Index>& names)
    {
        if (number >= 0 && number < static_cast<Index>(names.size())) number = names[number];
    }
};

/// Faces that edges join in one orientation are a patch; each is numbered from an edge of its own (canonical_walk.h),
/// those of more faces first; faces that name a vertex twice, or have
/// the vertices of another one, come last. The position is that of canonical_form.h.
/// @return the input as it is where its arrays are no mesh (empty, not finite, out of range, on one point): who reads
/// them says so
CanonicalMesh canonical_mesh(const Vertices& vertices, const Triangles& triangles);

/// The error with the input's numbers. @throws it
[[noreturn]] void throw_named(const CanonicalMesh& mesh, const KoebeError& error);

/// What some work gives on the canonical mesh, by the input's numbers: so it follows from the shape alone.
/// @param work (const CanonicalMesh&) -> Result @param name (const CanonicalMesh&, Result&): its numbers to the input's
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
