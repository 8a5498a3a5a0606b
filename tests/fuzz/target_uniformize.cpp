#include "promise_check.h"
#include "targets.h"

#include "pipeline/uniformize.h"
#include "report/json.h"

#include <algorithm>
#include <string>

namespace koebe::fuzz {
namespace {

constexpr Limits limits{9, 220};

void check_error(const Soup& soup, const KoebeError& error, bool is_surface)
{
    const auto* topology = dynamic_cast<const TopologyError*>(&error);
    require(!is_surface || !topology, "a surface of genus 0 with boundary is taken: " + std::string(error.what()));
    require(dynamic_cast<const Cancelled*>(&error) == nullptr, "nobody cancelled");
    const std::size_t most = std::max(soup.points.size(), soup.faces.size());
    if (topology)
        for (const Index element : error.elements())
            require(element >= 0 && static_cast<std::size_t>(element) < most, "an error's elements exist");
}

}  // namespace

void fuzz_uniformize(Bytes bytes)
{
    const Program program = run_program(bytes, limits);
    const std::optional<SurfaceFacts> facts = surface_facts(program.soup);
    ExecutionContext context;
    try {
        const UniformizeResult result =
            uniformize(program.soup.vertices(), program.soup.triangles(), program.options, context);
        require(facts.has_value(), "what is no surface of genus 0 with boundary is refused");
        check_map(program.soup, *facts, result);
        require(!to_json(result).dump().empty(), "the report is JSON");
    } catch (const KoebeError& error) {
        check_error(program.soup, error, facts.has_value());
    }
}

}  // namespace koebe::fuzz
