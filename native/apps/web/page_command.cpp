// The command in a browser: the sub-commands that the page offers, on files in memory.
#include "cli/commands/subcommand.h"
#include "cli/process/end_with_input.h"

void koebe::cli::end_with_input() {}  // no process starts this one

int main(int argc, char** argv)
{
    using namespace koebe::cli;
    constexpr NamedSubcommand known[]{{"uniformize", add_uniformize}, {"parts", add_parts}, {"fit", add_fit}};
    return command_of(known, argc, argv);
}
