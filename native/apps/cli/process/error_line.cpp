#include "cli/process/error_line.h"

#include "cli/process/result_line.h"

#include <algorithm>

namespace koebe::cli {
namespace {

constexpr std::size_t listed_elements = 10;

std::string element_list(const std::vector<Index>& elements)
{
    std::string list;
    for (std::size_t i = 0; i < std::min(elements.size(), listed_elements); ++i) {
        list += i == 0 ? " [" : " ";
        list += std::to_string(elements[i]);
    }
    if (!elements.empty()) list += elements.size() > listed_elements ? " …]" : "]";
    return list;
}

std::string full_name(const KoebeError& error)
{
    std::string name = error.name();
    if (const auto* topology = dynamic_cast<const TopologyError*>(&error))
        name.append("(").append(to_string(topology->kind())).append(")");
    return name;
}

}  // namespace

std::string error_line(const std::string& name, const std::string& reason) { return one_line(name + ": " + reason); }

std::string error_line(const KoebeError& error)
{
    return error_line(full_name(error), error.what()) + element_list(error.elements());
}

}  // namespace koebe::cli
