#include "lift/svg_document.h"

#include "core/errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace koebe::detail {
namespace {

constexpr int deepest_level = 100;             // elements inside each other, with what uses bring in
constexpr int deepest_entity = 16;             // entities inside each other
constexpr std::size_t most_elements = 200000;  // with what uses bring in: a drawing has no more corners
constexpr std::size_t most_bytes = 64 << 20;   // with what entities bring in
constexpr std::string_view svg_uri = "http://www.w3.org/2000/svg";
constexpr std::string_view blanks = " \t\r\n\f";

/// The properties that decide what is drawn.
constexpr std::array drawn_properties{"display",   "visibility", "opacity",   "fill", "stroke",
                                      "fill-rule", "transform",  "clip-path", "mask"};

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view name_of(const SvgNode& node) { return {node.local_name(), node.local_name_size()}; }

std::string_view value_of(const SvgNode& node, std::string_view name)
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

std::vector<std::string_view> words_of(std::string_view text, std::string_view between = blanks)
{
    std::vector<std::string_view> words;
    for (std::size_t at = text.find_first_not_of(between); at < text.size(); at = text.find_first_not_of(between, at)) {
        const std::size_t end = std::min(text.find_first_of(between, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

// ---- entities

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

// ---- styles

struct Declaration {
    std::string property, value;
    bool important = false;
};

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

/// A part of a selector between combinators.
struct Compound {
    std::string type, id;  // empty: any
    std::vector<std::string> classes;
    bool child = false;  // must be the parent of what follows, else any ancestor
};

struct Rule {
    std::vector<Compound> selector;
    std::array<int, 3> specificity{};  // ids, classes, types
    int order = 0;
    std::vector<Declaration> declarations;
};

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

class StyleSheet {
public:
    void read(std::string_view text)
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

    /// The declarations for an element, those that count most last.
    std::vector<const Declaration*> declarations_for(const SvgNode& node) const
    {
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
        std::vector<const Declaration*> found;
        for (const Rule* rule : matching)
            for (const Declaration& one : rule->declarations) found.push_back(&one);
        return found;
    }

private:
    /// Rules, also of @media for screens; other blocks with @ are passed over.
    void read_rules(std::string_view css)
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

    void add_rules(std::string_view selectors, std::string_view body)
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

    static bool matches(const Compound& part, const SvgNode& node)
    {
        if (!part.type.empty() && part.type != name_of(node)) return false;
        if (!part.id.empty() && part.id != value_of(node, "id")) return false;
        const std::vector<std::string_view> words = words_of(value_of(node, "class"));
        return std::ranges::all_of(
            part.classes, [&](const std::string& name) { return std::ranges::find(words, name) != words.end(); });
    }

    /// Whether the parts of a selector up to this one match an element and its ancestors.
    static bool matches(const Rule& rule, const SvgNode& node, std::size_t part)
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

    std::unordered_map<std::string, std::vector<Rule>> rules_;  // by the last part's id, class or type
    int order_ = 0;
};

// ---- places

/// A length in pixels; no value for what is none. @param whole what percentages are of
std::optional<double> pixels_of(std::string_view text, double whole)
{
    double number = 0.0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) return {};
    const std::string_view unit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"px", 1.0},
                                                                        {"in", 96.0},
                                                                        {"cm", 96.0 / 2.54},
                                                                        {"mm", 96.0 / 25.4},
                                                                        {"pt", 96.0 / 72.0},
                                                                        {"pc", 16.0},
                                                                        {"em", 16.0},
                                                                        {"ex", 8.0}}};
    if (unit.empty()) return number;
    if (unit == "%") return 0.01 * number * whole;
    const auto found = std::ranges::find(units, unit, &std::pair<std::string_view, double>::first);
    return found == units.end() ? std::nullopt : std::optional(number * found->second);
}

struct Size {
    double width = 100.0, height = 100.0;
};

struct ViewBox {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

std::optional<ViewBox> view_box_of(const SvgNode& node)
{
    std::vector<double> numbers;
    for (const std::string_view word : words_of(value_of(node, "viewBox"), " ,\t\r\n"))
        if (const auto number = pixels_of(word, 1.0)) numbers.push_back(*number);
    if (numbers.size() != 4 || !(numbers[2] > 0.0 && numbers[3] > 0.0)) return {};
    return ViewBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::string number_text(double number)
{
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", number);
    return text.data();
}

/// The transform from the coordinates inside an element to its viewport, with the viewport's place (SVG 1.1, 7.8).
std::string viewport_transform(const ViewBox& box, std::string_view ratio, const ViewBox& port)
{
    double wide = port.width / box.width, high = port.height / box.height, left = 0.0, low = 0.0;
    if (!ratio.starts_with("none")) {
        const bool slice = ratio.find("slice") != std::string_view::npos;
        const double scale = slice ? std::max(wide, high) : std::min(wide, high);
        wide = high = scale;
        const auto share = [&](std::string_view least, std::string_view most) {
            return ratio.find(least) != std::string_view::npos  ? 0.0
                   : ratio.find(most) != std::string_view::npos ? 1.0
                                                                : 0.5;
        };
        left = share("xMin", "xMax") * (port.width - scale * box.width);
        low = share("YMin", "YMax") * (port.height - scale * box.height);
    }
    return "matrix(" + number_text(wide) + " 0 0 " + number_text(high) + " " +
           number_text(port.x + left - wide * box.x) + " " + number_text(port.y + low - high * box.y) + ")";
}

class Resolving {
public:
    Resolving(SvgDocument& document, SvgNode& root) : document_(document), root_(root) {}

    void run()
    {
        for (SvgNode* node = &root_; node; node = next_of(node)) {
            if (node->namespace_uri_size() == 0) node->namespace_uri(svg_uri.data(), svg_uri.size());
            if (name_of(*node) != "style") continue;
            for (const SvgNode* text = node->first_node(); text; text = text->next_sibling())
                sheet_.read({text->value(), text->value_size()});
        }
        for (SvgNode* node = &root_; node; node = next_of(node)) {
            take_styles(*node);
            if (const std::string_view id = value_of(*node, "id"); !id.empty()) by_id_.emplace(id, node);
        }
        // a copy is resolved, as uses copy elements that are as they were
        SvgNode* group = copy_of_children(root_);
        const std::optional<ViewBox> box = view_box_of(root_);
        const Size page{pixels_of(value_of(root_, "width"), 100.0).value_or(box ? box->width : 100.0),
                        pixels_of(value_of(root_, "height"), 100.0).value_or(box ? box->height : 100.0)};
        elements_ = 0;
        Shown shown;
        const bool drawn = inherit(root_, shown);
        if (drawn) resolve_children(*group, shown, box ? Size{box->width, box->height} : page, 1);
        root_.remove_all_nodes();
        if (drawn) root_.append_node(group);
        if (box && value_of(root_, "preserveAspectRatio").starts_with("none"))
            set(*group, "transform", viewport_transform(*box, "none", {0.0, 0.0, page.width, page.height}));
    }

private:
    /// What children inherit.
    struct Shown {
        bool visible = true, filled = true, stroked = false;
    };

    SvgNode* next_of(SvgNode* node) const
    {
        const auto element = [](SvgNode* one) {
            while (one && one->type() != rapidxml_ns::node_element) one = one->next_sibling();
            return one;
        };
        if (SvgNode* child = element(node->first_node())) return child;
        for (; node != &root_; node = node->parent())
            if (SvgNode* next = element(node->next_sibling())) return next;
        return nullptr;
    }

    void set(SvgNode& node, std::string_view name, std::string_view value)
    {
        for (auto* one = node.first_attribute(); one;) {
            auto* const next = one->next_attribute();
            if (std::string_view(one->local_name(), one->local_name_size()) == name) node.remove_attribute(one);
            one = next;
        }
        const auto stored = [&](std::string_view text) {
            return document_.allocate_string(text.empty() ? "" : text.data(), text.size());
        };
        if (!value.empty())
            node.append_attribute(document_.allocate_attribute(stored(name), stored(value), name.size(), value.size()));
    }

    /// The properties of rules and of `style` as attributes.
    void take_styles(SvgNode& node)
    {
        const std::vector<Declaration> own = declarations_in(value_of(node, "style"));
        std::map<std::string_view, const Declaration*> chosen;
        const auto choose = [&](const Declaration& one) {
            const Declaration*& now = chosen[one.property];
            if (!now || one.important || !now->important) now = &one;
        };
        for (const Declaration* one : sheet_.declarations_for(node)) choose(*one);
        for (const Declaration& one : own) choose(one);
        for (const auto& [property, declaration] : chosen) {
            std::string value = declaration->value;
            if (property == "transform" && value == "none") value.clear();
            if (property == "transform")  // CSS has units where SVG has none
                for (const std::string_view unit : {"px", "deg"})
                    for (std::size_t at = value.find(unit); at != std::string::npos; at = value.find(unit))
                        value.erase(at, unit.size());
            set(node, property, value);
        }
        set(node, "style", "");
    }

    /// Takes over what an element says of itself. @return false if neither it nor its children are drawn
    static bool inherit(const SvgNode& node, Shown& shown)
    {
        const auto take = [&](std::string_view name, bool& flag, auto off) {
            const std::string_view value = value_of(node, name);
            if (!value.empty() && value != "inherit") flag = !off(value);
        };
        const auto unpainted = [](std::string_view value) { return value == "none" || value == "transparent"; };
        take("visibility", shown.visible, [](std::string_view v) { return v == "hidden" || v == "collapse"; });
        take("fill", shown.filled, unpainted);
        take("stroke", shown.stroked, unpainted);
        const std::string_view opacity = value_of(node, "opacity");
        return value_of(node, "display") != "none" && (opacity.empty() || pixels_of(opacity, 1.0).value_or(1.0) > 0.0);
    }

    /// The conditional attributes (SVG 1.1, 5.8). No extension is known, and the language is English.
    static bool holds(const SvgNode& node)
    {
        for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
            const std::string_view name(one->local_name(), one->local_name_size());
            const std::string_view value = trimmed({one->value(), one->value_size()});
            if (name == "requiredExtensions") return false;
            if (name != "systemLanguage") continue;
            bool english = false;
            for_each_part(value, ',', [&](std::string_view word) { english = english || word.starts_with("en"); });
            if (!english) return false;
        }
        return true;
    }

    /// A group with copies of an element's children.
    SvgNode* copy_of_children(const SvgNode& node)
    {
        SvgNode* group = document_.allocate_node(rapidxml_ns::node_element, "g");
        group->namespace_uri(svg_uri.data(), svg_uri.size());
        for (const SvgNode* child = node.first_node(); child; child = child->next_sibling())
            if (child->type() == rapidxml_ns::node_element) group->append_node(copy_of(*child));
        return group;
    }

    SvgNode* copy_of(const SvgNode& node)
    {
        if (++elements_ > most_elements)
            throw InputError("with what its uses bring in the SVG has over 200,000 elements");
        SvgNode* copy = document_.allocate_node(rapidxml_ns::node_element);
        copy->qname(node.name(), node.name_size(), node.local_name());
        copy->namespace_uri(node.namespace_uri(), node.namespace_uri_size());
        for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
            auto* attribute = document_.allocate_attribute();
            attribute->qname(one->name(), one->name_size(), one->local_name());
            attribute->namespace_uri(one->namespace_uri(), one->namespace_uri_size());
            attribute->value(one->value(), one->value_size());
            copy->append_attribute(attribute);
        }
        for (const SvgNode* child = node.first_node(); child; child = child->next_sibling())
            if (child->type() == rapidxml_ns::node_element) copy->append_node(copy_of(*child));
        return copy;
    }

