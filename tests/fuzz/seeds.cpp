#include "seeds.h"

#include "array_checks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace koebe::fuzz {
namespace {

using Byte = std::uint8_t;

/// @param choice what a target makes of it: most pick their function by it
std::vector<Byte> program(int kind, int shape, int choice, const std::vector<std::array<Byte, edit_bytes>>& edits = {})
{
    std::vector<Byte> bytes(header_bytes, 0);
    const Byte base[] = {
        static_cast<Byte>(kind), 3, 2, 2, static_cast<Byte>(shape), static_cast<Byte>(7 * kind + shape)};
    std::ranges::copy(base, bytes.begin());
    bytes[header_bytes - 1] = static_cast<Byte>(choice);
    for (const auto& edit : edits) bytes.insert(bytes.end(), edit.begin(), edit.end());
    return bytes;
}

std::vector<Seed> programs(Target target)
{
    std::vector<Seed> seeds;
    int choices = 1;
    if (target == fuzz_arrays) choices = static_cast<int>(surface_checks().size() + planar_checks().size());
    if (target == fuzz_domains) choices = domain_choices;
    for (int choice = 0; choice < choices; ++choice)
        for (int kind = 0; kind < base_kind_count(); ++kind)
            if (choices == 1 || kind % 3 == choice % 3)
                seeds.push_back({"base-" + std::to_string(kind) + "-" + std::to_string(choice),
                                 program(kind, kind + choice, choice)});
    for (int kind = 0; kind < edit_kind_count(); ++kind)
        seeds.push_back(
            {"edit-" + std::to_string(kind), program(kind, kind, 0, {{static_cast<Byte>(kind), 5, 0, 3, 0, 12}})});
    for (Byte options = 1; options < 8 && target == fuzz_uniformize; ++options) {
        seeds.push_back({"options-" + std::to_string(options), program(1, 1, 0)});
        seeds.back().bytes[base_bytes] = options;
    }
    return seeds;
}

template <class Number>
void append(std::vector<Byte>& bytes, Number number, std::endian order)
{
    Byte raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (order != std::endian::native) std::reverse(std::begin(raw), std::end(raw));
    for (const Byte byte : raw) bytes.push_back(byte);
}

constexpr float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, 0}};

std::vector<Byte> binary_ply(Byte format, std::endian order)
{
    const std::string header = std::string("ply\nformat binary_") + (order == std::endian::little ? "little" : "big") +
                               "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    std::vector<Byte> bytes{format};
    for (const char c : header) bytes.push_back(static_cast<Byte>(c));
    for (const auto& corner : corners)
        for (const float x : corner) append(bytes, x, order);
    for (const std::int32_t third : {1, 2}) {
        bytes.push_back(3);
        for (const std::int32_t v : {0, third, third + 1}) append(bytes, v, order);
    }
    return bytes;
}

std::vector<Byte> binary_stl(Byte format)
{
    std::vector<Byte> bytes{format};
    bytes.resize(1 + 80);
    append(bytes, std::uint32_t{2}, std::endian::little);
    for (const int third : {1, 2}) {
        for (int k = 0; k < 3; ++k) append(bytes, 0.0F, std::endian::little);
        for (const int v : {0, third, third + 1})
            for (const float x : corners[v]) append(bytes, x, std::endian::little);
        append(bytes, std::uint16_t{0}, std::endian::little);
    }
    return bytes;
}

std::vector<Seed> files()
{
    std::vector<Seed> seeds;
    const auto add_text = [&](const std::string& name, Byte format, const std::string& text) {
        seeds.push_back({name, {format}});
        seeds.back().bytes.insert(seeds.back().bytes.end(), text.begin(), text.end());
    };
    enum : Byte { obj, off, ply, stl };
    add_text("obj", obj, "# a quad\nv 0 0 0\nv 1 0 0\nv 1 1 .25\nv 0 1e0 0\nvt 0 0\nf 1/1 2//1 3/1/1 4\n");
    add_text("obj-relative", obj, "v 0 0 0 1\nv 1 0 0\nv 1 1 0\nf -3 -2 \\\n -1\ng a\nusemtl b\nl 1 2\n");
    add_text("obj-pentagon", obj, "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nf 1 2 3 4 5\n");
    add_text("off", off, "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    add_text("off-colours", off, "COFF\n3 1 3\n0 0 0 255 0 0 255\n1 0 0 0 0 0 1\n1 1 0 1 1 1 1\n3 0 1 2 9 9 9\n");
    add_text(
        "ply", ply,
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty double x\nproperty float y\nproperty float z\n"
        "property uchar red\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n");
    add_text(
        "stl", stl,
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 -0\nendloop\nendfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
    seeds.push_back({"ply-little", binary_ply(ply, std::endian::little)});
    seeds.push_back({"ply-big", binary_ply(ply, std::endian::big)});
    seeds.push_back({"stl-binary", binary_stl(stl)});
    return seeds;
}

}  // namespace

std::vector<Seed> seeds_of(Target target) { return takes_a_program(target) ? programs(target) : files(); }

}  // namespace koebe::fuzz
