// A PLY file: its header and its values in order, text and binary of both byte orders.
#pragma once

#include "core/types.h"
#include "files/text_writer.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float64;     ///< of a value, or of a list's items
    std::optional<PlyType> length = {};  ///< of a list's number of items
    std::string line = {};               ///< in the header, without blanks at its end

    bool is_list() const { return length.has_value(); }
    bool is_real() const { return !length && (type == PlyType::float32 || type == PlyType::float64); }
};

/// The meaning of a property for the mesh.
enum class PlyRole { x, y, z, corners, other };

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// The first property of that name, or null.
    const PlyProperty* find(std::string_view wanted) const;
    bool is_vertex() const { return name == "vertex"; }
    bool is_face() const { return name == "face"; }
    /// Strips of triangles, in a row with -1 after each.
    bool is_strips() const { return name == "tristrips"; }
    bool has_corners() const { return is_face() || is_strips(); }
    PlyRole role(const PlyProperty& property) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyFile {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<std::string> comments;  ///< lines of comment and obj_info
    std::vector<PlyElement> elements;
    std::string_view data;  ///< the bytes after the header
};

/// Bytes of a line's end, which may follow the elements of a binary file.
inline constexpr std::size_t most_line_end = 2;

/// @return the header of the bytes, which must outlive it; the name vertex_index is changed to vertex_indices
/// @throws InputError a line that does not belong to a PLY header; an unknown type or encoding; a count that does not
/// fit the file
PlyFile parse_ply(std::string_view bytes);

/// Whether a PLY file has triangle strips. @throws InputError as parse_ply
bool has_ply_strips(std::string_view bytes);

/// Whether the property holds texture coordinates: for vertices under the names that programs use, for faces
/// `texcoord`.
bool is_ply_uv(const PlyElement& element, const PlyProperty& property);
bool is_ply_normal(const PlyProperty& property);

/// Reads the values of a file in order. Every call returns false, and its result is unusable, if the next value is
/// missing or not a number of its type. In text all types except those of lengths and corners accept any number.
class PlyValues {
public:
    explicit PlyValues(const PlyFile& file) : data_(file.data), encoding_(file.encoding) {}

    bool read(PlyType type, double& number);
    bool read(PlyType type, Index& number);
    /// Skips the value, or the length and the items of a list.
    bool skip(const PlyProperty& property);
    bool skip_item(const PlyElement& element);
    /// Whether nothing follows but blanks of a text, or the end of a line.
    bool is_at_end() const;
    /// Adds the values as text, each after a blank except perhaps the first: the words of a text, or for a binary file
    /// the shortest ones that read back to the same number.
    bool copy(const PlyProperty& property, TextWriter& text, bool blank_first);

private:
    template <class Use>
    bool with_number(PlyType type, const Use& use);
    template <class Use>
    bool with_items(const PlyProperty& property, const Use& use);

    std::string_view data_;
    PlyEncoding encoding_;
};

}  // namespace koebe::io
