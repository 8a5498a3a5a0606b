#include "io/off_text.h"

#include "core/errors.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string>

namespace koebe::io {
namespace {

/// The next word that is no comment, and the rest of the text; empty at its end.
std::string_view next_word(std::string_view& text)
{
    constexpr std::string_view spaces = " \t\r\n\v\f";
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
        if (!text.starts_with('#')) break;
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
    const std::string_view word = text.substr(0, text.find_first_of(spaces));
    text.remove_prefix(word.size());
    return word;
}

}  // namespace

void require_off_header(std::string_view bytes)
{
    std::string_view text = bytes;
    const std::string_view keyword = next_word(text);
    std::string_view word = next_word(text);
    if (word.starts_with("BINARY") || keyword.ends_with("SKEL") || keyword.find('n') != std::string_view::npos)
        throw InputError("OFF is supported as a text in three dimensions, not binary, SKEL or nOFF");
    for (const char* element : {"vertex", "face", "edge"}) {
        std::int64_t count = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
        // Vertices and faces take a byte at least. How many edges there are is for nobody's use.
        const auto most = static_cast<std::int64_t>(std::min(bytes.size(), std::size_t{1} << 28));
        if (error == std::errc::result_out_of_range || count > most || count < -most)
            throw InputError(std::string("the header's number of element ") + element + " does not fit the file");
        // CGAL takes what comes behind a number, without a space, for the next one.
        if (end != word.data() + word.size() && (*end == '-' || *end == '+'))
            throw InputError(std::string("the header's number of element ") + element + " is no integer");
        word = next_word(text);
    }
}

bool read_off_face(std::istream& file, std::vector<Index>& polygon, Index first, std::size_t vertex_count)
{
    std::string line;
    do {
        if (!std::getline(file, line)) return false;
        line.erase(std::min(line.find('#'), line.size()));
    } while (line.find_first_not_of(" \t\r") == std::string::npos);
    std::istringstream words(line);
    Index corners = 0;
    words >> corners;
    for (Index vertex; std::ssize(polygon) < corners && words >> vertex; polygon.push_back(vertex - first))
        if (vertex < first || static_cast<std::size_t>(vertex - first) >= vertex_count) return false;
    return !words.fail() && std::ssize(polygon) == corners;
}

}  // namespace koebe::io
