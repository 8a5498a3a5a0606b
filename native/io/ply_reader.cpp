// Polygon File Format, text and binary [Greg Turk, The PLY Polygon File Format, 1994].
#include "io/format_readers.h"

#include "core/errors.h"
#include "io/byte_cursor.h"
#include "io/text_scanner.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace koebe::io {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    Type type = Type::float32;
    bool is_list = false;
    Type length_type = Type::uint8;
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;

    /// @throws InputError the element has no such property
    std::size_t require(const std::string& property, bool is_list) const
    {
        for (std::size_t p = 0; p < properties.size(); ++p)
            if (properties[p].name == property && properties[p].is_list == is_list) return p;
        throw InputError("the header gives element " + name + " no " + (is_list ? "list " : "number ") + property);
    }
};

struct Header {
    bool text = true;
    std::endian order = std::endian::little;
    std::vector<Element> elements;
};

Type read_type(TextScanner& text)
{
    const TextScanner before = text;
    const std::string_view word = text.word();
    if (word == "char" || word == "int8") return Type::int8;
    if (word == "uchar" || word == "uint8") return Type::uint8;
    if (word == "short" || word == "int16") return Type::int16;
    if (word == "ushort" || word == "uint16") return Type::uint16;
    if (word == "int" || word == "int32") return Type::int32;
    if (word == "uint" || word == "uint32") return Type::uint32;
    if (word == "float" || word == "float32") return Type::float32;
    if (word == "double" || word == "float64") return Type::float64;
    text = before;
    text.fail("a PLY type");
}

Property read_property(TextScanner& text)
{
    Property property;
    const TextScanner before = text;
    property.is_list = text.word() == "list";
    if (property.is_list)
        property.length_type = read_type(text);
    else
        text = before;
    property.type = read_type(text);
    property.name = text.word();
    return property;
}

void read_format(TextScanner& text, Header& header)
{
    const TextScanner before = text;
    const std::string_view format = text.word();
    header.text = format == "ascii";
    header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (header.text || format == "binary_big_endian" || format == "binary_little_endian") return;
    text = before;
    text.fail("ascii, binary_little_endian or binary_big_endian");
}

/// Leaves the scanner on the first byte after the header's last line.
Header read_header(TextScanner& text)
{
    Header header;
    if (text.word() != "ply") throw InputError("the file does not start with 'ply'");
    for (text.skip_line(); text.seek_word(); text.skip_line()) {
        const TextScanner before = text;
        const std::string_view keyword = text.word();
        if (keyword == "end_header") {
            text.skip_line();
            return header;
        }
        if (keyword == "format") {
            read_format(text, header);
        } else if (keyword == "element") {
            Element& element = header.elements.emplace_back();
            element.name = text.word();
            const long long count = text.integer();
            if (count < 0) throw InputError("the header counts element " + element.name + " below zero");
            element.count = static_cast<std::size_t>(count);
        } else if (keyword == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(read_property(text));
        } else if (keyword != "comment" && keyword != "obj_info") {
            text = before;
            text.fail("a line of a PLY header");
        }
    }
    throw InputError("the header has no 'end_header'");
}

/// Values of a text file are words; lines have no meaning.
struct TextSource {
    TextScanner& text;
    std::size_t bytes_left() const { return text.bytes_left(); }
    double read(Type)
    {
        if (!text.seek_word()) text.fail("a number");
        return text.number();
    }
};

struct BinarySource {
    ByteCursor bytes;
    std::size_t bytes_left() const { return bytes.bytes_left(); }
    double read(Type type)
    {
        switch (type) {
            case Type::int8: return bytes.read<std::int8_t>();
            case Type::uint8: return bytes.read<std::uint8_t>();
            case Type::int16: return bytes.read<std::int16_t>();
            case Type::uint16: return bytes.read<std::uint16_t>();
            case Type::int32: return bytes.read<std::int32_t>();
            case Type::uint32: return bytes.read<std::uint32_t>();
            case Type::float32: return bytes.read<float>();
            case Type::float64: return bytes.read<double>();
        }
        return 0.0;
    }
};

/// The length of a list; each of its values takes a byte at least.
template <typename Source>
std::size_t read_length(Source& source, Type type)
{
    const double length = source.read(type);
    if (!(length >= 0.0 && length <= static_cast<double>(source.bytes_left())))
        throw InputError("a list's length does not fit the file");
    return static_cast<std::size_t>(length);
}

/// Calls use(property number, value) for every value of one item.
template <typename Source, typename Use>
void read_item(Source& source, const Element& element, Use&& use)
{
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        const std::size_t length = property.is_list ? read_length(source, property.length_type) : 1;
        for (std::size_t i = 0; i < length; ++i) use(p, source.read(property.type));
    }
}

template <typename Source>
void read_vertices(Source& source, const Element& element, MeshBuilder& mesh)
{
    const std::array<std::size_t, 3> axes{element.require("x", false), element.require("y", false),
                                          element.require("z", false)};
    for (std::size_t v = 0; v < element.count; ++v) {
        std::array<double, 3> position{};
        read_item(source, element, [&](std::size_t property, double value) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (property == axes[axis]) position[axis] = value;
        });
        mesh.add_vertex(position);
    }
}

template <typename Source>
void read_faces(Source& source, const Element& element, MeshBuilder& mesh)
{
    bool old_name = false;
    for (const Property& property : element.properties) old_name = old_name || property.name == "vertex_index";
    const std::size_t corners = element.require(old_name ? "vertex_index" : "vertex_indices", true);
    for (std::size_t f = 0; f < element.count; ++f) {
        read_item(source, element, [&](std::size_t property, double value) {
            if (property != corners) return;
            const bool is_index = value == std::floor(value) && std::abs(value) < 1e15;
            mesh.add_corner(is_index ? to_index(static_cast<long long>(value)) : Index{-1});
        });
        mesh.end_face();
    }
}

template <typename Source>
PolygonMesh read_elements(Source source, const Header& header)
{
    MeshBuilder mesh;
    for (const Element& element : header.elements) {
        if (element.count > source.bytes_left() && !element.properties.empty())
            throw InputError("the header's number of element " + element.name + " does not fit the file");
        if (element.name == "vertex")
            read_vertices(source, element, mesh);
        else if (element.name == "face")
            read_faces(source, element, mesh);
        else if (!element.properties.empty())
            for (std::size_t i = 0; i < element.count; ++i) read_item(source, element, [](std::size_t, double) {});
    }
    return mesh.finish();
}

}  // namespace

PolygonMesh read_ply(std::string_view bytes)
{
    TextScanner text(bytes);
    const Header header = read_header(text);
    if (header.text) return read_elements(TextSource{text}, header);
    return read_elements(BinarySource{ByteCursor(bytes, text.position(), header.order)}, header);
}

}  // namespace koebe::io
