#include "svg/svg_styles.h"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace koebe::detail {
namespace {

std::vector<Declaration> declarations_in(std::string_view text)
{
    std::vector<Declaration> found;
    for_each_part(text, ';', [&](std::string_view one) {
        const std::size_t colon = one.find(':');
        if (colon == std::string_view::npos) return;
        Declaration declaration{std::string(trimmed(one.substr(0, colon))),
                                std::string(trimmed(one.substr(colon + 1)))};
        if (std::ranges::find(drawn_properties, declaration.property) == drawn_properties.end()) return;
        if (const std::size_t mark = declaration.value.rfind('!'); mark != std::string::npos) {
            declaration.important = trimmed(std::string_view(declaration.value).substr(mark + 1)) == "important";
            declaration.value = trimmed(std::string_view(declaration.value).substr(0, mark));
        }
        found.push_back(std::move(declaration));
    });
    return found;
}

/// @return no value for a selector that is not known: it matches nothing
std::optional<std::vector<Compound>> selector_of(std::string_view text)
{
    std::vector<Compound> selector(1);
    bool begun = false, gap = false;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (blanks.find(c) != std::string_view::npos) {
            gap = begun;
            ++at;
            continue;
        }
        // A child, or a descendant after blanks, begins the next compound.
        if (c == '>') {
            selector.back().child = true;
            gap = true;
            ++at;
            continue;
        }
        if (gap) {
            selector.emplace_back();
            gap = false;
        }
        begun = true;
        // A type, .class, #id or *.
        const bool has_mark = c == '.' || c == '#';
        const std::size_t from = at + (has_mark ? 1 : 0);
        const std::size_t end = std::min(text.find_first_of(".#>:[+~* \t\r\n\f", from), text.size());
        const std::string word(text.substr(from, end - from));
        if (c == '*') {
            ++at;
            continue;
        }
        if (word.empty()) return {};
        (c == '#' ? selector.back().id : selector.back().type) = c == '.' ? selector.back().type : word;
        if (c == '.') selector.back().classes.push_back(word);
        at = end;
    }
    if (!begun || gap) return {};
    return selector;
}

bool matches(const Compound& part, const SvgNode& node)
{
    if (!part.type.empty() && part.type != name_of(node)) return false;
    if (!part.id.empty() && part.id != value_of(node, "id")) return false;
    const std::vector<std::string_view> words = words_of(value_of(node, "class"));
    return std::ranges::all_of(part.classes,
                               [&](const std::string& name) { return std::ranges::find(words, name) != words.end(); });
}

/// Whether the parts of a selector up to this one match an element and its ancestors.
bool matches(const Rule& rule, const SvgNode& node, std::size_t part)
{
    if (!matches(rule.selector[part], node)) return false;
    if (part == 0) return true;
    for (const SvgNode* above = node.parent(); above && above->type() == rapidxml_ns::node_element;
         above = above->parent()) {
        if (matches(rule, *above, part - 1)) return true;
        if (rule.selector[part - 1].child) return false;
    }
    return false;
}

}  // namespace

void StyleSheet::read(std::string_view text)
{
    std::string css;  // without comments
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find("/*", at), text.size());
        css.append(text, at, begin - at);
        const std::size_t end = begin < text.size() ? text.find("*/", begin + 2) : std::string_view::npos;
        at = end == std::string_view::npos ? text.size() : end + 2;
    }
    read_rules(css);
}

std::map<std::string, std::string, std::less<>> StyleSheet::properties_of(const SvgNode& node) const
{
    // the rules that match, those that count most last
    std::vector<const Rule*> matching;
    const auto add = [&](const std::string& key) {
        const auto rules = rules_.find(key);
        if (rules == rules_.end()) return;
        for (const Rule& rule : rules->second)
            if (matches(rule, node, rule.selector.size() - 1)) matching.push_back(&rule);
    };
    add("*");
    add(std::string(name_of(node)));
    add("#" + std::string(value_of(node, "id")));
    for (const std::string_view word : words_of(value_of(node, "class"))) add("." + std::string(word));
    std::ranges::sort(matching, {}, [](const Rule* rule) { return std::tuple(rule->specificity, rule->order); });
    // a later declaration counts more, but not against an important one
    std::map<std::string, std::string, std::less<>> chosen;
    std::set<std::string> important;
    const auto choose = [&](const Declaration& one) {
        if (!one.important && important.contains(one.property)) return;
        if (one.important) important.insert(one.property);
        chosen[one.property] = one.value;
    };
    for (const Rule* rule : matching) std::ranges::for_each(rule->declarations, choose);
    std::ranges::for_each(declarations_in(value_of(node, "style")), choose);
    return chosen;
}

void StyleSheet::read_rules(std::string_view css)
{
    for (std::size_t at = 0; at < css.size();) {
        const std::size_t open = css.find_first_of("{;", at);
        if (open == std::string_view::npos) return;
        std::string_view head = trimmed(css.substr(at, open - at));
        for (const std::string_view mark : {"<!--", "-->"})
            if (head.starts_with(mark)) head = trimmed(head.substr(mark.size()));
        at = open + 1;
        if (css[open] == ';') continue;
        int depth = 1;
        while (at < css.size() && depth > 0) {
            if (css[at] == '{' || css[at] == '}') depth += css[at] == '{' ? 1 : -1;
            ++at;
        }
        const std::string_view body = css.substr(open + 1, at - open - 1 - (depth == 0 ? 1 : 0));
        if (head.starts_with("@media") && head.find('(') == std::string_view::npos &&
            (head.find("screen") != std::string_view::npos || head.find("all") != std::string_view::npos))
            read_rules(body);
        if (!head.starts_with("@")) add_rules(head, body);
    }
}

void StyleSheet::add_rules(std::string_view selectors, std::string_view body)
{
    const std::vector<Declaration> declarations = declarations_in(body);
    if (declarations.empty()) return;
    for_each_part(selectors, ',', [&](std::string_view one) {
        auto selector = selector_of(one);
        if (!selector) return;
        Rule rule{std::move(*selector), {}, order_++, declarations};
        for (const Compound& part : rule.selector) {
            rule.specificity[0] += part.id.empty() ? 0 : 1;
            rule.specificity[1] += static_cast<int>(part.classes.size());
            rule.specificity[2] += part.type.empty() ? 0 : 1;
        }
        const Compound& last = rule.selector.back();
        std::string key = "*";
        if (!last.type.empty()) key = last.type;
        if (!last.classes.empty()) key = "." + last.classes.front();
        if (!last.id.empty()) key = "#" + last.id;
        rules_[key].push_back(std::move(rule));
    });
}

}  // namespace koebe::detail
