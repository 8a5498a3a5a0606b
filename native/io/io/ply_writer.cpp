#include "io/ply_writer.h"

#include "files/text_writer.h"
#include "io/ply_file.h"
#include "io/texture_coordinates.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace koebe {
namespace {

using io::TextWriter;

/// The smallest type for the numbers of all corners; nearly all readers expect the smallest one.
std::string_view count_type(const PolygonMesh& mesh, std::size_t numbers_of_corner)
{
    std::size_t most = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) most = std::max(most, numbers_of_corner * mesh.face(f).size());
    if (most <= std::numeric_limits<unsigned char>::max()) return "uchar";
    return most <= std::numeric_limits<unsigned short>::max() ? "ushort" : "uint";
}

constexpr std::string_view own_comment = "comment Koebe UV ";

/// The properties added after a file's own properties of vertices and faces.
struct Added {
    std::string of_vertices, of_faces;                           // lines of the header
    std::function<void(TextWriter&, Index)> to_vertex, to_face;  // each value after a blank
};

/// The header for a mesh without a file.
io::PlyFile file_of(const PolygonMesh& mesh)
{
    io::PlyFile file;
    file.elements = {{"vertex", static_cast<std::size_t>(mesh.vertices.rows()), {{"x"}, {"y"}, {"z"}}},
                     {"face", static_cast<std::size_t>(mesh.face_count()), {{"vertex_indices"}}}};
    return file;
}

/// An element as it is written.
struct Column {
    const io::PlyProperty* property;
    io::PlyRole role;
    bool kept;  // written from the file or the mesh
    bool from_file() const { return kept && role == io::PlyRole::other; }
};

class PlyWriter {
public:
    PlyWriter(AtomicFile& file, const PolygonMesh& mesh, const FiledText& filed, const Added& added)
        : text_(file),
          mesh_(mesh),
          added_(added),
          file_(filed.bytes.empty() ? file_of(mesh) : io::parse_ply(filed.bytes)),
          values_(file_)
    {
        for (const io::PlyElement& element : file_.elements) choose_columns(element, filed.moved);
        add_header();
        for (std::size_t e = 0; e < file_.elements.size(); ++e) add_items(file_.elements[e], columns_[e]);
        text_.flush();
    }

    io::FileLosses losses;

private:
    void choose_columns(const io::PlyElement& element, bool moved)
    {
        std::vector<Column>& columns = columns_.emplace_back();
        for (const io::PlyProperty& property : element.properties) {
            const bool is_uv = io::is_ply_uv(element, property), is_normal = io::is_ply_normal(property);
            losses.texture_coordinates |= is_uv;
            if (is_normal && moved && losses.others.empty()) losses.others.emplace_back("normals");
            columns.push_back({&property, element.role(property), !is_uv && !(is_normal && moved)});
            needs_values_ |= columns.back().from_file();
        }
    }

    void add_header()
    {
        text_.add("ply\nformat ascii 1.0\ncomment Koebe UV " KOEBE_VERSION "\n");
        for (const std::string& comment : file_.comments)
            if (!comment.starts_with(own_comment)) add_line(comment);
        for (std::size_t e = 0; e < file_.elements.size(); ++e) {
            const io::PlyElement& element = file_.elements[e];
            add_line("element " + element.name + ' ' + std::to_string(element.count));
            for (const Column& column : columns_[e]) {
                if (column.role == io::PlyRole::corners)
                    add_line("property list " + std::string(count_type(mesh_, 1)) + " int vertex_indices");
                else if (column.kept)
                    add_line(column.from_file() ? column.property->line : "property double " + column.property->name);
            }
            if (element.is_vertex()) text_.add(added_.of_vertices);
            if (element.is_face()) text_.add(added_.of_faces);
        }
        text_.add("end_header\n");
    }

    void add_line(std::string_view line)
    {
        text_.add(line);
        text_.add('\n');
    }

