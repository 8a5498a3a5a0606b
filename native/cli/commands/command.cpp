#include "cli/commands/command.h"

#include "cli/commands/subcommand.h"
#include "cli/options/wrong_usage.h"
#include "cli/process/error_line.h"
#include "cli/process/exit_code.h"
#include "cli/process/scarce_memory.h"
#include "cli/process/standard_streams.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <sstream>
#include <system_error>
#include <vector>

namespace {

using namespace koebe::cli;

int fail(const std::string& line, int code)
{
    std::fprintf(stderr, "%s\n", line.c_str());
    return code;
}

int run_guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const koebe::Cancelled& error) {
        fail(error_line(error), interrupted);
        std::_Exit(interrupted);  // an ordinary exit waits for the computation's next checkpoint
    } catch (const koebe::KoebeError& error) {
        if (memory_ran_out()) end_for_memory();
        return fail(error_line(error), cannot_be_mapped);
    } catch (const WrongUsage& error) {
        return fail(error_line("WrongUsage", error.what()), wrong_usage);
    } catch (const std::bad_alloc&) {
        end_for_memory();
    } catch (const std::length_error&) {  // more than any memory holds
        end_for_memory();
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) end_for_memory();  // no memory for a thread
        return fail(error_line("InternalError", error.what()), cannot_be_mapped);
    } catch (const std::exception& error) {
        return fail(error_line("InternalError", error.what()), cannot_be_mapped);
    }
}

/// Ends after parsing: prints the help or the version, or an error as one line.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error)
{
    std::ostringstream text, complaint;
    if (app.exit(error, text, complaint) == 0) {
        print(text.str());
        return done;
    }
    return fail(error_line("WrongUsage", error.what()) + " (see koebe --help)", wrong_usage);
}

int run_command(std::span<const AddSubcommand> added, int argc, char** argv)
{
    CLI::App app("Conformal maps of surfaces with holes onto circle domains.", "koebe");
    app.set_version_flag("--version", KOEBE_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done; 2 wrong usage; 3 the mesh cannot be mapped; 4 not converged (files are written);\n"
               "130 interrupted (nothing is written; batch leaves what is done).\n"
               "A file is written as .koebe-PROCESS-NUMBER.tmp in its folder and then renamed: it is whole or absent.\n"
               "Where it is a symbolic link, the link stays and its target is replaced.");
    std::vector<Subcommand> commands;
    for (const AddSubcommand add : added) commands.push_back(add(app));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return end_of_parsing(app, error);
    }
    for (const Subcommand& command : commands)
        if (command.options->parsed()) return command.run();
    return wrong_usage;
}

}  // namespace

int koebe::cli::command(int argc, char** argv)
{
#define KOEBE_ADD(name) add_##name,
    constexpr AddSubcommand all[]{KOEBE_SUBCOMMANDS(KOEBE_ADD)};
#undef KOEBE_ADD
    return command_of(all, argc, argv);
}

int koebe::cli::command_of(std::span<const AddSubcommand> added, int argc, char** argv)
{
    keep_standard_streams();
    try {
        return run_guarded([&] {
            prepare_for_scarce_memory();
            return run_command(added, argc, argv);
        });
    } catch (...) {  // there was no memory even for the error's line
        end_for_memory();
    }
}
