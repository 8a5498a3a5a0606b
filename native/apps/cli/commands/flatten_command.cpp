// koebe flatten IN OUT.svg|OUT.dxf
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "files/extension.h"
#include "files/file_error.h"
#include "files/file_identity.h"
#include "flatten/flatten.h"
#include "report/flatten_json.h"
#include "report/pattern_dxf.h"
#include "report/pattern_svg.h"

#include <filesystem>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

using FlattenRequest = CornerMapRequest<FlattenOptions>;

bool is_dxf(const std::string& out) { return io::lower_extension(out) == ".dxf"; }

void check_pattern_files(MapRequest& request)
{
    if (!is_dxf(request.output) && io::lower_extension(request.output) != ".svg")
        throw CLI::ValidationError("OUT", "patterns are written as SVG and DXF: OUT ends in .svg or .dxf");
    require_different_files(map_files(request), {request.input}, !request.quiet);
}

/// OUT-2.svg of OUT.svg for the second page.
std::filesystem::path page_file(const std::string& out, std::size_t page)
{
    std::filesystem::path path(out);
    const std::string name = path.stem().string() + "-" + std::to_string(page) + path.extension().string();
    return path.replace_filename(name);
}

void write_further_pages(const FlattenRequest& request, std::vector<AtomicFile>& files, const FlattenResult& result)
{
    const std::vector<std::string> pages = pattern_svg(result.pattern);
    for (std::size_t k = 1; k < pages.size(); ++k) {
        const std::filesystem::path path = page_file(request.output, k + 1);
        if (io::same_file(path, request.input) || (!request.json.empty() && io::same_file(path, request.json)))
            throw FileError("page " + std::to_string(k + 1) + " would replace '" + path.string() + "'");
        require_writable(path);
        files.emplace_back(path).write(pages[k]);
    }
}

class FlattenKind final : public PieceMapKind<flatten, &FlattenResult::pieces> {
public:
    using PieceMapKind::PieceMapKind;

    std::vector<Warning> write_mesh(AtomicFile& file, const MeshInput&, const FlattenResult& result) const override
    {
        file.write(is_dxf(request_.output) ? pattern_dxf(result.pattern) : pattern_svg(result.pattern).front());
        return {};
    }
    void write_more(std::vector<AtomicFile>& files, const FlattenResult& result) const override
    {
        if (!is_dxf(request_.output)) write_further_pages(request_, files, result);
    }
    std::string first_words(const FlattenResult& result) const override
    {
        const Page& page = result.pattern.page;
        return counted(result.pieces.size(), "piece") + " on " +
               counted(static_cast<std::size_t>(result.pattern.pages()), page.any() ? "page" : "sheet") + ", cuts " +
               formatted("%.0f", result.cut_length) + " mm, stretch " + formatted("%.2g", result.stretch.mean) +
               " % in the mean and " + formatted("%.2g", result.stretch.max) + " % at most";
    }
};

}  // namespace

Subcommand add_flatten(CLI::App& app)
{
    return add_corner_map<FlattenKind>(
        app, {.name = "flatten",
              .does = "cut any surface into a flat pattern in real size",
              .surface = "any mesh",
              .picture = "",
              .output = "SVG or DXF to write. SVG: a file for each page, OUT.svg, OUT-2.svg and so on",
              .check = check_pattern_files});
}

}  // namespace koebe::cli
