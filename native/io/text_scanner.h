// Numbers and words out of a text in memory, with the line for the error message.
#pragma once

#include <cstddef>
#include <string_view>

namespace koebe::io {

/// Walks over a text. Lines end with LF, CR LF or CR; '#' starts a comment; a backslash joins a line to the next.
class TextScanner {
public:
    explicit TextScanner(std::string_view text, std::size_t position = 0);

    bool at_end() const { return here_ == end_; }
    /// Passes over blanks, and says whether the line (or what is before its comment) is over.
    bool at_line_end();
    void skip_line();
    /// Passes over line ends, blanks and comments to the next word; false at the end of the text.
    bool seek_word();

    /// The next word of this line; empty at its end.
    std::string_view word();
    /// @throws InputError with the line, if no number comes next in this line or it is outside the 64-bit range
    double number();
    /// @throws InputError with the line, if no integer comes next in this line; a '/' may follow it at once
    long long integer();
    /// The rest of the current word is passed over.
    void skip_word();

    std::size_t position() const { return static_cast<std::size_t>(here_ - begin_); }
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - here_); }

    /// @throws InputError "line N: expected WHAT, found '...'", always
    [[noreturn]] void fail(std::string_view expected);

private:
    void skip_blanks();

    const char* begin_;
    const char* here_;
    const char* end_;
};

}  // namespace koebe::io
