// A flag that names a file with a weight for each vertex.
#pragma once

#include "cli/commands/map_run.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

class WeightsOption {
public:
    /// Adds the flag, if the map has a row of this name in the table of options.
    void add(CLI::App& app, const char* map, const char* name);
    /// Checks that the file is none of the map's other files, and reports that weights were given.
    void check(MapRequest& request) const;
    bool is_given() const { return !file_.empty(); }
    /// @param article_name for messages: "an importance" @return empty without a file @throws InputError
    std::vector<double> read(const char* article_name) const;

private:
    const char* name_ = "";
    std::string file_;
};

}  // namespace koebe::cli
