#include "cli/files/landmark_file.h"

#include "cli/files/text_file.h"
#include "core/errors.h"
#include "io/text_lines.h"

#include <string_view>

namespace koebe::cli {
namespace {

[[noreturn]] void refuse(const std::string& path, int line)
{
    throw InputError(path + ", line " + std::to_string(line) +
                     ": a landmark is two vertices, counted from 0, or the six coordinates of two points");
}

NamedPoint vertex_of(std::string_view word, const std::string& path, int line)
{
    NamedPoint point;
    if (!io::to_number(word, point.vertex) || point.vertex < 0) refuse(path, line);
    return point;
}

NamedPoint position_of(const std::vector<std::string_view>& words, std::size_t first, const std::string& path, int line)
{
    NamedPoint point;
    for (int k = 0; k < 3; ++k)
        if (!io::to_number(words[first + k], point.position[k])) refuse(path, line);
    return point;
}

}  // namespace

NamedLandmarks read_landmarks(const std::string& path)
{
    const std::string text = read_words(path);
    NamedLandmarks landmarks;
    io::TextLines lines(text);
    for (int line = 1; lines.next_line(); ++line) {
        std::vector<std::string_view> words;
        for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) words.push_back(word);
        if (words.empty()) continue;
        if (words.size() == 2) {
            landmarks.on_a.push_back(vertex_of(words[0], path, line));
            landmarks.on_b.push_back(vertex_of(words[1], path, line));
        } else if (words.size() == 6) {
            landmarks.on_a.push_back(position_of(words, 0, path, line));
            landmarks.on_b.push_back(position_of(words, 3, path, line));
        } else {
            refuse(path, line);
        }
    }
    if (landmarks.on_a.empty()) throw InputError(path + " holds no landmark");
    return landmarks;
}

}  // namespace koebe::cli
