#include "io/ply_file.h"

#include "core/errors.h"
#include "files/text_lines.h"
#include "io/refusals.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

namespace koebe::io {
namespace {

using Words = std::vector<std::string>;

std::optional<PlyType> type_of(const std::string& word)
{
    static const std::map<std::string_view, PlyType> types{
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    const auto found = types.find(word);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

bool is_whole(PlyType type) { return type < PlyType::float32; }

/// Returns nothing without a property.
std::optional<PlyProperty> property_of(const Words& words)
{
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) return {};
    const auto type = type_of(words[is_list ? 3 : 1]);
    if (!type) return {};
    PlyProperty property{words.back() == "vertex_index" ? "vertex_indices" : words.back(), *type, {}, {}};
    if (is_list) {
        property.length = type_of(words[2]);
        if (!property.length || !is_whole(*property.length)) return {};
        if (*property.length == PlyType::int8) property.length = PlyType::uint8;
        if (*property.length == PlyType::int16) property.length = PlyType::uint16;
    }
    for (const std::string& word : words) property.line += (property.line.empty() ? "" : " ") + word;
    return property;
}

std::optional<PlyEncoding> encoding_of(const std::string& word)
{
    if (word == "ascii") return PlyEncoding::text;
    if (word == "binary_little_endian") return PlyEncoding::little_endian;
    if (word == "binary_big_endian") return PlyEncoding::big_endian;
    return {};
}

/// @throws InputError the count does not fit the file
PlyElement element_of(const Words& words, std::size_t bytes)
{
    PlyElement element{words[1], 0, {}};
    const char* const last = words[2].data() + words[2].size();
    const auto [end, error] = std::from_chars(words[2].data(), last, element.count);
    if (error != std::errc() || end != last) element.count = std::string_view::npos;
    require_count_fits(element.count, element.name, bytes);
    return element;
}

/// Takes a line of the header. @return false if it does not belong to a header
bool take_header_line(PlyFile& file, const std::string& line, int number, bool& has_format, std::size_t bytes)
{
    std::istringstream stream(line);
    const Words words(std::istream_iterator<std::string>(stream), {});
    if (words.empty()) return true;
    // Each word of the header in its order: ply, format, element, property. Any other is no header.
    if (words[0] == "comment" || words[0] == "obj_info") {
        file.comments.push_back(line.substr(0, line.find_last_not_of(" \t\r") + 1));
        return true;
    }
    if (words[0] == "property" && !file.elements.empty()) {
        auto property = property_of(words);
        if (property) file.elements.back().properties.push_back(std::move(*property));
        return property.has_value();
    }
    if (words[0] == "format" && words.size() == 3 && !has_format) {
        const auto encoding = encoding_of(words[1]);
        if (!encoding) throw InputError("the header's format or a count is not one of PLY");
        file.encoding = *encoding;
        return has_format = true;
    }
    if (words[0] == "element" && words.size() == 3 && has_format) {
        file.elements.push_back(element_of(words, bytes));
        return true;
    }
    return number == 1 && words[0] == "ply";
}

template <class Number>
Number decoded(const char* place, bool swapped)
{
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), place, sizeof(Number));
    if (swapped) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
}

}  // namespace

