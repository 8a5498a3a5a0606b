// Words and numbers of the lines of a text file, read with fast_float: exact, and without a stream.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <string_view>

namespace koebe::io {

/// The text from one place to another; string_view's own constructor for this is missing in libc++ 13.
inline std::string_view text_between(const char* begin, const char* end)
{
    return {begin, static_cast<std::size_t>(end - begin)};
}

/// Reads the word as a number, with an optional plus sign. Returns false if it is not exactly one finite number.
bool to_number(std::string_view word, double& number);

/// Reads the word as a 32-bit integer.
bool to_number(std::string_view word, Index& number);

/// Takes the next word of the text, also from a later line; empty at the end.
std::string_view take_word(std::string_view& text);

/// Whether a backslash joins the line, given without its end, with the next one. In a comment it does not.
bool joins_next_line(std::string_view line);

/// The words of one line after another. '#' begins a comment, which ends with the line.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {}

    /// Goes to the next line. @return false after the last line
    bool next_line();

    /// Goes to the next line that no backslash joins with this one.
    bool next_statement();

    /// The present place in the text.
    const char* here() const { return rest_.data(); }

    /// The rest of this line, without its end. It is not taken.
    std::string_view rest_of_line() const { return rest_.substr(0, rest_.find('\n')); }

    /// The next word of this line; empty at its end.
    std::string_view next_word();

    /// The next word of this line, or of a line that a backslash joins with it.
    std::string_view next_word_of_joined_lines();

    /// Takes the next word of this line as a number, in one pass. Nearly all words of mesh files are plain numbers.
    /// @return false, without taking anything, if it is not a plain finite number
    bool next_plain(double& number);

    /// Takes an integer. A slash and any text may follow it.
    bool next_plain(Index& number);

private:
    std::string_view rest_;
    bool begun_ = false;
};

}  // namespace koebe::io
