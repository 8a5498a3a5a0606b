#include "core/errors.h"
#include "files/text_lines.h"
#include "io/format_readers.h"
#include "io/obj_text.h"
#include "io/refusals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace koebe::io {
namespace {

/// Numbers for values, in the order in which they are met.
template <typename Value>
class NumberedValues {
public:
    Index number(const Value& value)
    {
        return numbers_.emplace(value, static_cast<Index>(numbers_.size())).first->second;
    }

private:
    std::map<Value, Index> numbers_;
};

}  // namespace

/// CGAL is not used, as it makes a stream of each line, which takes a third of the command's whole time. tinyobjloader
/// changes the last digits of numbers, and Assimp keeps 32 bits.
PolygonMesh read_obj(std::string_view bytes)
{
    if (const std::size_t zero = bytes.find('\0'); zero != std::string_view::npos)
        throw InputError("byte " + std::to_string(zero) + " of the OBJ file is no text");
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
            // A weight or a colour may follow, also one that is not finite; a second statement may not.
            double more = 0.0;
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty(); more = 0.0)
                if (!to_number(word, more) && std::isfinite(more))
                    refuse("vertex", vertex_count, "has words after its numbers in one line");
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

/// Materials are the names of usemtl, groups the lines of g and o, normals the values of vn.
std::vector<Index> obj_corner_marks(std::string_view bytes, CutAt at)
{
    const auto wanted = [at](CutAt kind) { return at == kind || at == CutAt::all; };
    NumberedValues<std::string> names;
    NumberedValues<std::array<double, 3>> values;
    NumberedValues<std::array<Index, 4>> marks;
    std::vector<Index> normals, corners;
    std::array<Index, 4> mark{};  // material, group, object, normal
    TextLines lines(bytes);
    while (lines.next_statement()) {
        const std::string_view keyword = lines.next_word_of_joined_lines();
        const auto name = [&] {
            std::string words(keyword);
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty();)
                words.append(1, ' ').append(word);
            return names.number(words);
        };
        if (keyword == "usemtl" && wanted(CutAt::materials)) mark[0] = name();
        if (keyword == "g" && wanted(CutAt::groups)) mark[1] = name();
        if (keyword == "o" && wanted(CutAt::groups)) mark[2] = name();
        if (keyword == "vn" && wanted(CutAt::normals)) {
            std::array<double, 3> normal{};
            for (double& number : normal)
                if (!to_number(lines.next_word_of_joined_lines(), number))
                    refuse("normal", normals.size(), "is not three finite numbers");
            normals.push_back(values.number(normal));
        }
        if (keyword == "f")
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty();) {
                const std::size_t last = word.rfind('/');
                const bool has_normal = last != std::string_view::npos && word.find('/') != last;
                const auto count = static_cast<Index>(normals.size());
                Index number = 0;  // counted from 1; if negative, from the last one backwards; 0: none
                if (!has_normal || !to_number(word.substr(last + 1), number)) number = 0;
                if (number < 0) number += count + 1;
                mark[3] = number > 0 && number <= count ? normals[static_cast<std::size_t>(number) - 1] : -1;
                corners.push_back(marks.number(mark));
            }
        if (std::max(normals.size(), corners.size()) >= most_elements) refuse_size();
    }
    return corners;
}

FileLosses obj_contents(std::string_view bytes)
{
    const ObjText text(bytes);
    return {text.texture_coordinates() > 0, text.contents()};
}

}  // namespace koebe::io
