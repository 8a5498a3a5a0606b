// Writes the text of an OBJ file again, with other texture coordinates and all its other contents.
#pragma once

#include "files/text_writer.h"
#include "io/polygon_mesh.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::io {

/// Adds "v/vt". Both numbers are counted from 0.
void add_obj_corner(TextWriter& text, Index vertex, Index texture);

/// The changes of a text that is written again.
struct ObjChange {
    const PolygonMesh& mesh;         ///< with the text's faces in their order
    std::span<const Index> texture;  ///< (C) number of the new `vt` of each corner; empty: the old ones stay
    bool moved = false;              ///< take the mesh's positions, and leave normals out
};

/// Recognizes statements as read_obj does. Every other line stays as it is, also comments and unknown ones. Normals of
/// faces stay, but are counted from 1. `l` and `surf` lose texture coordinates that are replaced.
class ObjText {
public:
    /// @param text of an OBJ file that read_obj accepts; it must outlive the object
    explicit ObjText(std::string_view text);

    /// Contents beside vertices, faces and texture coordinates, in words: "groups", "materials" ...
    const std::vector<std::string>& contents() const { return contents_; }
    std::size_t texture_coordinates() const { return total_.texture_coordinates; }
    std::size_t normals() const { return total_.normals; }
    std::size_t vertices() const { return total_.vertices; }
    std::size_t faces() const { return total_.faces; }
    bool holds(std::string_view content) const;
    std::string_view end_of_line() const { return end_of_line_; }

    /// Adds the text before the first face.
    void add_head(TextWriter& text, const ObjChange& change) const;
    /// Adds the rest, on this thread's share of threads.
    /// @return number of faces that lost their normals, as the text lacks one of them
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
    std::size_t first_with_faces_ = 0;  ///< the piece that begins with the first face
    Counts total_;
    std::vector<std::string> contents_;
    std::string_view end_of_line_ = "\n";
};

}  // namespace koebe::io
