// koebe compare A B, koebe compare FOLDER --csv FILE
#include "cli/commands/map_kind.h"
#include "cli/commands/shape_family.h"
#include "cli/commands/shape_input.h"
#include "cli/commands/subcommand.h"
#include "cli/files/output_files.h"
#include "cli/options/map_request.h"
#include "cli/options/option_table.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "cli/process/standard_streams.h"
#include "core/numbering.h"
#include "exit_code.h"

#include "core/counted.h"
#include "core/errors.h"
#include "execution/detachable_run.h"
#include "files/atomic_file.h"
#include "fit/teichmueller.h"
#include "report/json.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"

#include <cstdio>
#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

constexpr const char* to_standard_output = "-";

struct CompareRequest : FamilyRequest {
    std::string first, second, json;
    std::string loops = "match";
    bool any_outer = false, with_json = false, teichmueller = false;

    bool to_file() const { return with_json && json != to_standard_output; }
    std::vector<OutputFile> files() const { return {{"--json", to_file() ? json : ""}, {"--csv", csv}}; }
};

/// The loops by size: the longest one outside, the others by length.
LoopMatch by_length(const ShapeInput& a, const ShapeInput& b)
{
    if (a.circles.size() != b.circles.size())
        throw InputError("the surfaces have " + std::to_string(a.circles.size()) + " and " +
                         std::to_string(b.circles.size()) + " loops: their modules cannot be compared");
    LoopMatch match;
    match.order_a = numbers_below(a.circles.size());
    match.order_b = match.order_a;
    match.distance = (conformal_module(a.circles) - conformal_module(b.circles)).norm();
    return match;
}

int run_family(const CompareRequest& request, const CancelToken& token)
{
    require_writable_files(request.files(), false);
    std::vector<std::string> paths{request.first};
    if (!request.second.empty()) paths.push_back(request.second);
    const ShapeFamily family = read_family(
        request, mesh_files(paths),
        [](const ShapeInput& shape) {
            std::vector<int> order = numbers_below<int>(shape.circles.size());
            return order;
        },
        token);
    return write_table(family, distance_table(family), request.csv, token);
}

nlohmann::ordered_json teichmueller_json(const TeichmuellerMap& map)
{
    return {{"distance", map.distance()}, {"dilatation", map.dilatation}, {"lower", map.lower},
            {"largest", map.largest},     {"match", map.match},           {"path", map.straight ? "straight" : "bows"},
            {"refused", map.refused},     {"flipped", map.flipped}};
}

/// The map of one surface to the other, loops matched as in `match`, or with the least K.
TeichmuellerMap extremal_map_of(const ShapeInput& a, const ShapeInput& b, const LoopMatch& match, bool least,
                                const CancelToken& token)
{
    ProgressLine progress(false);
    ExecutionContext context(progress.callback(), token);
    TeichmuellerOptions options{.least_match = least};
    if (!least) options.match.resize(match.order_a.size());
    for (std::size_t k = 0; k < options.match.size(); ++k)
        options.match[static_cast<std::size_t>(match.order_a[k])] = match.order_b[k];
    return teichmueller_map(a.surface, b.circles, options, context);
}

