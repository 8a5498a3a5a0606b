#include "cli/files/template_file.h"

#include "cli/files/text_file.h"
#include "core/errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>

namespace koebe::cli {
namespace {

using nlohmann::json;

/// A place in a template, and the errors about it.
struct TemplateEntry {
    const json& value;
    std::string where;

    [[noreturn]] void refuse(const std::string& why) const { throw InputError(where + " " + why); }

    /// @param keys that it may have
    void require_object(std::initializer_list<std::string_view> keys) const
    {
        if (!value.is_object()) refuse("is not an object");
        for (const auto& [key, entry] : value.items())
            if (std::ranges::find(keys, key) == keys.end()) refuse("has the unknown entry \"" + key + "\"");
    }

    bool has(const char* key) const { return value.contains(key); }

    TemplateEntry at(const char* key) const
    {
        if (!has(key)) refuse("has no \"" + std::string(key) + "\"");
        return {value.at(key), where + ": " + key};
    }

    double number() const
    {
        if (!value.is_number()) refuse("is not a number");
        return value.get<double>();
    }

    int whole() const
    {
        if (!value.is_number_integer() || value.get<double>() < 0.0 ||
            value.get<double>() > std::numeric_limits<int>::max())
            refuse("is not a whole number from 0 on");
        return value.get<int>();
    }
};

TemplateRim rim_in(const TemplateEntry& entry)
{
    TemplateRim rim;
    if (entry.has("rotates")) {
        const TemplateEntry rotates = entry.at("rotates");
        if (!rotates.value.is_boolean()) rotates.refuse("is neither true nor false");
        rim.rotates = rotates.value.get<bool>();
    }
    if (entry.has("pin")) {
        const TemplateEntry pin = entry.at("pin");
        pin.require_object({"vertex", "angle"});
        rim.pin =
            RimPin{static_cast<Index>(pin.at("vertex").whole()), pin.at("angle").number() * std::numbers::pi / 180.0};
        if (!rim.rotates) entry.refuse("is pinned and does not rotate: give one of both");
    }
    return rim;
}

Circle circle_in(const TemplateEntry& entry)
{
    const TemplateEntry center = entry.at("center");
    if (!center.value.is_array() || center.value.size() != 2) center.refuse("is not a pair of numbers");
    const TemplateEntry x{center.value[0], center.where}, y{center.value[1], center.where};
    return {{x.number(), y.number()}, entry.at("radius").number()};
}

void add_circle(const TemplateEntry& entry, CircleTemplate& wanted)
{
    entry.require_object({"name", "center", "radius", "loop", "rotates", "pin"});
    wanted.circles.push_back(circle_in(entry));
    wanted.rims.push_back(rim_in(entry));
    std::string name = std::to_string(wanted.names.size());
    if (entry.has("name")) {
        const TemplateEntry given = entry.at("name");
        if (!given.value.is_string()) given.refuse("is not a text");
        name = given.value.get<std::string>();
    }
    wanted.names.push_back(std::move(name));
    if (entry.has("loop")) wanted.loops.push_back(entry.at("loop").whole());
}

}  // namespace

CircleTemplate read_template(const std::string& path)
{
    const json text = json::parse(read_text(path), nullptr, false);
    if (text.is_discarded()) throw InputError(path + " is not JSON");
    const TemplateEntry whole{text, path};
    whole.require_object({"circles", "outer"});
    CircleTemplate wanted;
    const TemplateEntry circles = whole.at("circles");
    if (!circles.value.is_array()) circles.refuse("is not a list");
    for (std::size_t k = 0; k < circles.value.size(); ++k)
        add_circle({circles.value[k], path + ": circle " + std::to_string(k)}, wanted);
    if (!wanted.loops.empty() && wanted.loops.size() != wanted.circles.size())
        circles.refuse("name loops for some circles only");
    if (whole.has("outer")) {
        const TemplateEntry outer = whole.at("outer");
        outer.require_object({"rotates", "pin"});
        wanted.outer = rim_in(outer);
    }
    return wanted;
}

}  // namespace koebe::cli
