#include "files/text_lines.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace koebe::io {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

/// The kind of each character. A search among a few characters would cost a call per character of the text.
enum Kind : unsigned char { letter, blank, end_of_words };
constexpr std::array<Kind, 256> kinds = [] {
    std::array<Kind, 256> result{};
    for (const char c : blanks) result[static_cast<unsigned char>(c)] = blank;
    for (const char c : {'\n', '#'}) result[static_cast<unsigned char>(c)] = end_of_words;
    return result;
}();

Kind kind_of(char c) { return kinds[static_cast<unsigned char>(c)]; }

const char* after_blanks(std::string_view text)
{
    const char *here = text.data(), *const last = here + text.size();
    while (here != last && kind_of(*here) == blank) ++here;
    return here;
}

const char* end_of_word(const char* here, const char* last)
{
    while (here != last && kind_of(*here) == letter) ++here;
    return here;
}

/// from_chars accepts no plus sign.
std::string_view without_plus(std::string_view word)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
    return word;
}

}  // namespace

bool to_number(std::string_view word, double& number)
{
    word = without_plus(word);
    const char* last = word.data() + word.size();
    const auto [end, error] = fast_float::from_chars(word.data(), last, number);
    return !word.empty() && end == last && error == std::errc() && std::isfinite(number);
}

bool to_number(std::string_view word, Index& number)
{
    word = without_plus(word);
    const char* last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, number);
    return !word.empty() && end == last && error == std::errc();
}

std::string_view take_word(std::string_view& text)
{
    constexpr std::string_view spaces = " \t\r\n\v\f";
    const auto is_space = [&](char c) { return spaces.find(c) != spaces.npos; };
    const char *here = text.data(), *const last = here + text.size();
    while (here != last && is_space(*here)) ++here;
    const char* const begin = here;
    while (here != last && !is_space(*here)) ++here;
    text = text_between(here, last);
    return text_between(begin, here);
}

bool joins_next_line(std::string_view line)
{
    const std::size_t last = line.find_last_not_of(blanks);
    return last != line.npos && line[last] == '\\' && line.find('#') == line.npos;
}

bool TextLines::next_line()
{
    if (begun_ && !rest_.empty())
        rest_.remove_prefix(rest_.front() == '\n' ? 1 : std::min(rest_.find('\n'), rest_.size() - 1) + 1);
    begun_ = !rest_.empty();
    return begun_;
}

bool TextLines::next_statement()
{
    for (bool joined = begun_; joined;) {
        if (rest_.starts_with('\n')) break;  // nearly always
        const std::string_view line = rest_of_line();
        joined = line.size() < rest_.size() && joins_next_line(line);
        if (joined) rest_.remove_prefix(line.size() + 1);
    }
    return next_line();
}

std::string_view TextLines::next_word()
{
    const char* const last = rest_.data() + rest_.size();
    const char* const begin = after_blanks(rest_);
    const char* const end = end_of_word(begin, last);
    rest_ = text_between(end, last);
    return text_between(begin, end);
}

std::string_view TextLines::next_word_of_joined_lines()
{
    for (;;) {
        std::string_view word = next_word();
        if (!word.ends_with('\\')) return word;
        const std::size_t end = std::min(rest_.find_first_not_of(blanks), rest_.size());
        if (end < rest_.size() && rest_[end] != '\n') return word;
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        word.remove_suffix(1);
        if (!word.empty()) return word;
    }
}

bool TextLines::next_plain(double& number)
{
    const char* const last = rest_.data() + rest_.size();
    const auto [end, error] = fast_float::from_chars(after_blanks(rest_), last, number);
    if (error != std::errc() || !std::isfinite(number) || (end != last && kind_of(*end) == letter)) return false;
    rest_ = text_between(end, last);
    return true;
}

bool TextLines::next_plain(Index& number)
{
    const char* const last = rest_.data() + rest_.size();
    auto [end, error] = std::from_chars(after_blanks(rest_), last, number);
    if (error != std::errc()) return false;
    if (end != last && *end == '/') {
        end = end_of_word(end, last);
        if (end[-1] == '\\') return false;  // a backslash may join lines
    }
    if (end != last && kind_of(*end) == letter) return false;
    rest_ = text_between(end, last);
    return true;
}

}  // namespace koebe::io
