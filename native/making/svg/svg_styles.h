// Style sheets of an SVG (W3C, CSS 2.2, 5 and 6).
#pragma once

#include "svg/svg_words.h"

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace koebe::detail {

/// The properties that decide what is drawn.
inline constexpr std::array drawn_properties{"display",   "visibility", "opacity",      "fill",      "stroke",
                                             "fill-rule", "transform",  "clip-path",    "clip-rule", "mask",
                                             "mask-type", "overflow",   "fill-opacity", "filter"};

struct Declaration {
    std::string property, value;
    bool important = false;
};

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

/// The rules of <style>. Selectors of types, classes, ids, descendants and children are known.
class StyleSheet {
public:
    void read(std::string_view text);

    /// The drawn properties that rules and the attribute `style` give an element, by the order of the cascade.
    std::map<std::string, std::string, std::less<>> properties_of(const SvgNode& node) const;

private:
    /// Rules, also of @media for screens; other blocks with @ are passed over.
    void read_rules(std::string_view css);
    void add_rules(std::string_view selectors, std::string_view body);

    std::unordered_map<std::string, std::vector<Rule>> rules_;  // by the last part's id, class or type
    int order_ = 0;
};

}  // namespace koebe::detail