    /// A group in place of an <svg>, or of a <symbol> for a use that may give its size. @param size of the viewport
    /// around, replaced by the one inside
    SvgNode* viewport_group(const SvgNode& node, const SvgNode* use, Size& size)
    {
        const auto length = [&](std::string_view name, double whole, double otherwise) {
            if (use && name.size() > 1)  // width and height: x and y of a use move its group
                if (const auto given = pixels_of(value_of(*use, name), whole)) return *given;
            return pixels_of(value_of(node, name), whole).value_or(otherwise);
        };
        const bool is_symbol = name_of(node) == "symbol";
        const ViewBox port{is_symbol ? 0.0 : length("x", size.width, 0.0),
                           is_symbol ? 0.0 : length("y", size.height, 0.0), length("width", size.width, size.width),
                           length("height", size.height, size.height)};
        SvgNode* group = copy_of_children(node);
        for (const char* name : drawn_properties)
            if (std::string_view(name) != "transform") set(*group, name, value_of(node, name));
        const std::optional<ViewBox> box = view_box_of(node);
        if (!(port.width > 0.0 && port.height > 0.0)) set(*group, "display", "none");
        const ViewBox inside = box.value_or(ViewBox{0.0, 0.0, port.width, port.height});
        if (port.width > 0.0 && port.height > 0.0)
            set(*group, "transform",
                std::string(value_of(node, "transform")) + " " +
                    viewport_transform(inside, value_of(node, "preserveAspectRatio"), port));
        size = {inside.width, inside.height};
        return group;
    }

