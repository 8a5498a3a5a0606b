// koebe module IN, koebe module FOLDER --csv FILE
#include "cli/commands/shape_family.h"
#include "cli/commands/shape_input.h"
#include "cli/commands/subcommand.h"
#include "cli/files/mesh_input.h"
#include "cli/files/output_files.h"
#include "cli/options/map_request.h"
#include "cli/options/option_table.h"
#include "cli/options/validators.h"
#include "cli/options/wrong_usage.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "cli/process/standard_streams.h"
#include "core/numbering.h"
#include "exit_code.h"

#include "certified/capacities.h"
#include "core/counted.h"
#include "report/capacity_json.h"
#include "report/json.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace koebe::cli {
namespace {

struct ModuleRequest : FamilyRequest {
    std::string input;
    std::vector<std::string> loops{"length"};
    bool any_outer = false;
    bool certified = false;
    std::vector<std::string> between;
    CapacityOptions bounds;  // its threads are those of `options`

    std::vector<OutputFile> files() const { return {{"--csv", csv}}; }
};

/// Translates ranks among the mesh's loops to numbers of circles.
std::vector<int> order_of_ranks(const ShapeInput& shape, const std::vector<std::string>& words)
{
    std::vector<int> order;
    for (const std::string& word : words) {
        const auto found = std::ranges::find(shape.ranks, std::stoi(word));
        if (found == shape.ranks.end())
            throw WrongUsage("--loops: there is no boundary loop " + word + ": the surface has " +
                             counted(shape.ranks.size(), "loop") + ", numbered from 0");
        order.push_back(static_cast<int>(found - shape.ranks.begin()));
    }
    return order;
}

std::vector<int> chosen_order(const ShapeInput& shape, const ModuleRequest& request)
{
    if (request.loops == std::vector<std::string>{"canonical"})
        return canonical_order(shape.circles, request.any_outer);
    if (request.loops != std::vector<std::string>{"length"}) return order_of_ranks(shape, request.loops);
    std::vector<int> order = numbers_below<int>(shape.circles.size());
    return order;
}

int run_family(const ModuleRequest& request, const CancelToken& token)
{
    require_writable_files(request.files(), false);
    const ShapeFamily family = read_family(
        request, mesh_files({request.input}), [&](const ShapeInput& shape) { return chosen_order(shape, request); },
        token);
    return write_table(family, module_table(family), request.csv, token);
}

/// Loops at 0 and at 1, written as "0,2/1".
Condenser condenser_of(const std::string& words)
{
    Condenser condenser;
    const auto read = [&](const std::string& list, std::vector<int>& loops) {
        for (const std::string& word : CLI::detail::split(list, ',')) {
            if (std::string complaint = whole_number(0)(word); !complaint.empty())
                throw CLI::ValidationError("--between", complaint);
            loops.push_back(std::stoi(word));
        }
    };
    const std::size_t slash = words.find('/');
    if (slash == std::string::npos)
        throw CLI::ValidationError("--between", "loops at 0 and loops at 1 need a / between them");
    read(words.substr(0, slash), condenser.at_zero);
    read(words.substr(slash + 1), condenser.at_one);
    return condenser;
}

int run_certified(const ModuleRequest& request, const CancelToken& token)
{
    const MeshInput input =
        read_mesh_input(request.input, token, {.keep_file = false, .weld = request.options.of_files.weld});
    ProgressLine progress(false);
    ExecutionContext context(progress.callback(), token);
    std::vector<Condenser> condensers;
    for (const std::string& words : request.between) condensers.push_back(condenser_of(words));
    CapacityOptions bounds = request.bounds;
    bounds.threads = request.options.map.threads;
    CapacityReport report = with_filed_faces(input, [&] {
        return certified_capacities(input.polygons.vertices, input.triangulation.triangles, condensers, bounds,
                                    context);
    });
    add_input_warnings(input, report.warnings);
    nlohmann::ordered_json json = to_json(report);
    json["input"] = std::filesystem::path(request.input).filename().string();
    print(json_text(json));
    return report.converged ? done : not_converged;
}

int run_module(const ModuleRequest& request)
{
    const CancelToken token = cancel_on_signal();
    if (!request.csv.empty()) return run_family(request, token);
    require_standard_output();
    if (request.certified) return run_certified(request, token);
    const ShapeInput shape = read_shape(request.input, request.options, token);
    print(json_text(module_json(shape, chosen_order(shape, request))));
    return shape.converged ? done : not_converged;
}

/// @throws CLI::ValidationError a word that is neither a rank nor one of the two words, alone
void require_loop_words(const ModuleRequest& request)
{
    const bool word = request.loops.size() == 1 && (request.loops[0] == "length" || request.loops[0] == "canonical");
    for (const std::string& rank : word ? std::vector<std::string>{} : request.loops)
        if (std::string complaint = whole_number(0)(rank); !complaint.empty())
            throw CLI::ValidationError("--loops", complaint);
    if (request.any_outer && request.loops[0] != "canonical")
        throw CLI::ValidationError("--any-outer", "needs --loops canonical");
    if (request.csv.empty() && std::filesystem::is_directory(request.input))
        throw CLI::ValidationError("IN", "is a folder, which needs --csv FILE");
    for (const std::string& words : request.between) condenser_of(words);
    require_csv(request);
    require_different_files(request.files(), {request.input}, false);
}

/// Adds --certified and its options. No map is made with it, so that options of the map are wrong usage.
void add_certified_options(CLI::App& app, ModuleRequest& request)
{
    std::vector<CLI::Option*> of_map = app.get_options();
    CLI::Option* certified = app.add_flag("--certified", request.certified,
                                          "proved bounds for the capacities between loops, for a ring's "
                                          "modulus, and for the module of up to four loops");
    for (CLI::Option* option : of_map)
        if (const std::string name = option->get_name();
            name != "IN" && name != "--help" && name != "--threads" && name != "--weld")
            certified->excludes(option);
    add_value(app, *find_row("certified", "width"), request.bounds.width)->needs(certified);
    add_value(app, *find_row("certified", "max_faces"), request.bounds.max_faces)->needs(certified);
    app.add_option("--between", request.between,
                   "with --certified: loops at 0 / loops at 1, for example 0,2/1; no flux runs through the other "
                   "loops. By default each loop at 1 and all others at 0, then each pair")
        ->type_name("LOOPS/LOOPS")
        ->needs(certified);
}

}  // namespace

Subcommand add_module(CLI::App& app)
{
    auto request = std::make_shared<ModuleRequest>();
    CLI::App* options = app.add_subcommand("module", "the conformal module of a surface with holes, as JSON");
    add_input(*options, request->input, "surface with holes", "IN", "; or a folder of them, with --csv");
    options
        ->add_option("--loops", request->loops,
                     "order of the boundary loops, the outer one first: length (longest first), canonical (by their "
                     "circles), or all loops, for example 0,2,1, numbered by their lowest vertices")
        ->delimiter(',')
        ->type_name("length|canonical|RANKS")
        ->capture_default_str();
    add_family_options(
        *options, *request,
        "a table instead of JSON: a row for each shape, with its loops in the order of the reference's loops",
        "the mesh makes, each from a map of a finer mesh");
    options->add_flag("--any-outer", request->any_outer, "with canonical: any loop may be the outer one");
    add_options(*options, "shapes", request->options.map);
    add_certified_options(*options, *request);
    options->callback([request] { require_loop_words(*request); });
    return {options, [request] { return run_module(*request); }};
}

}  // namespace koebe::cli
