// The text of an OBJ file, to be written again with other texture coordinates and all else that it holds.
#pragma once

#include "io/polygon_mesh.h"
#include "io/text_writer.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::io {

/// Adds "v/vt"; both are counted from 0.
void add_obj_corner(TextWriter& text, Index vertex, Index texture);

/// What is written otherwise than it stands in the text.
struct ObjChange {
    const PolygonMesh& mesh;         ///< with the faces of the text in their order
    std::span<const Index> texture;  ///< (C) of each corner the number of its new `vt`; empty: the old ones stay
    bool moved = false;              ///< vertices lie where the mesh has them; normals are left out
    std::vector<char> turned = {};   ///< (F) faces whose corners are written in the reverse order; or empty
};

/// Statements are told apart as read_obj does. Every other line stays as it is, comments and unknown ones too; so do
/// the normals of faces, but as counted from 1. In `l` and `surf` texture coordinates that are replaced are left out.
class ObjText {
public:
    /// @param text of an OBJ file that read_obj takes; it must outlive this
    explicit ObjText(std::string_view text);

    /// What it holds beside vertices and faces, in words: "groups", "materials" ...; without texture coordinates.
    const std::vector<std::string>& contents() const { return contents_; }
    std::size_t texture_coordinates() const { return total_.texture_coordinates; }
    std::size_t normals() const { return total_.normals; }
    std::size_t vertices() const { return total_.vertices; }
    std::size_t faces() const { return total_.faces; }
    bool holds(std::string_view content) const;
    std::string_view end_of_line() const { return end_of_line_; }

    /// Adds what stands before the first face.
    void add_head(TextWriter& text, const ObjChange& change) const;
    /// Adds the rest, on this thread's share of threads.
    /// @return number of faces that lost their normals, as one of them is not in the text
    std::size_t add_rest(TextWriter& text, const ObjChange& change) const;

private:
    struct Counts {
        std::size_t vertices = 0, normals = 0, texture_coordinates = 0, faces = 0;
        friend Counts operator+(const Counts& a, const Counts& b)
        {
            return {a.vertices + b.vertices, a.normals + b.normals, a.texture_coordinates + b.texture_coordinates,
                    a.faces + b.faces};
        }
    };
    struct Piece {
        std::string_view text;
        Counts before;  ///< of the statements before it
    };
    class Scan;
    class Copy;

    std::size_t add_pieces(TextWriter& text, const ObjChange& change, std::size_t begin, std::size_t end) const;

    std::vector<Piece> pieces_;
    std::size_t first_with_faces_ = 0;  ///< of the pieces: it begins with the first face
    Counts total_;
    std::vector<std::string> contents_;
    std::string_view end_of_line_ = "\n";
};

}  // namespace koebe::io
