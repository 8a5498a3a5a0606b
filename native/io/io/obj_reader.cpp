#include "core/errors.h"
#include "io/format_readers.h"
#include "io/obj_text.h"
#include "io/refusals.h"
#include "io/text_lines.h"

#include <algorithm>
#include <array>
#include <vector>

namespace koebe::io {

/// CGAL is not used, as it makes a stream of each line, which takes a third of the command's whole time. tinyobjloader
/// changes the last digits of numbers, and Assimp keeps 32 bits.
PolygonMesh read_obj(std::string_view bytes)
{
    std::vector<double> coordinates;
    PolygonMesh mesh;
    TextLines lines(bytes);
    while (lines.next_statement()) {
        const std::string_view keyword = lines.next_word_of_joined_lines();
        const std::size_t vertex_count = coordinates.size() / 3;
        if (keyword == "v") {
            for (int axis = 0; axis < 3; ++axis) {
                double& number = coordinates.emplace_back();
                if (!lines.next_plain(number) && !to_number(lines.next_word_of_joined_lines(), number))
                    refuse("vertex", vertex_count, "is not three finite numbers");
            }
        } else if (keyword == "f") {
            for (;;) {
                Index corner = 0;  // counted from 1; if negative, from the last vertex backwards
                if (!lines.next_plain(corner)) {
                    const std::string_view word = lines.next_word_of_joined_lines();
                    if (word.empty()) break;
                    if (!to_number(word.substr(0, word.find('/')), corner))
                        refuse("face", mesh.face_begin.size() - 1, "has a corner that is no integer");
                }
                mesh.corners.push_back(corner > 0 ? corner - 1 : static_cast<Index>(vertex_count) + corner);
            }
            mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
        }
        if (std::max({vertex_count, mesh.face_begin.size(), mesh.corners.size()}) >= most_elements) refuse_size();
    }
    mesh.vertices =
        Eigen::Map<const Vertices>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
    return mesh;
}

PlanarPoints obj_corner_uvs(std::string_view bytes, const PolygonMesh&, int)
{
    std::vector<std::array<double, 2>> uvs;
    std::vector<Index> corners, without;
    Index face = 0;
    TextLines lines(bytes);
    while (lines.next_statement()) {
        const std::string_view keyword = lines.next_word_of_joined_lines();
        if (keyword == "vt") {
            auto& [u, v] = uvs.emplace_back();
            const std::string_view first = lines.next_word_of_joined_lines(),
                                   second = lines.next_word_of_joined_lines();
            if (!to_number(first, u) || (!second.empty() && !to_number(second, v)))
                refuse("texture coordinate", uvs.size() - 1, "is not two finite numbers");
        } else if (keyword == "f") {
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty();) {
                const std::size_t slash = std::min(word.find('/'), word.size() - 1);
                const std::string_view rest = word.substr(slash + 1);
                Index number = 0;  // counted from 1; if negative, from the last one backwards; 0: none
                if (!to_number(rest.substr(0, rest.find('/')), number)) number = 0;
                if (number == 0 && (without.empty() || without.back() != face)) without.push_back(face);
                corners.push_back(number > 0 ? number - 1 : static_cast<Index>(uvs.size()) + number);
            }
            ++face;
        }
        if (std::max(uvs.size(), corners.size()) >= most_elements) refuse_size();
    }
    if (uvs.empty()) return {};
    if (!without.empty())
        throw InputError("faces without texture coordinates (faces listed)", ElementKind::faces, without);
    PlanarPoints points(static_cast<Eigen::Index>(corners.size()), 2);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if (corners[c] < 0 || corners[c] >= static_cast<Index>(uvs.size()))
            throw InputError("a face names a texture coordinate that does not exist");
        points.row(static_cast<Eigen::Index>(c)) << uvs[corners[c]][0], uvs[corners[c]][1];
    }
    return points;
}

FileLosses obj_contents(std::string_view bytes)
{
    const ObjText text(bytes);
    return {text.texture_coordinates() > 0, text.contents()};
}

}  // namespace koebe::io
