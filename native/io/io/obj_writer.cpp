#include "io/obj_writer.h"

#include "core/counted.h"
#include "files/text_writer.h"
#include "io/obj_text.h"
#include "io/texture_coordinates.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

namespace koebe {
namespace {

using io::TextWriter;

constexpr std::string_view first_line = "# Koebe UV " KOEBE_VERSION;

void add_vertices(TextWriter& text, const Vertices& vertices, Index begin)
{
    text.add_each(static_cast<Index>(vertices.rows()) - begin, [&](TextWriter& part, Index i) {
        part.add('v');
        for (int axis = 0; axis < 3; ++axis) {
            part.add(' ');
            part.add_number(vertices(begin + i, axis));
        }
        part.add('\n');
    });
}

/// (C) numbers of the corners' places, by first appearance.
std::vector<Index> places_of_corners(const PolygonMesh& mesh, const PlanarPoints& corner_uvs)
{
    std::vector<Index> place(mesh.corners.size());
    std::vector<std::vector<Index>> first_corners(static_cast<std::size_t>(mesh.vertices.rows()));  // of each place
    Index count = 0;
    for (Index i = 0; i < static_cast<Index>(place.size()); ++i) {
        auto& first = first_corners[mesh.corners[i]];
        const auto same = std::ranges::find_if(first, [&](Index j) { return corner_uvs.row(i) == corner_uvs.row(j); });
        place[i] = same != first.end() ? place[*same] : count++;
        if (same == first.end()) first.push_back(i);
    }
    return place;
}

void add_texture_coordinate(TextWriter& text, double u, double v, std::string_view end_of_line)
{
    text.add("vt ");
    text.add_number(u);
    text.add(' ');
    text.add_number(v);
    text.add(end_of_line);
}

/// @param texture (C) numbers of texture coordinates, or empty
void add_face(TextWriter& text, const PolygonMesh& mesh, Index f, std::span<const Index> texture)
{
    text.add('f');
    for (Index corner = mesh.face_begin[f]; corner < mesh.face_begin[f + 1]; ++corner) {
        text.add(' ');
        const Index vertex = mesh.corners[corner];
        if (texture.empty())
            text.add_number(vertex + 1);
        else
            io::add_obj_corner(text, vertex, texture[corner]);
    }
    text.add('\n');
}

/// Writes the mesh, or the text that it was read from, with texture coordinates between vertices and faces.
/// @param texture (C) numbers of texture coordinates
template <class AddTextureCoordinates>
io::FileLosses write_obj(AtomicFile& file, const PolygonMesh& mesh, std::span<const Index> texture,
                         const FiledText& filed, const AddTextureCoordinates& add_texture_coordinates)
{
    TextWriter text(file);
    text.add(first_line);
    // A mesh without a file of its own is written plainly.
    if (filed.bytes.empty()) {
        text.add('\n');
        add_vertices(text, mesh.vertices, 0);
        add_texture_coordinates(text, "\n");
        text.add_each(mesh.face_count(), [&](TextWriter& part, Index f) { add_face(part, mesh, f, texture); });
        text.flush();
        return {};
    }
    // Else its text is kept: what stands before the faces, our coordinates, and the rest with new numbers.
    const io::ObjText own(filed.bytes);
    const io::ObjChange change{.mesh = mesh, .texture = texture, .moved = filed.moved};
    text.add(own.end_of_line());
    own.add_head(text, change);
    add_texture_coordinates(text, own.end_of_line());
    const std::size_t without_normals = own.add_rest(text, change);
    text.flush();
    // What the text had, and the new one has not.
    io::FileLosses losses{own.texture_coordinates() > 0, {}};
    if (filed.moved && own.normals() > 0) losses.others.emplace_back("normals");
    if (without_normals > 0)
        losses.others.push_back("normals of " + counted(without_normals, "face") + " that name a missing one");
    return losses;
}

}  // namespace

io::FileLosses write_obj_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points,
                                  const FiledText& filed)
{
    io::require_point_for_each_vertex(mesh, disk_points);
    return write_obj(file, mesh, mesh.corners, filed, [&](TextWriter& text, std::string_view end_of_line) {
        text.add_each(static_cast<Index>(disk_points.rows()), [&](TextWriter& part, Index v) {
            add_texture_coordinate(part, io::texture_coordinate(disk_points(v, 0)),
                                   io::texture_coordinate(disk_points(v, 1)), end_of_line);
        });
    });
}

io::FileLosses write_obj_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs,
                                         const FiledText& filed)
{
    io::require_point_for_each_corner(mesh, corner_uvs);
    const std::vector<Index> place = places_of_corners(mesh, corner_uvs);
    return write_obj(file, mesh, place, filed, [&](TextWriter& text, std::string_view end_of_line) {
        Index count = 0;
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (place[i] < count) continue;
            ++count;
            const auto uv = corner_uvs.row(static_cast<Eigen::Index>(i));
            add_texture_coordinate(text, uv[0], uv[1], end_of_line);
        }
    });
}

void write_obj_with_groups(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& group,
                           const std::vector<std::string>& names, const FiledText& filed)
{
    TextWriter text(file);
    text.add(first_line);
    text.add('\n');
    Index last = -1;
    const auto add_group = [&](Index f) {
        if (group[f] == std::exchange(last, group[f])) return;
        text.add("g ");
        text.add(names.at(static_cast<std::size_t>(group[f])));
        text.add('\n');
    };
    Index first_vertex = 0, first_face = 0;
    // The file's own statements first, as they are; then what is new.
    if (!filed.bytes.empty()) {
        const io::ObjText own(filed.bytes);
        const io::ObjChange change{.mesh = mesh, .texture = {}};
        own.add_head(text, change);
        if (!own.holds("groups")) add_group(0);
        own.add_rest(text, change);
        first_vertex = static_cast<Index>(own.vertices());
        first_face = static_cast<Index>(own.faces());
    }
    add_vertices(text, mesh.vertices, first_vertex);
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        add_group(f);
        add_face(text, mesh, f, {});
    }
    text.flush();
}

}  // namespace koebe