    /// Uses this thread's share of threads. If values come from the file, a first pass finds where the items of each
    /// thread begin.
    void add_items(const io::PlyElement& element, const std::vector<Column>& columns)
    {
        const auto count = static_cast<Index>(element.count);
        const Index first = element.is_vertex() ? std::exchange(vertices_, vertices_ + count)
                            : element.is_face() ? std::exchange(faces_, faces_ + count)
                                                : 0;
        if (!needs_values_)
            return text_.add_each(
                count, [&](TextWriter& part, Index i) { add_item(part, element, columns, first + i, nullptr); });
        constexpr Index at_a_time = 8192;
        std::vector<io::PlyValues> begins;
        for (Index i = 0; i < count; ++i) {
            if (i % at_a_time == 0) begins.push_back(values_);
            values_.skip_item(element);
        }
        const auto add_some = [&](TextWriter& part, Index k) {
            io::PlyValues values = begins[static_cast<std::size_t>(k)];
            for (Index i = k * at_a_time; i < std::min(count, (k + 1) * at_a_time); ++i)
                add_item(part, element, columns, first + i, &values);
        };
        text_.add_each(static_cast<Index>(begins.size()), add_some, 1);
    }

    /// @param number of the vertex or face
    void add_item(TextWriter& text, const io::PlyElement& element, const std::vector<Column>& columns, Index number,
                  io::PlyValues* values) const
    {
        bool is_first = true;
        for (const Column& column : columns) {
            if (column.from_file()) {
                values->copy(*column.property, text, !is_first);
            } else {
                if (values) values->skip(*column.property);
                if (!column.kept) continue;
                if (!is_first) text.add(' ');
                if (column.role == io::PlyRole::corners)
                    add_corners(text, mesh_.face(number));
                else
                    text.add_number(mesh_.vertices(number, static_cast<int>(column.role)));
            }
            is_first = false;
        }
        if (element.is_vertex() && added_.to_vertex) added_.to_vertex(text, number);
        if (element.is_face() && added_.to_face) added_.to_face(text, number);
        text.add('\n');
    }

    static void add_corners(TextWriter& text, std::span<const Index> face)
    {
        text.add_number(face.size());
        for (const Index v : face) {
            text.add(' ');
            text.add_number(v);
        }
    }

    TextWriter text_;
    const PolygonMesh& mesh_;
    const Added& added_;
    const io::PlyFile file_;
    io::PlyValues values_;
    std::vector<std::vector<Column>> columns_;
    bool needs_values_ = false;
    Index vertices_ = 0, faces_ = 0;  // number already written
};

void add_after_blank(TextWriter& text, double number)
{
    text.add(' ');
    text.add_number(number);
}

}  // namespace

io::FileLosses write_ply_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points,
                                  const FiledText& filed)
{
    io::require_point_for_each_vertex(mesh, disk_points);
    Added added;
    for (const char* name : {"s", "t", "texture_u", "texture_v"})
        added.of_vertices += std::string("property double ") + name + '\n';
    added.to_vertex = [&](TextWriter& text, Index v) {
        for (const int axis : {0, 1, 0, 1}) add_after_blank(text, io::texture_coordinate(disk_points(v, axis)));
    };
    return PlyWriter(file, mesh, filed, added).losses;
}

io::FileLosses write_ply_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs,
                                         const FiledText& filed)
{
    io::require_point_for_each_corner(mesh, corner_uvs);
    Added added;
    added.of_faces = "property list " + std::string(count_type(mesh, 2)) + " double texcoord\n";
    added.to_face = [&](TextWriter& text, Index f) {
        text.add(' ');
        text.add_number(2 * mesh.face(f).size());
        for (Index i = mesh.face_begin[f]; i < mesh.face_begin[f + 1]; ++i)
            for (int axis = 0; axis < 2; ++axis) add_after_blank(text, corner_uvs(i, axis));
    };
    return PlyWriter(file, mesh, filed, added).losses;
}

void write_ply_with_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch)
{
    Added added;
    added.of_faces = "property int patch\n";
    added.to_face = [&](TextWriter& text, Index f) {
        text.add(' ');
        text.add_number(patch[static_cast<std::size_t>(f)]);
    };
    const PlyWriter written(file, mesh, {}, added);
}

}  // namespace koebe
