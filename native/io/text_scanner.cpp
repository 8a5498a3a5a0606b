#include "io/text_scanner.h"

#include "core/errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace koebe::io {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool is_newline(char c) { return c == '\n' || c == '\r'; }

bool is_word_end(const char* here, const char* end)
{
    return here == end || is_blank(*here) || is_newline(*here) || *here == '#' || *here == '\\';
}

/// Where a backslash at a line's end makes the line go on; nullptr if it is none.
const char* joined_line(const char* here, const char* end)
{
    if (*here != '\\') return nullptr;
    const char* next = here + 1;
    while (next != end && is_blank(*next)) ++next;
    if (next == end || !is_newline(*next)) return nullptr;
    return next + (*next == '\r' && next + 1 != end && next[1] == '\n' ? 2 : 1);
}

/// The first 24 printable characters, for an error message.
std::string_view printable_prefix(std::string_view text)
{
    std::size_t length = 0;
    while (length < std::min<std::size_t>(text.size(), 24) && text[length] >= ' ' && text[length] <= '~') ++length;
    return text.substr(0, length);
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::size_t position)
    : begin_(text.data()), here_(text.data() + std::min(position, text.size())), end_(text.data() + text.size())
{
    if (position == 0 && text.starts_with("\xEF\xBB\xBF")) here_ += 3;  // UTF-8 byte order mark
}

void TextScanner::skip_blanks()
{
    while (here_ != end_) {
        if (is_blank(*here_))
            ++here_;
        else if (const char* next = joined_line(here_, end_))
            here_ = next;
        else
            return;
    }
}

bool TextScanner::at_line_end()
{
    skip_blanks();
    return here_ == end_ || is_newline(*here_) || *here_ == '#';
}

void TextScanner::skip_line()
{
    while (here_ != end_ && !is_newline(*here_)) ++here_;
    if (here_ != end_) here_ += *here_ == '\r' && here_ + 1 != end_ && here_[1] == '\n' ? 2 : 1;
}

bool TextScanner::seek_word()
{
    while (here_ != end_ && at_line_end()) skip_line();
    return here_ != end_;
}

std::string_view TextScanner::word()
{
    skip_blanks();
    const char* first = here_;
    skip_word();
    return {first, static_cast<std::size_t>(here_ - first)};
}

void TextScanner::skip_word()
{
    while (here_ != end_ && !is_blank(*here_) && !is_newline(*here_) && *here_ != '#') ++here_;
}

double TextScanner::number()
{
    skip_blanks();
    const char* first = here_ != end_ && *here_ == '+' ? here_ + 1 : here_;
    double value = 0.0;
    auto [last, error] = std::from_chars(first, end_, value);
    if (error == std::errc::result_out_of_range) {
        value = std::strtod(std::string(first, last).c_str(), nullptr);  // 0 or infinite, as IEEE 754 rounds
    } else if (error != std::errc{}) {
        fail("a number");
    }
    if (!is_word_end(last, end_)) fail("a number");
    here_ = last;
    return value;
}

long long TextScanner::integer()
{
    skip_blanks();
    const char* first = here_ != end_ && *here_ == '+' ? here_ + 1 : here_;
    long long value = 0;
    const auto [last, error] = std::from_chars(first, end_, value);
    if (error != std::errc{} || (!is_word_end(last, end_) && *last != '/')) fail("an integer");
    here_ = last;
    return value;
}

void TextScanner::fail(std::string_view expected)
{
    skip_blanks();
    std::size_t line = 1;
    for (const char* c = begin_; c != here_; ++c) line += *c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'));
    std::string found = "'" + std::string(printable_prefix({here_, static_cast<std::size_t>(end_ - here_)})) + "'";
    if (here_ == end_)
        found = "the end of the file";
    else if (is_newline(*here_))
        found = "the end of the line";
    throw InputError("line " + std::to_string(line) + ": expected " + std::string(expected) + ", found " + found);
}

}  // namespace koebe::io
