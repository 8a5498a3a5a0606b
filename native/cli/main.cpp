// The koebe command: parses, runs one sub-command, and turns errors into one line and an exit code.
#include "cli/error_line.h"
#include "cli/exit_code.h"
#include "cli/fast_kernels.h"
#include "cli/subcommand.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <vector>

namespace {

using namespace koebe::cli;

int fail(const std::string& line, int code)
{
    std::fprintf(stderr, "%s\n", line.c_str());
    return code;
}

int run_guarded(const Subcommand& command)
{
    try {
        return command.run();
    } catch (const koebe::Cancelled& error) {
        fail(error_line(error), interrupted);
        std::_Exit(interrupted);  // an ordinary exit waits for the computation's next checkpoint
    } catch (const koebe::KoebeError& error) {
        return fail(error_line(error), cannot_be_mapped);
    } catch (const std::bad_alloc&) {
        fail(error_line("OutOfMemory", "the mesh needs more memory than there is"), cannot_be_mapped);
        std::_Exit(cannot_be_mapped);  // at an ordinary exit OpenBLAS joins threads that wait for memory for ever
    } catch (const std::exception& error) {
        return fail(error_line("InternalError", error.what()), cannot_be_mapped);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    restart_with_fast_kernels(argv);
    CLI::App app("Conformal maps of surfaces with holes onto circle domains.", "koebe");
    app.set_version_flag("--version", KOEBE_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done; 2 wrong usage; 3 the mesh cannot be mapped; 4 not converged (files are written);\n"
               "130 interrupted (nothing is written).");
    const std::vector<Subcommand> commands{add_uniformize(app), add_fill(app), add_module(app), add_compare(app),
                                           add_ricci(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? done : wrong_usage;
    }
    for (const Subcommand& command : commands)
        if (command.options->parsed()) return run_guarded(command);
    return wrong_usage;
}
