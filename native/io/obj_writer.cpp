#include "io/obj_writer.h"

#include "io/text_writer.h"
#include "io/texture_coordinates.h"

#include <algorithm>
#include <vector>

namespace koebe {
namespace {

using io::TextWriter;

void add_vertices(TextWriter& text, const Vertices& vertices)
{
    text.add("# Koebe UV " KOEBE_VERSION "\n");
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
        text.add('v');
        for (int axis = 0; axis < 3; ++axis) {
            text.add(' ');
            text.add_number(vertices(v, axis));
        }
        text.add('\n');
    }
}

void add_texture_coordinates(TextWriter& text, const PlanarPoints& disk_points)
{
    for (Eigen::Index v = 0; v < disk_points.rows(); ++v) {
        text.add('v');
        text.add('t');
        for (int axis = 0; axis < 2; ++axis) {
            text.add(' ');
            text.add_number(io::texture_coordinate(disk_points(v, axis)));
        }
        text.add('\n');
    }
}

void add_face(TextWriter& text, std::span<const Index> face, bool with_texture)
{
    text.add('f');
    for (const Index v : face) {
        text.add(' ');
        text.add_number(v + 1);
        if (!with_texture) continue;
        text.add('/');
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
    for (Index f = 0; f < mesh.face_count(); ++f) add_face(text, mesh.face(f), true);
    text.flush();
}

void write_obj_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uv)
{
    if (corner_uv.rows() != static_cast<Eigen::Index>(mesh.corners.size()))
        throw InputError("as many texture coordinates as corners are needed");
    TextWriter text(file);
    add_vertices(text, mesh.vertices);
    // Few places to a vertex: a list of those it has so far.
    std::vector<std::vector<Index>> places(static_cast<std::size_t>(mesh.vertices.rows()));
    std::vector<Index> number(mesh.corners.size()), first;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const auto uv = corner_uv.row(static_cast<Eigen::Index>(c));
        std::vector<Index>& known = places[mesh.corners[c]];
        const auto same = std::ranges::find_if(known, [&](Index place) { return (corner_uv.row(first[place]) == uv); });
        if (same != known.end()) {
            number[c] = *same;
            continue;
        }
        number[c] = static_cast<Index>(first.size());
        known.push_back(number[c]);
        first.push_back(static_cast<Index>(c));
        text.add("vt");
        for (int axis = 0; axis < 2; ++axis) {
            text.add(' ');
            text.add_number(uv[axis]);
        }
        text.add('\n');
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        text.add('f');
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            text.add(' ');
            text.add_number(mesh.corners[c] + 1);
            text.add('/');
            text.add_number(number[c] + 1);
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
