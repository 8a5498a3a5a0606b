#include "io/ply_writer.h"

#include "io/text_writer.h"
#include "io/texture_coordinates.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

namespace koebe {
namespace {

using io::TextWriter;

/// The smallest type that all numbers of corners fit; nearly all readers expect the first.
std::string_view count_type(const PolygonMesh& mesh, std::size_t numbers_of_corner)
{
    std::size_t most = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) most = std::max(most, numbers_of_corner * mesh.face(f).size());
    if (most <= std::numeric_limits<unsigned char>::max()) return "uchar";
    return most <= std::numeric_limits<unsigned short>::max() ? "ushort" : "uint";
}

void add_header(TextWriter& text, const PolygonMesh& mesh, std::initializer_list<std::string_view> of_vertices,
                std::string_view of_faces)
{
    text.add("ply\nformat ascii 1.0\ncomment Koebe UV " KOEBE_VERSION "\nelement vertex ");
    text.add_number(mesh.vertices.rows());
    for (const std::string_view name : {"x", "y", "z"}) {
        text.add("\nproperty double ");
        text.add(name);
    }
    for (const std::string_view name : of_vertices) {
        text.add("\nproperty double ");
        text.add(name);
    }
    text.add("\nelement face ");
    text.add_number(mesh.face_count());
    text.add("\nproperty list ");
    text.add(count_type(mesh, 1));
    text.add(" int vertex_indices\n");
    text.add(of_faces);
    text.add("end_header\n");
}

void add_position(TextWriter& text, const Vertices& vertices, Eigen::Index v)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) text.add(' ');
        text.add_number(vertices(v, axis));
    }
}

void add_corners(TextWriter& text, std::span<const Index> face)
{
    text.add_number(face.size());
    for (const Index v : face) {
        text.add(' ');
        text.add_number(v);
    }
}

}  // namespace

void write_ply_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points)
{
    io::require_point_for_each_vertex(mesh, disk_points);
    TextWriter text(file);
    add_header(text, mesh, {"s", "t", "texture_u", "texture_v"}, "");
    text.add_each(static_cast<Index>(mesh.vertices.rows()), [&](TextWriter& part, Index v) {
        add_position(part, mesh.vertices, v);
        for (const int axis : {0, 1, 0, 1}) {
            part.add(' ');
            part.add_number(io::texture_coordinate(disk_points(v, axis)));
        }
        part.add('\n');
    });
    text.add_each(mesh.face_count(), [&](TextWriter& part, Index f) {
        add_corners(part, mesh.face(f));
        part.add('\n');
    });
    text.flush();
}

void write_ply_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs)
{
    io::require_point_for_each_corner(mesh, corner_uvs);
    TextWriter text(file);
    const std::string count(count_type(mesh, 2));
    add_header(text, mesh, {}, "property list " + count + " double texcoord\n");
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        add_position(text, mesh.vertices, v);
        text.add('\n');
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        add_corners(text, mesh.face(f));
        text.add(' ');
        text.add_number(2 * mesh.face(f).size());
        for (Index i = mesh.face_begin[f]; i < mesh.face_begin[f + 1]; ++i)
            for (int axis = 0; axis < 2; ++axis) {
                text.add(' ');
                text.add_number(corner_uvs(i, axis));
            }
        text.add('\n');
    }
    text.flush();
}

void write_ply_with_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch)
{
    TextWriter text(file);
    add_header(text, mesh, {}, "property int patch\n");
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        add_position(text, mesh.vertices, v);
        text.add('\n');
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        add_corners(text, mesh.face(f));
        text.add(' ');
        text.add_number(patch[static_cast<std::size_t>(f)]);
        text.add('\n');
    }
    text.flush();
}

}  // namespace koebe
