#include "io/format_readers.h"
#include "io/obj_text.h"
#include "io/refusals.h"
#include "io/text_lines.h"

#include <algorithm>
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

FileLosses obj_contents(std::string_view bytes)
{
    const ObjText text(bytes);
    return {text.texture_coordinates() > 0, text.contents()};
}

}  // namespace koebe::io
