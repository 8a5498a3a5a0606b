// The command in a browser: the sub-commands that the page offers, on files in memory.
#include "cli/commands/subcommand.h"
#include "cli/process/end_with_input.h"

void koebe::cli::end_with_input() {}  // no process starts this one

int main(int argc, char** argv)
{
    using namespace koebe::cli;
    constexpr AddSubcommand added[]{add_uniformize, add_parts, add_fit};
    return command_of(added, argc, argv);
}
