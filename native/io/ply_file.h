// A PLY file: its header, and the values behind it one after the other, text and binary of both byte orders.
#pragma once

#include "core/types.h"
#include "io/text_writer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float64;     ///< of a list: of its items
    std::optional<PlyType> length = {};  ///< of a list: of its number of items
    std::string line = {};               ///< of the header, without blanks at its end

    bool is_list() const { return length.has_value(); }
    bool is_real() const { return !length && (type == PlyType::float32 || type == PlyType::float64); }
};

/// What a property's values are to the mesh.
enum class PlyRole { x, y, z, corners, other };

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// The first of that name, or none.
    const PlyProperty* find(std::string_view wanted) const;
    bool is_vertex() const { return name == "vertex"; }
    bool is_face() const { return name == "face"; }
    PlyRole role(const PlyProperty& property) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyFile {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<std::string> comments;  ///< lines of comment and obj_info
    std::vector<PlyElement> elements;
    std::string_view data;  ///< what follows the header
};

/// @return the header of the bytes, which must outlive it; vertex_index, the other name in use, is vertex_indices
/// @throws InputError a line that is not one of a PLY header; a type or an encoding that no reader knows; a list of a
///         binary file whose lengths have 32 bits; a count that does not fit the file
PlyFile parse_ply(std::string_view bytes);

/// Whether the property is one of texture coordinates: of vertices under the names that programs give them, of faces
/// `texcoord`.
bool is_ply_uv(const PlyElement& element, const PlyProperty& property);
bool is_ply_normal(const PlyProperty& property);

/// Goes over the values of a file. Every call returns false, and nothing is of use then, if the next one is missing or
/// is no number of its type; in a text all types but those of lengths and corners are any number.
class PlyValues {
public:
    explicit PlyValues(const PlyFile& file) : data_(file.data), encoding_(file.encoding) {}

    bool read(PlyType type, double& number);
    bool read(PlyType type, Index& number);
    /// The value, or the length and the items of a list.
    bool skip(const PlyProperty& property);
    bool skip_item(const PlyElement& element);
    /// Adds them as text, a blank before each but perhaps the first: of a text its words, of a binary the shortest that
    /// read back to the same number.
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