    /// A group in place of a <use>. @return none if there is no such element
    SvgNode* used_group(const SvgNode& use, Size& size)
    {
        const std::string_view link = value_of(use, "href");
        const auto target = link.starts_with('#') ? by_id_.find(std::string(link.substr(1))) : by_id_.end();
        if (target == by_id_.end()) return nullptr;
        SvgNode* group = document_.allocate_node(rapidxml_ns::node_element, "g");
        group->namespace_uri(svg_uri.data(), svg_uri.size());
        for (const char* name : drawn_properties) set(*group, name, value_of(use, name));
        const double x = pixels_of(value_of(use, "x"), size.width).value_or(0.0);
        const double y = pixels_of(value_of(use, "y"), size.height).value_or(0.0);
        set(*group, "transform",
            std::string(value_of(use, "transform")) + " translate(" + number_text(x) + " " + number_text(y) + ")");
        const std::string_view name = name_of(*target->second);
        group->append_node(name == "symbol" || name == "svg" ? viewport_group(*target->second, &use, size)
                                                             : copy_of(*target->second));
        return group;
    }

    void resolve_children(SvgNode& parent, const Shown& shown, const Size& size, int depth)
    {
        if (depth > deepest_level)
            throw InputError("elements of the SVG are nested more than " + std::to_string(deepest_level) +
                             " deep, or a use contains itself");
        const bool is_switch = name_of(parent) == "switch";
        bool chosen = false;
        for (SvgNode* child = parent.first_node(); child;) {
            SvgNode* const next = child->next_sibling();
            const bool is_element = child->type() == rapidxml_ns::node_element;
            const bool stays = is_element && holds(*child) && !(is_switch && chosen);
            chosen = chosen || stays;
            if (is_element && (!stays || !resolve_element(parent, child, shown, size, depth)))
                parent.remove_node(child);
            child = next;
        }
        if (is_switch) parent.name("g", 1);
    }

