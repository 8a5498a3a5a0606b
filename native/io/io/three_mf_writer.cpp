#include "io/three_mf_writer.h"

#include "core/errors.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr const char* content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
)";
constexpr const char* relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";

/// The check sum of ZIP [ISO 3309].
std::uint32_t check_sum(const std::string& bytes)
{
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit) table[i] = (table[i] >> 1) ^ ((table[i] & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    std::uint32_t sum = 0xFFFFFFFFU;
    for (const char c : bytes) sum = (sum >> 8) ^ table[(sum ^ static_cast<unsigned char>(c)) & 0xFFU];
    return ~sum;
}

template <typename Number>
void put_number(std::string& bytes, Number number)
{
    for (std::size_t i = 0; i < sizeof(Number); ++i) bytes.push_back(static_cast<char>(number >> (8 * i)));
}

/// Files in a ZIP without compression [PKWARE, APPNOTE 6.3].
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files)
{
    std::string bytes, directory;
    for (const auto& [name, content] : files) {
        if (bytes.size() + content.size() > 0xF0000000U) throw InputError("a 3MF file holds up to four gigabytes");
        std::string about;  // what both headers have
        put_number<std::uint16_t>(about, 20);
        put_number<std::uint32_t>(about, 0);           // no flags, stored
        put_number<std::uint32_t>(about, 0x00210000);  // 1980-01-01, so that equal meshes make equal files
        put_number<std::uint32_t>(about, check_sum(content));
        put_number(about, static_cast<std::uint32_t>(content.size()));
        put_number(about, static_cast<std::uint32_t>(content.size()));
        put_number(about, static_cast<std::uint32_t>(name.size()));  // and no extra field
        put_number<std::uint32_t>(directory, 0x02014B50);
        put_number<std::uint16_t>(directory, 20);
        directory += about + std::string(10, '\0');
        put_number(directory, static_cast<std::uint32_t>(bytes.size()));
        directory += name;
        put_number<std::uint32_t>(bytes, 0x04034B50);
        bytes.append(about).append(name).append(content);
    }
    const auto begin = static_cast<std::uint32_t>(bytes.size());
    bytes += directory;
    put_number<std::uint32_t>(bytes, 0x06054B50);
    put_number<std::uint32_t>(bytes, 0);
    for (int i = 0; i < 2; ++i) put_number(bytes, static_cast<std::uint16_t>(files.size()));
    put_number(bytes, static_cast<std::uint32_t>(directory.size()));
    put_number(bytes, begin);
    put_number<std::uint16_t>(bytes, 0);
    return bytes;
}

template <typename Number>
void put_attribute(std::string& text, const char* name, Number number)
{
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(" ").append(name).append("=\"").append(digits.data(), end).append("\"");
}

template <typename Rows>
void put_elements(std::string& text, const char* element, const std::array<const char*, 3>& names, const Rows& rows)
{
    for (const auto& row : rows.rowwise()) {
        text += element;
        for (int k = 0; k < 3; ++k) put_attribute(text, names[k], row[k]);
        text += "/>\n";
    }
}

std::string model_of(const Vertices& vertices, const Triangles& triangles, bool closed)
{
    std::string text =
        R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type=")";
    text += closed ? "model" : "surface";
    text += "\"><mesh><vertices>\n";
    put_elements(text, "<vertex", {"x", "y", "z"}, vertices);
    text += "</vertices><triangles>\n";
    put_elements(text, "<triangle", {"v1", "v2", "v3"}, triangles);
    return text + "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>\n";
}

}  // namespace

void write_three_mf(AtomicFile& file, const Vertices& vertices, const Triangles& triangles, bool closed)
{
    file.write(zip_of({{"[Content_Types].xml", content_types},
                       {"_rels/.rels", relationships},
                       {"3D/3dmodel.model", model_of(vertices, triangles, closed)}}));
}

}  // namespace koebe
