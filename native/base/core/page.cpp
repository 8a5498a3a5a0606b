#include "core/page.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

namespace koebe {
namespace {

constexpr double least_side = 20.0, most_side = 1e5;        // mm
constexpr double widest_margin = 12.0, margin_share = 0.1;  // mm, and of the shorter side

struct NamedPage {
    std::string_view name;
    double width, height;  // mm
};

constexpr std::array known_pages = {
    NamedPage{"A4", 210.0, 297.0},    NamedPage{"A3", 297.0, 420.0},      NamedPage{"A2", 420.0, 594.0},
    NamedPage{"A1", 594.0, 841.0},    NamedPage{"A0", 841.0, 1189.0},     NamedPage{"letter", 215.9, 279.4},
    NamedPage{"legal", 215.9, 355.6}, NamedPage{"tabloid", 279.4, 431.8},
};

bool take_side(std::string_view word, double& side)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), side);
    return error == std::errc{} && end == word.data() + word.size() && side >= least_side && side <= most_side;
}

}  // namespace

double millimetres(LengthUnit unit)
{
    switch (unit) {
    case LengthUnit::mm: return 1.0;
    case LengthUnit::cm: return 10.0;
    case LengthUnit::m: return 1000.0;
    case LengthUnit::in: return 25.4;
    }
    return 1.0;
}

std::optional<Page> page_named(const std::string& name)
{
    if (name == "none") return Page{};
    Page page;
    const auto known = std::ranges::find(known_pages, name, &NamedPage::name);
    if (known != known_pages.end()) {
        page = {known->width, known->height};
    } else {
        const std::size_t cross = name.find('x');
        if (cross == std::string::npos || !take_side(std::string_view(name).substr(0, cross), page.width) ||
            !take_side(std::string_view(name).substr(cross + 1), page.height))
            return {};
    }
    page.margin = std::min(widest_margin, margin_share * std::min(page.width, page.height));
    return page;
}

std::string page_help(const std::string& name)
{
    std::string names;
    for (const NamedPage& page : known_pages) names += std::string(page.name) + ", ";
    return "must be none, " + names + "or WIDTHxHEIGHT in mm, each from 20 to 100000; got '" + name + "'";
}

}  // namespace koebe
