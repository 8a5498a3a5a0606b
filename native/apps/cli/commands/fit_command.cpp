// koebe fit IN TEMPLATE OUT
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"

#include "cli/files/text_file.h"
#include "core/counted.h"
#include "core/errors.h"
#include "fit/circle_template.h"
#include "fit/fit_circles.h"
#include "pipeline/convex_disk.h"
#include "report/fit_json.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>

namespace koebe::cli {
namespace {

using nlohmann::json;

/// A place in a template, and the errors about it.
struct TemplateEntry {
    const json& value;
    std::string where;

    [[noreturn]] void refuse(const std::string& why) const { throw InputError(where + " " + why); }

    /// @param keys that it may have
    void require_object(std::initializer_list<std::string_view> keys) const
    {
        if (!value.is_object()) refuse("is not an object");
        for (const auto& [key, entry] : value.items())
            if (std::ranges::find(keys, key) == keys.end()) refuse("has the unknown entry \"" + key + "\"");
    }

    bool has(const char* key) const { return value.contains(key); }

    TemplateEntry at(const char* key) const
    {
        if (!has(key)) refuse("has no \"" + std::string(key) + "\"");
        return {value.at(key), where + ": " + key};
    }

    double number() const
    {
        if (!value.is_number()) refuse("is not a number");
        return value.get<double>();
    }

    int whole() const
    {
        if (!value.is_number_integer() || value.get<double>() < 0.0 ||
            value.get<double>() > std::numeric_limits<int>::max())
            refuse("is not a whole number from 0 on");
        return value.get<int>();
    }
};

TemplateRim rim_in(const TemplateEntry& entry)
{
    TemplateRim rim;
    if (entry.has("rotates")) {
        const TemplateEntry rotates = entry.at("rotates");
        if (!rotates.value.is_boolean()) rotates.refuse("is neither true nor false");
        rim.rotates = rotates.value.get<bool>();
    }
    if (entry.has("pin")) {
        const TemplateEntry pin = entry.at("pin");
        pin.require_object({"vertex", "angle"});
        rim.pin =
            RimPin{static_cast<Index>(pin.at("vertex").whole()), pin.at("angle").number() * std::numbers::pi / 180.0};
        if (!rim.rotates) entry.refuse("is pinned and does not rotate: give one of both");
    }
    return rim;
}

Circle circle_in(const TemplateEntry& entry)
{
    const TemplateEntry center = entry.at("center");
    if (!center.value.is_array() || center.value.size() != 2) center.refuse("is not a pair of numbers");
    const TemplateEntry x{center.value[0], center.where}, y{center.value[1], center.where};
    return {{x.number(), y.number()}, entry.at("radius").number()};
}

void add_circle(const TemplateEntry& entry, CircleTemplate& wanted)
{
    entry.require_object({"name", "center", "radius", "loop", "rotates", "pin"});
    wanted.circles.push_back(circle_in(entry));
    wanted.rims.push_back(rim_in(entry));
    std::string name = std::to_string(wanted.names.size());
    if (entry.has("name")) {
        const TemplateEntry given = entry.at("name");
        if (!given.value.is_string()) given.refuse("is not a text");
        name = given.value.get<std::string>();
    }
    wanted.names.push_back(std::move(name));
    if (entry.has("loop")) wanted.loops.push_back(entry.at("loop").whole());
}

/// A JSON object: `circles` is a list, `outer` describes the rim of the unit circle and may be missing. Each circle has
/// `center` [x, y] and `radius`, and may have `name`, `loop` (all circles or none), and what rims have: `rotates`, and
/// `pin` with `vertex` and `angle` in degrees (docs/fit.md).
/// @throws FileError it cannot be read; InputError it is no such object
CircleTemplate read_template(const std::string& path)
{
    const json text = json::parse(read_text(path), nullptr, false);
    if (text.is_discarded()) throw InputError(path + " is not JSON");
    const TemplateEntry whole{text, path};
    whole.require_object({"circles", "outer"});
    CircleTemplate wanted;
    const TemplateEntry circles = whole.at("circles");
    if (!circles.value.is_array()) circles.refuse("is not a list");
    for (std::size_t k = 0; k < circles.value.size(); ++k)
        add_circle({circles.value[k], path + ": circle " + std::to_string(k)}, wanted);
    if (!wanted.loops.empty() && wanted.loops.size() != wanted.circles.size())
        circles.refuse("name loops for some circles only");
    if (whole.has("outer")) {
        const TemplateEntry outer = whole.at("outer");
        outer.require_object({"rotates", "pin"});
        wanted.outer = rim_in(outer);
    }
    return wanted;
}

struct FitRequest : MapRequest {
    std::string wanted;
    bool extremal = false;
};

class FitKind final : public DiskKind<FitResult> {
public:
    explicit FitKind(const FitRequest& request)
        : DiskKind(request), wanted_(read_template(request.wanted)), extremal_(request.extremal)
    {
    }

    FitResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        CircleTemplate named = wanted_;
        const auto name_mapped = [&input](TemplateRim& rim) {
            if (rim.pin) rim.pin->vertex = input.mapped(rim.pin->vertex);
        };
        name_mapped(named.outer);
        std::ranges::for_each(named.rims, name_mapped);
        FitResult result = with_filed_faces(input, [&] {
            return fit_circles(input.polygons.vertices, input.triangulation.triangles, named,
                               {.map = request_.options, .extremal = extremal_}, context);
        });
        make_polygons_convex(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face, result,
                             context, false);  // the fit's |mu| is least as it is
        input.give_to_joined(result.uv);
        add_input_warnings(input, result.warnings);
        return result;
    }
    std::string first_words(const FitResult& result) const override
    {
        return counted(result.loops.size() - 1, "circle") + ", |mu| " + formatted("%.2g", result.of_faces.mean) +
               ", at most " + formatted("%.2g", result.of_faces.max);
    }

private:
    CircleTemplate wanted_;
    bool extremal_;
};

}  // namespace

Subcommand add_fit(CLI::App& app)
{
    auto request = std::make_shared<FitRequest>();
    CLI::App* options = app.add_subcommand("fit", "map a surface with holes to circles at given places");
    add_input(*options, request->input, "surface with holes");
    options->add_option("TEMPLATE", request->wanted, "JSON file: centres and radii of the circles (docs/fit.md)")
        ->required();
    add_mapped_mesh(*options, *request);
    options->add_flag("--extremal", request->extremal, "least largest |mu|, nearly; takes longer");
    add_options(*options, "shapes", request->options);
    add_options(*options, "shapes", request->of_files);
    add_report_options(*options, *request, "write a picture of the template there");
    options->callback([request] {
        check_map_files(*request);
        require_different_files(map_files(*request), {request->input, request->wanted}, !request->quiet);
        report_options(*request, "shapes", request->options);
        request->entries["options"]["extremal"] = request->extremal;
    });
    return {options, [request] { return run_map_of(*request, FitKind(*request)); }};
}

}  // namespace koebe::cli
