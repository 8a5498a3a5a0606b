#include "cli/options/mapping_options.h"

#include "cli/options/validators.h"

namespace koebe::cli {

void add_most_lost(CLI::App& app, double& most_lost)
{
    app.add_option("--most-lost", most_lost, "share of the surface's area that may have no area in the UVs")
        ->check(share())
        ->type_name("SHARE")
        ->capture_default_str();
}

void add_mapping_options(CLI::App& app, UniformizeOptions& options)
{
    app.add_option("--tolerance", options.tolerance, "on the circles' change in a sweep, a length in the unit disk")
        ->check(positive_number())
        ->capture_default_str();
    app.add_option("--max-sweeps", options.max_sweeps, "sweeps over all loops before giving up")
        ->check(whole_number(1))
        ->capture_default_str();
    app.add_option("--threads", options.threads, "at most; 0: all cores. The result is the same for any number")
        ->check(whole_number(0))
        ->capture_default_str();
}

}  // namespace koebe::cli
