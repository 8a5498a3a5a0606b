#include "cli/files/importance_file.h"

#include "cli/files/text_file.h"
#include "core/errors.h"
#include "io/text_numbers.h"

#include <string_view>

namespace koebe::cli {

std::vector<double> read_importance(const std::string& path)
{
    const std::string text = read_words(path);
    std::vector<double> importance;
    io::TextLines lines(text);
    for (int line = 1; lines.next_line(); ++line)
        for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) {
            double number = 0.0;
            if (!io::to_number(word, number) || !(number >= 0.0 && number <= 1.0))
                throw InputError(path + ", line " + std::to_string(line) + ": an importance is a number from 0 to 1");
            importance.push_back(number);
        }
    if (importance.empty()) throw InputError(path + " holds no importance");
    return importance;
}

}  // namespace koebe::cli
