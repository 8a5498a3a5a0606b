#include "cli/commands/weights_option.h"

#include "cli/files/text_file.h"
#include "cli/options/option_table.h"
#include "core/errors.h"
#include "core/vertex_weights.h"
#include "files/text_lines.h"

#include <string_view>

namespace koebe::cli {
namespace {

/// Numbers from 0 to 1, one for each vertex in the mesh's order, separated by spaces, commas or ends of lines.
/// @param name of such a number, with its article, for messages
/// @throws FileError, InputError a word that is not such a number
std::vector<double> read_weights(const std::string& path, const std::string& name)
{
    const std::string text = read_words(path);
    const auto refused = [&](const std::string& what) {
        return InputError(path + what + ": " + name + " is a number from 0 to 1");
    };
    std::vector<double> weights;
    io::TextLines lines(text);
    for (int line = 1; lines.next_line(); ++line)
        for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) {
            double number = 0.0;
            if (!io::to_number(word, number) || !is_weight(number)) throw refused(", line " + std::to_string(line));
            weights.push_back(number);
        }
    if (weights.empty()) throw refused(" is empty");
    return weights;
}

}  // namespace

void WeightsOption::add(CLI::App& app, const char* map, const char* name)
{
    name_ = name;
    if (const OptionRow* const row = find_row(map, name))
        app.add_option(row->flag(), file_, std::string(row->does))->type_name("FILE");
}

void WeightsOption::check(MapRequest& request) const
{
    if (!is_given()) return;
    require_different_files(map_files(request), {request.input, file_}, !request.quiet);
    request.entries["options"][name_] = true;
}

std::vector<double> WeightsOption::read(const char* article_name) const
{
    return is_given() ? read_weights(file_, article_name) : std::vector<double>{};
}

}  // namespace koebe::cli
