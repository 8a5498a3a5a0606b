// Words and numbers of a text file, by fast_float: exact, and without a stream.
#pragma once

#include "core/types.h"

#include <string_view>

namespace koebe::io {

/// The word as a number; false if it is not one finite number and nothing else. A plus sign may stand before it.
bool to_number(std::string_view word, double& number);

/// The same for an integer of 32 bits.
bool to_number(std::string_view word, Index& number);

/// Takes the next word of the text, over ends of lines too; empty at its end.
std::string_view take_word(std::string_view& text);

/// Whether a backslash joins the line, which has no end, with the next one. One in a comment joins nothing.
bool joins_next_line(std::string_view line);

/// The words of one line after the other. '#' begins a comment, which ends with the line.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {}

    /// Leaves what is left of this line, and goes to the next. @return false after the last
    bool next_line();

    /// The same; lines that a backslash joins with this one are left too.
    bool next_statement();

    /// Where the text goes on.
    const char* here() const { return rest_.data(); }

    /// What is left of this line, without its end; it stays.
    std::string_view rest_of_line() const { return rest_.substr(0, rest_.find('\n')); }

    /// The next word of this line; empty at its end.
    std::string_view next_word();

    /// The same where a backslash at the end of a line joins it with the next one.
    std::string_view next_word_of_joined_lines();

    /// The next word of this line as a number, in one pass over it: what nearly all words of a mesh file are.
    /// @return false, and nothing is taken, if it is anything else than a plain finite number
    bool next_plain(double& number);

    /// The same for an integer, behind which a slash and whatever may stand.
    bool next_plain(Index& number);

private:
    std::string_view rest_;
    bool begun_ = false;
};

}  // namespace koebe::io
