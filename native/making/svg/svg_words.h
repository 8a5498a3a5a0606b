// Words of an SVG's attributes, and the values of its elements.
#pragma once

#include <rapidxml_ns/rapidxml_ns.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace koebe::detail {

using SvgDocument = rapidxml_ns::xml_document<>;
using SvgNode = rapidxml_ns::xml_node<>;

inline constexpr std::string_view blanks = " \t\r\n\f";
inline constexpr int deepest_level = 100;  // elements inside each other, with what uses and clip paths bring in

inline std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

inline std::string_view name_of(const SvgNode& node) { return {node.local_name(), node.local_name_size()}; }

inline std::string_view value_of(const SvgNode& node, std::string_view name)
{
    for (const auto* one = node.first_attribute(); one; one = one->next_attribute())
        if (std::string_view(one->local_name(), one->local_name_size()) == name)
            return trimmed({one->value(), one->value_size()});
    return {};
}

/// Visits the parts between separators, but not inside of parentheses and quotes.
template <typename Visit>
void for_each_part(std::string_view text, char separator, Visit visit)
{
    int depth = 0;
    char quote = 0;
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= text.size(); ++at) {
        const char c = at < text.size() ? text[at] : separator;
        if (quote != 0 && at < text.size()) {
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '(' || c == ')') {
            depth += c == '(' ? 1 : -1;
        } else if (c == separator && (depth <= 0 || at == text.size())) {
            visit(trimmed(text.substr(begin, at - begin)));
            begin = at + 1;
        }
    }
}

inline std::vector<std::string_view> words_of(std::string_view text, std::string_view between = blanks)
{
    std::vector<std::string_view> words;
    for (std::size_t at = text.find_first_not_of(between); at < text.size(); at = text.find_first_not_of(between, at)) {
        const std::size_t end = std::min(text.find_first_of(between, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

}  // namespace koebe::detail