std::size_t bytes_of(PlyType type)
{
    constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

const PlyProperty* PlyElement::find(std::string_view wanted) const
{
    const auto found = std::ranges::find(properties, wanted, &PlyProperty::name);
    return found == properties.end() ? nullptr : &*found;
}

PlyRole PlyElement::role(const PlyProperty& property) const
{
    for (const auto& [axis, role] : {std::pair{"x", PlyRole::x}, {"y", PlyRole::y}, {"z", PlyRole::z}})
        if (is_vertex() && &property == find(axis)) return role;
    return has_corners() && &property == find("vertex_indices") ? PlyRole::corners : PlyRole::other;
}

bool is_ply_uv(const PlyElement& element, const PlyProperty& property)
{
    const auto is = [&](std::initializer_list<std::string_view> names) {
        return std::ranges::find(names, property.name) != names.end();
    };
    if (element.is_face()) return is({"texcoord"});
    if (!element.is_vertex()) return false;
    // u or v alone can mean anything.
    return is({"s", "t", "texture_u", "texture_v", "texture_s", "texture_t"}) ||
           (is({"u", "v"}) && element.find("u") && element.find("v"));
}

bool is_ply_normal(const PlyProperty& property)
{
    return property.name == "nx" || property.name == "ny" || property.name == "nz";
}

PlyFile parse_ply(std::string_view bytes)
{
    if (!bytes.starts_with("ply")) throw InputError("the file does not start with 'ply'");
    const std::size_t end = bytes.find("\nend_header"), data = bytes.find('\n', end + 1);
    if (end == bytes.npos || data == bytes.npos) throw InputError("the header has no 'end_header'");
    PlyFile file;
    file.data = bytes.substr(data + 1);
    std::istringstream lines{std::string(bytes.substr(0, end))};
    std::string line;
    bool has_format = false;
    for (int number = 1; std::getline(lines, line); ++number)
        if (!take_header_line(file, line, number, has_format, bytes.size()))
            throw InputError("line " + std::to_string(number) + " of the header is not supported");
    if (!has_format) throw InputError("the header's format or a count is not one of PLY");
    return file;
}

bool has_ply_strips(std::string_view bytes)
{
    return std::ranges::any_of(parse_ply(bytes).elements, &PlyElement::is_strips);
}

/// Calls use(number) with the next number of a binary file.
template <class Use>
bool PlyValues::with_number(PlyType type, const Use& use)
{
    if (data_.size() < bytes_of(type)) return false;
    const char* const place = data_.data();
    data_.remove_prefix(bytes_of(type));
    const bool swapped = (encoding_ == PlyEncoding::little_endian) != (std::endian::native == std::endian::little);
    switch (type) {
    case PlyType::int8: use(static_cast<int>(decoded<std::int8_t>(place, swapped))); break;
    case PlyType::uint8: use(static_cast<int>(decoded<std::uint8_t>(place, swapped))); break;
    case PlyType::int16: use(decoded<std::int16_t>(place, swapped)); break;
    case PlyType::uint16: use(decoded<std::uint16_t>(place, swapped)); break;
    case PlyType::int32: use(decoded<std::int32_t>(place, swapped)); break;
    case PlyType::uint32: use(decoded<std::uint32_t>(place, swapped)); break;
    case PlyType::float32: use(decoded<float>(place, swapped)); break;
    case PlyType::float64: use(decoded<double>(place, swapped)); break;
    }
    return true;
}

bool PlyValues::read(PlyType type, double& number)
{
    if (encoding_ == PlyEncoding::text) return to_number(take_word(data_), number);
    return with_number(type, [&](auto value) { number = static_cast<double>(value); });
}

/// An unsigned 32-bit number that is too large for an index becomes negative, which is out of range.
bool PlyValues::read(PlyType type, Index& number)
{
    if (encoding_ == PlyEncoding::text) return to_number(take_word(data_), number);
    return is_whole(type) && with_number(type, [&](auto value) { number = static_cast<Index>(value); });
}

/// Calls use(type), which takes a value, for each value of the property; the length of a list comes first.
template <class Use>
bool PlyValues::with_items(const PlyProperty& property, const Use& use)
{
    if (!property.length) return use(property.type);
    PlyValues before = *this;
    Index count = 0;
    if (!before.read(*property.length, count) || count < 0 || !use(*property.length)) return false;
    for (Index i = 0; i < count; ++i)
        if (!use(property.type)) return false;
    return true;
}

bool PlyValues::skip(const PlyProperty& property)
{
    return with_items(property, [&](PlyType type) {
        if (encoding_ != PlyEncoding::text) return with_number(type, [](auto) {});
        std::string_view word = take_word(data_);
        if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
        double number = 0.0;  // or not a number, in colours and qualities
        const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), number);
        return !word.empty() && error != std::errc::invalid_argument && end == word.data() + word.size();
    });
}

bool PlyValues::skip_item(const PlyElement& element)
{
    return std::ranges::all_of(element.properties, [&](const PlyProperty& property) { return skip(property); });
}

bool PlyValues::is_at_end() const
{
    std::string_view rest = data_;
    return encoding_ == PlyEncoding::text ? take_word(rest).empty() : rest.size() <= most_line_end;
}

bool PlyValues::copy(const PlyProperty& property, TextWriter& text, bool blank_first)
{
    return with_items(property, [&](PlyType type) {
        if (std::exchange(blank_first, true)) text.add(' ');
        if (encoding_ != PlyEncoding::text) return with_number(type, [&](auto value) { text.add_number(value); });
        const std::string_view word = take_word(data_);
        text.add(word);
        return !word.empty();
    });
}

}  // namespace koebe::io
