#include "io/obj_writer.h"

#include "io/text_writer.h"
#include "io/texture_coordinates.h"

#include <algorithm>

namespace koebe {
namespace {

using io::TextWriter;

void add_vertices(TextWriter& text, const Vertices& vertices)
{
    text.add("# Koebe UV " KOEBE_VERSION "\n");
    text.add_each(static_cast<Index>(vertices.rows()), [&](TextWriter& part, Index v) {
        part.add('v');
        for (int axis = 0; axis < 3; ++axis) {
            part.add(' ');
            part.add_number(vertices(v, axis));
        }
        part.add('\n');
    });
}

void add_texture_coordinate(TextWriter& text, const Eigen::RowVector2d& uv)
{
    text.add("vt ");
    text.add_number(uv[0]);
    text.add(' ');
    text.add_number(uv[1]);
    text.add('\n');
}

/// (C) numbers of the places, by first appearance.
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

void add_texture_coordinates(TextWriter& text, const PlanarPoints& disk_points)
{
    text.add_each(static_cast<Index>(disk_points.rows()), [&](TextWriter& part, Index v) {
        part.add('v');
        part.add('t');
        for (int axis = 0; axis < 2; ++axis) {
            part.add(' ');
            part.add_number(io::texture_coordinate(disk_points(v, axis)));
        }
        part.add('\n');
    });
}

void add_face(TextWriter& text, std::span<const Index> face, bool with_texture)
{
    text.add('f');
    for (const Index v : face) {
        text.add(' ');
        if (with_texture)
            text.add_twice(v + 1, '/');
        else
            text.add_number(v + 1);
    }
    text.add('\n');
}

}  // namespace

void write_obj_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points)
{
    io::require_point_for_each_vertex(mesh, disk_points);
    TextWriter text(file);
    add_vertices(text, mesh.vertices);
    add_texture_coordinates(text, disk_points);
    text.add_each(mesh.face_count(), [&](TextWriter& part, Index f) { add_face(part, mesh.face(f), true); });
    text.flush();
}

void write_obj_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs)
{
    io::require_point_for_each_corner(mesh, corner_uvs);
    TextWriter text(file);
    add_vertices(text, mesh.vertices);
    const std::vector<Index> place = places_of_corners(mesh, corner_uvs);
    Index count = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] < count) continue;
        ++count;
        add_texture_coordinate(text, corner_uvs.row(static_cast<Eigen::Index>(i)));
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        text.add('f');
        for (Index i = mesh.face_begin[f]; i < mesh.face_begin[f + 1]; ++i) {
            text.add(' ');
            text.add_number(mesh.corners[i] + 1);
            text.add('/');
            text.add_number(place[i] + 1);
        }
        text.add('\n');
    }
    text.flush();
}

void write_obj_with_groups(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& group,
                           const std::vector<std::string>& names)
{
    TextWriter text(file);
    add_vertices(text, mesh.vertices);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (f == 0 || group[f] != group[f - 1]) {
            text.add("g ");
            text.add(names.at(static_cast<std::size_t>(group[f])));
            text.add('\n');
        }
        add_face(text, mesh.face(f), false);
    }
    text.flush();
}

}  // namespace koebe
