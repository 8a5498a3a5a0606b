#include "io/obj_writer.h"

#include "core/errors.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace koebe {
namespace {

/// Text to a file through a buffer that stays in the processor's cache.
class TextWriter {
public:
    explicit TextWriter(AtomicFile& file) : file_(file), buffer_(std::size_t{1} << 16, '\0') {}

    void add(char c)
    {
        reserve(1);
        buffer_[used_++] = c;
    }
    void add(std::string_view word)
    {
        for (const char c : word) add(c);
    }
    template <typename Number>
    void add_number(Number number)
    {
        reserve(longest_number);
        char* const here = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(here, here + longest_number, number).ptr - here);
    }
    void flush()
    {
        file_.write({buffer_.data(), used_});
        used_ = 0;
    }

private:
    static constexpr std::size_t longest_number = 24;  // bytes: -1.2345678901234567e-308
    void reserve(std::size_t count)
    {
        if (used_ + count > buffer_.size()) flush();
    }

    AtomicFile& file_;
    std::string buffer_;
    std::size_t used_ = 0;
};

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
            text.add_number(std::clamp(0.5 * (1.0 + disk_points(v, axis)), 0.0, 1.0));
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
    if (disk_points.rows() != mesh.vertices.rows())
        throw InputError("as many points of the disk as vertices are needed");
    TextWriter text(file);
    add_vertices(text, mesh.vertices);
    add_texture_coordinates(text, disk_points);
    for (Index f = 0; f < mesh.face_count(); ++f) add_face(text, mesh.face(f), true);
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
