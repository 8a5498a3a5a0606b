#include "program.h"

#include "base_surface.h"
#include "edits.h"

#include <algorithm>

namespace koebe::fuzz {
namespace {

class Reader {
public:
    explicit Reader(Bytes bytes) : bytes_(bytes) {}

    std::size_t byte()
    {
        if (bytes_.empty()) return 0;
        const std::size_t value = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return value;
    }
    std::size_t two_bytes()
    {
        const std::size_t low = byte();
        return low + 256 * byte();
    }
    bool ended() const { return bytes_.empty(); }

private:
    Bytes bytes_;
};

BaseChoice read_base(Reader& reader, std::size_t side)
{
    BaseChoice choice;
    choice.kind = static_cast<int>(reader.byte());
    choice.n = 1 + reader.byte() % side;
    choice.m = 1 + reader.byte() % side;
    choice.holes = reader.byte() % 8;
    choice.shape = static_cast<int>(reader.byte());
    choice.seed = reader.two_bytes();
    reader.byte();  // left for later
    return choice;
}

/// What the mesh engine can be asked for, and combinations that it cannot.
void read_mesh_options(std::size_t bits, UniformizeOptions& options)
{
    using Metric = KoebeMeshOptions::Metric;
    constexpr Metric metrics[] = {Metric::first, Metric::planar, Metric::reflected, Metric::reflected_last};
    options.mesh.metric = metrics[bits & 3];
    options.mesh.annulus = bits & 4 ? AnnulusBackend::yamabe : AnnulusBackend::harmonic;
    if (bits & 8) options.method = Method::gk;
    if ((bits & 24) == 24) options.mesh.partners = Partners::changing;
    if ((bits & 0x60) == 0x60)
        for (int k = 0; k <= static_cast<int>(bits >> 13); ++k) options.mesh.schedule.push_back({k, k + 1});
    options.mesh.record_steps = bits & 0x80;
}

UniformizeOptions read_options(Reader& reader, const Soup& soup)
{
    UniformizeOptions options;
    const std::size_t bits = reader.byte(), more = reader.byte();
    options.method = bits & 1 ? Method::ck : Method::gk;
    options.engine = bits & 2 ? Engine::mesh : Engine::condensed;
    options.balance = bits & 4 ? Balance::area : Balance::none;
    options.polish = (bits & 0x38) == 0x38;  // seldom: it takes long
    if (bits & 0x40) options.outer = bits & 0x80 ? OuterLoop::vertex : OuterLoop::longest;
    constexpr double tolerances[] = {1e-6, 1e-3, 1e-9, 1e-1};
    options.tolerance = tolerances[more % 4];
    options.max_sweeps = more & 4 ? 1 + static_cast<int>(more >> 5) : 20;
    options.threads = more & 8 ? 2 : 0;
    const std::size_t rest = reader.two_bytes();
    options.outer_vertex = static_cast<Index>(rest % (soup.points.size() + 2)) - 1;
    if (more & 16) {
        if (options.method == Method::gk) options.method = Method::against_outer;
        read_mesh_options(rest, options);
        const Index vertex_count = static_cast<Index>(soup.points.size());
        if (rest & 0x100) options.center = static_cast<Index>((rest >> 3) % (vertex_count + 1));
        if (rest & 0x200) options.point = static_cast<Index>((rest >> 5) % (vertex_count + 1));
    }
    return options;
}

}  // namespace

Vertices Soup::vertices() const
{
    Vertices result(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        std::ranges::copy(points[v], result.row(static_cast<Eigen::Index>(v)).begin());
    return result;
}

Triangles Soup::triangles() const
{
    Triangles result(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        std::ranges::copy(faces[f], result.row(static_cast<Eigen::Index>(f)).begin());
    return result;
}

Program run_program(Bytes bytes, const Limits& limits)
{
    Program program;
    Reader base(bytes.first(std::min(bytes.size(), base_bytes)));
    program.soup = base_surface(read_base(base, limits.side));
    Bytes rest = bytes.subspan(std::min(bytes.size(), base_bytes));

    const Bytes options = rest.first(std::min(rest.size(), option_bytes));
    Reader edits(rest.subspan(options.size()));
    for (std::size_t i = 0; i < most_edits && !edits.ended(); ++i) {
        EditChoice choice;
        choice.kind = static_cast<int>(edits.byte());
        choice.a = edits.two_bytes();
        choice.b = edits.two_bytes();
        choice.amount = static_cast<int>(static_cast<std::int8_t>(edits.byte()));
        edit(program.soup, choice, limits);
    }
    Reader option_reader(options);
    program.options = read_options(option_reader, program.soup);
    option_reader.byte();
    program.choice = static_cast<std::uint8_t>(option_reader.byte());
    return program;
}

}  // namespace koebe::fuzz
