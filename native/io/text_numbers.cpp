#include "io/text_numbers.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace koebe::io {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

bool is_blank(char c) { return blanks.find(c) != std::string_view::npos; }

/// Neither from_chars takes a plus sign.
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

bool TextLines::next_line()
{
    if (begun_) rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
    begun_ = !rest_.empty();
    return begun_;
}

std::string_view TextLines::next_word()
{
    std::size_t begin = 0;
    while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n' && rest_[end] != '#') ++end;
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
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

}  // namespace koebe::io