    /// Lengths of a shape in percent of the viewport become pixels.
    void take_percentages(SvgNode& node, const Size& size)
    {
        std::vector<std::pair<std::string, double>> lengths;
        for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
            const std::string name(one->local_name(), one->local_name_size());
            const std::string_view value = trimmed({one->value(), one->value_size()});
            if (!value.ends_with('%')) continue;
            const bool wide = name == "x" || name == "cx" || name == "rx" || name == "width";
            const bool high = name == "y" || name == "cy" || name == "ry" || name == "height";
            if (!wide && !high && name != "r") continue;
            const double whole = wide   ? size.width
                                 : high ? size.height
                                        : std::hypot(size.width, size.height) / std::sqrt(2.0);
            if (const auto length = pixels_of(value, whole)) lengths.emplace_back(name, *length);
        }
        for (const auto& [name, length] : lengths) set(node, name, number_text(length));
    }

    static bool draws_nothing(std::string_view name)
    {
        constexpr std::array kept{"defs",   "symbol",        "clipPath",       "mask",           "pattern",
                                  "marker", "style",         "linearGradient", "radialGradient", "filter",
                                  "font",   "foreignObject", "metadata",       "title",          "desc"};
        return std::ranges::find(kept, name) != kept.end();
    }

    /// @return false if the element goes
    bool resolve_element(SvgNode& parent, SvgNode* child, Shown shown, Size size, int depth)
    {
        if (draws_nothing(name_of(*child))) return false;
        if (!inherit(*child, shown)) return false;
        SvgNode* group = nullptr;
        if (name_of(*child) == "use") {
            group = used_group(*child, size);
        } else if (name_of(*child) == "svg") {
            group = viewport_group(*child, nullptr, size);
            if (value_of(*group, "display") == "none") return false;
        }
        if (group) {
            parent.insert_node(child, group);
            resolve_children(*group, shown, size, depth + 1);
            return false;
        }
        const std::string_view name = name_of(*child);
        const bool is_group = name == "g" || name == "a" || name == "switch";
        take_percentages(*child, size);
        if (is_group) resolve_children(*child, shown, size, depth + 1);
        return is_group || (shown.visible && (shown.filled || shown.stroked));
    }

    SvgDocument& document_;
    SvgNode& root_;
    StyleSheet sheet_;
    std::unordered_map<std::string, SvgNode*> by_id_;
    std::size_t elements_ = 0;
};

}  // namespace

std::string with_entities(std::string text)
{
    const Entities entities = take_doctype(text);
    if (entities.empty()) return text;
    std::string expanded;
    append_expanded(text, entities, 0, expanded);
    return expanded;
}

void resolve(SvgDocument& document, SvgNode& root) { Resolving(document, root).run(); }

}  // namespace koebe::detail