int run_compare(const CompareRequest& request)
{
    const CancelToken token = cancel_on_signal();
    if (!request.csv.empty()) return run_family(request, token);
    const bool to_file = request.to_file();
    require_writable_files(request.files(), true);
    const ShapeInput a = read_shape(request.first, request.options, token);
    const ShapeInput b = read_shape(request.second, request.options, token);
    // Match the loops, and measure the distance of the modules, or of the extremal map.
    ExecutionContext context({}, token);
    const LoopMatch match = run_detachable<LoopMatch>(context, [request, a, b](ExecutionContext& own) {
        return request.loops == "length" ? by_length(a, b) : match_loops(a.circles, b.circles, request.any_outer, own);
    });
    std::vector<Warning> warnings;
    for (const ShapeInput* shape : {&a, &b}) add_losses(shape->name + ": ", shape->warnings, warnings);
    for (const Warning& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
    double distance = match.distance;
    nlohmann::ordered_json extremal;
    if (request.teichmueller) {
        const TeichmuellerMap map = extremal_map_of(a, b, match, request.loops == "least", token);
        distance = map.distance();
        extremal = teichmueller_json(map);
    }
    // Write the report; the line goes to stdout unless the report does.
    if (request.with_json) {
        nlohmann::ordered_json report{{"distance", distance},
                                      {"margin", match.margin},
                                      {"a", module_json(a, match.order_a)},
                                      {"b", module_json(b, match.order_b)}};
        if (request.teichmueller) report["teichmueller"] = extremal;
        if (to_file) {
            AtomicFile file(request.json);
            file.write(json_text(report));
            context.checkpoint();
            file.commit();
        } else {
            print(json_text(report));
        }
    }
    if (!request.with_json || to_file) {
        const RimKind kind = request.options.rims;
        const std::string rims = kind == RimKind::smooth ? "" : " (" + std::string(to_string(kind)) + " rims)";
        print(formatted("distance %.9g", distance) + rims + "\n", to_file ? "; the file is written" : "");
    }
    return a.converged && b.converged ? done : not_converged;
}

/// Sorts the words: in `--json A B` the word after --json is the first mesh.
void settle_words(CompareRequest& request, const CLI::Option& json)
{
    request.with_json = json.count() > 0;
    if (request.second.empty() && !request.json.empty()) {
        request.second = std::move(request.first);
        request.first = std::exchange(request.json, to_standard_output);
    }
    if (request.json.empty()) request.json = to_standard_output;
    // A folder with --csv: each pair of its shapes.
    if (!request.csv.empty()) {
        if (request.with_json || request.any_outer || request.teichmueller || request.loops != "match")
            throw CLI::ValidationError("--csv", "excludes --json, --loops, --any-outer and --teichmueller");
        if (request.first.empty()) throw CLI::RequiredError("FOLDER");
        require_different_files(request.files(), {request.first, request.second}, false);
        return;
    }
    // Two meshes: which options exclude each other.
    require_csv(request);
    if (request.first.empty() || request.second.empty()) throw CLI::RequiredError("A and B");
    if (request.any_outer && request.loops != "match") throw CLI::ValidationError("--any-outer", "needs --loops match");
    if (request.loops == "least" && !request.teichmueller)
        throw CLI::ValidationError("--loops", "least needs --teichmueller");
    if (request.options.rims != RimKind::smooth && request.teichmueller)
        throw CLI::ValidationError("--teichmueller", "needs --rims smooth: the map of least K takes rims for smooth");
    if (request.options.with_error && !request.with_json)
        throw CLI::ValidationError("--error", "needs --csv or --json");
    if (request.any_outer && request.teichmueller) throw CLI::ValidationError("--teichmueller", "excludes --any-outer");
    require_different_files(request.files(), {request.first, request.second}, true);
}

}  // namespace

Subcommand add_compare(CLI::App& app)
{
    auto request = std::make_shared<CompareRequest>();
    CLI::App* options = app.add_subcommand("compare", "how far apart the conformal modules of two surfaces are");
    // The surfaces, and how their loops correspond.
    add_input(*options, request->first, "surface with holes", "A", "; or a folder of them, with --csv")
        ->required(false);
    options->add_option("B", request->second, "surface with the same number of holes");
    options
        ->add_option("--loops", request->loops,
                     "match: search for the corresponding loops; length: loops correspond by length; least, with "
                     "--teichmueller: "
                     "the loops correspond that give the least K")
        ->check(CLI::IsMember({"match", "length", "least"}))
        ->capture_default_str();
    options->add_flag("--any-outer", request->any_outer,
                      "with match: the outer loop of one surface may correspond to a hole of the other surface");
    options->add_flag(
        "--teichmueller", request->teichmueller,
        "the Teichmueller distance instead, log(K) / 2: K is the least dilatation of a map of one surface "
        "to the other");
    // A table of a whole folder, or a report of two.
    add_family_options(*options, *request,
                       "a row for each pair of the folder's shapes. All have one order of the loops, so the triangle "
                       "inequality holds",
                       "the meshes make, from maps of finer meshes");
    const CLI::Option* json =
        options->add_option("--json", request->json, "both modules as JSON: there, or in place of the line on stdout")
            ->expected(0, 1)
            ->type_name("[FILE]");
    add_options(*options, "shapes", request->options.map);
    options->callback([request, json] { settle_words(*request, *json); });
    return {options, [request] { return run_compare(*request); }};
}

}  // namespace koebe::cli
