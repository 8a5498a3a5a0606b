#include "svg/svg_text.h"

#include "core/errors.h"
#include "svg/svg_words.h"

#include <algorithm>
#include <map>

namespace koebe::detail {
namespace {

constexpr int deepest_entity = 16;            // entities inside each other
constexpr std::size_t most_bytes = 64 << 20;  // with what entities bring in

using Entities = std::map<std::string, std::string, std::less<>>;

/// Takes the DOCTYPE out of a text, and its entities.
Entities take_doctype(std::string& text)
{
    Entities entities;
    const std::size_t begin = text.find("<!DOCTYPE");
    if (begin == std::string::npos) return entities;
    bool inside = false;
    std::size_t at = begin + 9;
    for (; at < text.size(); ++at) {
        const std::string_view rest = std::string_view(text).substr(at);
        if (rest.starts_with("<!--")) {
            at = std::min(text.find("-->", at + 4), text.size() - 1);
        } else if (rest.starts_with("<!ENTITY")) {
            const std::size_t quote = text.find_first_of("\"'>", at);
            const std::string_view head = trimmed(rest.substr(8, quote == std::string::npos ? 0 : quote - at - 8));
            if (quote == std::string::npos || text[quote] == '>') continue;
            const std::size_t end = text.find(text[quote], quote + 1);
            if (end == std::string::npos) break;
            if (head.find_first_of(" \t\r\n%") == std::string_view::npos)  // no parameter, no SYSTEM file
                entities.emplace(head, text.substr(quote + 1, end - quote - 1));
            at = end;
        } else if (rest[0] == '"' || rest[0] == '\'') {
            at = std::min(text.find(rest[0], at + 1), text.size() - 1);
        } else if (rest[0] == '[' || rest[0] == ']') {
            inside = rest[0] == '[';
        } else if (rest[0] == '>' && !inside) {
            break;
        }
    }
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin),
              text.begin() + static_cast<std::ptrdiff_t>(std::min(at + 1, text.size())), ' ');
    return entities;
}

void append_expanded(std::string_view text, const Entities& entities, int depth, std::string& to)
{
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find('&', at), text.size());
        to.append(text, at, begin - at);
        if (to.size() > most_bytes || depth > deepest_entity)
            throw InputError("the entities of the SVG grow to over 64 MB, or contain themselves");
        const std::size_t end = begin < text.size() ? text.find(';', begin) : std::string_view::npos;
        const auto found =
            end == std::string_view::npos ? entities.end() : entities.find(text.substr(begin + 1, end - begin - 1));
        if (found != entities.end()) {
            append_expanded(found->second, entities, depth + 1, to);
            at = end + 1;
        } else if (begin < text.size()) {
            to += '&';
            at = begin + 1;
        } else {
            at = begin;
        }
    }
}

}  // namespace

std::string with_entities(std::string text)
{
    const Entities entities = take_doctype(text);
    if (entities.empty()) return text;
    std::string expanded;
    append_expanded(text, entities, 0, expanded);
    return expanded;
}

void require_shallow(std::string_view text)
{
    const auto after = [&](std::size_t at, std::string_view end) {
        const std::size_t found = text.find(end, at);
        return found == text.npos ? text.size() : found + end.size();
    };
    int depth = 0;
    for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with("<!--")) {
            at = after(at + 4, "-->");
        } else if (rest.starts_with("<![CDATA[")) {
            at = after(at, "]]>");
        } else if (rest.starts_with("<?")) {
            at = after(at, "?>");
        } else if (rest.starts_with("</")) {
            --depth;
            at += 2;
        } else if (rest.starts_with("<!")) {
            at += 2;
        } else {
            // An element: its end is a > outside of quotes.
            char quote = 0;
            for (++at; at < text.size() && (quote != 0 || text[at] != '>'); ++at)
                if (quote != 0 ? text[at] == quote : text[at] == '"' || text[at] == '\'')
                    quote = quote != 0 ? 0 : text[at];
            if (at < text.size() && text[at - 1] != '/' && ++depth > deepest_level)
                throw InputError("elements of the SVG are nested more than " + std::to_string(deepest_level) +
                                 " deep, at byte " + std::to_string(at));
        }
    }
}

}  // namespace koebe::detail
