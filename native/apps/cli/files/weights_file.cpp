#include "cli/files/weights_file.h"

#include "cli/files/text_file.h"
#include "core/errors.h"
#include "core/vertex_weights.h"
#include "io/text_lines.h"

#include <string_view>

namespace koebe::cli {

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

}  // namespace koebe::cli
