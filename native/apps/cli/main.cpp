#include "cli/commands/command.h"

int main(int argc, char** argv) { return koebe::cli::command(argc, argv); }
