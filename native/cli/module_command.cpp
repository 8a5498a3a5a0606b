// koebe module IN
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/mapping_options.h"
#include "cli/shape_input.h"
#include "cli/standard_streams.h"
#include "cli/subcommand.h"
#include "cli/validators.h"
#include "cli/wrong_usage.h"

#include "report/json.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace koebe::cli {
namespace {

struct Request {
    std::string input;
    std::vector<std::string> loops{"length"};
    bool any_outer = false;
    UniformizeOptions options;
};

/// Ranks among the mesh's loops to numbers of circles.
std::vector<int> order_of_ranks(const ShapeInput& shape, const std::vector<std::string>& words)
{
    std::vector<int> order;
    for (const std::string& word : words) {
        const auto found = std::ranges::find(shape.ranks, std::stoi(word));
        if (found == shape.ranks.end())
            throw WrongUsage("--loops: there is no boundary loop " + word + " among " +
                             std::to_string(shape.ranks.size()) + ", counted from 0");
        order.push_back(static_cast<int>(found - shape.ranks.begin()));
    }
    return order;
}

std::vector<int> chosen_order(const ShapeInput& shape, const Request& request)
{
    if (request.loops == std::vector<std::string>{"canonical"})
        return canonical_order(shape.circles, request.any_outer);
    if (request.loops != std::vector<std::string>{"length"}) return order_of_ranks(shape, request.loops);
    std::vector<int> order(shape.circles.size());
    std::iota(order.begin(), order.end(), 0);
    return order;
}

int run(const Request& request)
{
    const CancelToken token = cancel_on_signal();
    require_standard_output();
    const ShapeInput shape = read_shape(request.input, request.options, token);
    print(json_text(module_json(shape, chosen_order(shape, request))));
    return shape.converged ? done : not_converged;
}

/// @throws CLI::ValidationError a word that is neither of the two, alone, nor a rank
void require_loop_words(const Request& request)
{
    const bool word = request.loops.size() == 1 && (request.loops[0] == "length" || request.loops[0] == "canonical");
    for (const std::string& rank : word ? std::vector<std::string>{} : request.loops)
        if (std::string complaint = whole_number(0)(rank); !complaint.empty())
            throw CLI::ValidationError("--loops", complaint);
    if (request.any_outer && request.loops[0] != "canonical")
        throw CLI::ValidationError("--any-outer", "goes with --loops canonical");
}

}  // namespace

Subcommand add_module(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("module", "the conformal module of a surface with holes, as JSON");
    options->add_option("IN", request->input, "surface with holes: OBJ, OFF, PLY or STL")->required();
    options
        ->add_option("--loops", request->loops,
                     "order of the boundary loops, the outer one first: length (longest first), canonical (by their "
                     "circles alone), or all of them as 0,2,1, by rank of their lowest vertices")
        ->delimiter(',')
        ->type_name("length|canonical|RANKS")
        ->capture_default_str();
    options->add_flag("--any-outer", request->any_outer, "with canonical: any loop may be the outer one");
    add_mapping_options(*options, request->options);
    options->callback([request] { require_loop_words(*request); });
    return {options, [request] { return run(*request); }};
}

}  // namespace koebe::cli
