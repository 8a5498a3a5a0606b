#include "report/planar_json.h"

#include "core/counted.h"
#include "core/errors.h"
#include "shape/conformal_module.h"
#if __has_include("svg/svg_drawing.h")
#include "svg/svg_drawing.h"
#define KOEBE_READS_SVG
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>

namespace koebe {
namespace {

using nlohmann::json;

constexpr double least_segment = 1e-9;  // of an SVG curve's size: shorter ones only close it

/// An entry of a file, and the errors about it.
struct PlanarEntry {
    const json& value;
    std::string where;

    [[noreturn]] void refuse(const std::string& why) const { throw InputError(where + " " + why); }

    PlanarEntry at(const char* key) const
    {
        if (!value.is_object() || !value.contains(key)) refuse("has no \"" + std::string(key) + "\"");
        return {value.at(key), where + ": " + key};
    }

    void require_keys(std::initializer_list<std::string_view> keys) const
    {
        if (!value.is_object()) refuse("is not an object");
        for (const auto& [key, entry] : value.items())
            if (std::ranges::find(keys, key) == keys.end()) refuse("has the unknown entry \"" + key + "\"");
    }

    double number() const
    {
        if (!value.is_number()) refuse("is not a number");
        return value.get<double>();
    }

    double positive() const
    {
        if (!(number() > 0.0)) refuse("is not positive");
        return number();
    }

    Complex place() const
    {
        if (!value.is_array() || value.size() != 2) refuse("is not a pair of numbers");
        return {PlanarEntry{value[0], where}.number(), PlanarEntry{value[1], where}.number()};
    }

    std::vector<Complex> places(std::size_t least) const
    {
        if (!value.is_array() || value.size() < least) refuse("is not a list of places [x, y], or too short");
        std::vector<Complex> all;
        for (const json& one : value) all.push_back(PlanarEntry{one, where}.place());
        return all;
    }
};

PlanarRim rim_of(const PlanarEntry& entry)
{
    if (!entry.value.is_object() || entry.value.size() != 1)
        entry.refuse("must be one of points, bezier, circle, ellipse and fourier");
    const std::string kind = entry.value.begin().key();
    const PlanarEntry said = entry.at(kind.c_str());
    // Each kind of rim becomes Bezier segments, or a Fourier series.
    if (kind == "points") return polygon_rim(said.places(3));
    if (kind == "bezier") {
        std::vector<Complex> curve = said.places(6);
        if (curve.size() % 3 != 0) said.refuse("must have three places for each segment");
        curve.push_back(curve.front());
        return {.curve = std::move(curve)};
    }
    if (kind == "circle") {
        said.require_keys({"center", "radius"});
        const double radius = said.at("radius").positive();
        return ellipse_rim(said.at("center").place(), radius, radius, 0.0);
    }
    if (kind == "ellipse") {
        said.require_keys({"center", "half_axes", "turn"});
        const Complex axes = said.at("half_axes").place();
        if (!(axes.real() > 0.0 && axes.imag() > 0.0)) said.at("half_axes").refuse("are not positive");
        const double turn = said.value.contains("turn") ? said.at("turn").number() : 0.0;
        return ellipse_rim(said.at("center").place(), axes.real(), axes.imag(), turn * std::numbers::pi / 180.0);
    }
    if (kind == "fourier") {
        said.require_keys({"lowest", "coefficients"});
        const PlanarEntry lowest = said.at("lowest");
        if (!lowest.value.is_number_integer() || std::abs(lowest.number()) > 1000.0)
            lowest.refuse("is not a whole number from -1000 to 1000");
        std::vector<Complex> coefficients = said.at("coefficients").places(1);
        if (coefficients.size() > 1000) said.refuse("has more than 1000 coefficients");
        return {.fourier = std::move(coefficients), .lowest = lowest.value.get<int>()};
    }
    entry.refuse("has the unknown entry \"" + kind + "\"");
}

std::vector<PlanarRim> rims_of_svg(const std::string& text)
{
#ifdef KOEBE_READS_SVG
    std::vector<PlanarRim> rims;
    for (const SvgPath& path : parse_svg(text).paths)
        for (const std::vector<Complex>& curve : path.curves) {
            double size = 0.0;
            for (const Complex z : curve) size = std::max(size, std::abs(z - curve.front()));
            PlanarRim rim{.curve = {curve.front()}};
            for (std::size_t i = 1; i + 2 < curve.size(); i += 3) {
                double length = 0.0;
                for (std::size_t j = i; j < i + 3; ++j)
                    length = std::max(length, std::abs(curve[j] - rim.curve.back()));
                if (length > least_segment * size)
                    rim.curve.insert(rim.curve.end(), {curve[i], curve[i + 1], curve[i + 2]});
            }
            rim.curve.back() = rim.curve.front();
            rims.push_back(std::move(rim));
        }
    return rims;
#else
    throw InputError("this build reads no SVG (" + std::to_string(text.size()) + " bytes): it has no extra making");
#endif
}

nlohmann::ordered_json place_json(Complex place) { return {place.real(), place.imag()}; }

nlohmann::ordered_json slits_json(const PlanarResult& result)
{
    constexpr std::array kinds{"none", "parallel", "circular", "radial"};
    nlohmann::ordered_json rims = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < result.slits.size(); ++k) {
        const Slit& slit = result.slits[k];
        if (slit.begin == slit.end)
            rims.push_back({{"rim", result.order[k]}, {"radius", slit.begin.real()}});
        else
            rims.push_back(
                {{"rim", result.order[k]}, {"begin", place_json(slit.begin)}, {"end", place_json(slit.end)}});
    }
    return {{"kind", kinds[static_cast<std::size_t>(result.slit_kind)]}, {"error", result.slit_error}, {"rims", rims}};
}

}  // namespace

std::vector<PlanarRim> planar_rims(const std::string& text, bool is_svg)
{
    if (is_svg) return rims_of_svg(text);
    const json parsed = json::parse(text, nullptr, false);
    if (parsed.is_discarded()) throw InputError("the description of the rims is not JSON");
    const PlanarEntry whole{parsed, "the file"};
    whole.require_keys({"rims"});
    const PlanarEntry list = whole.at("rims");
    if (!list.value.is_array()) list.refuse("is not a list");
    std::vector<PlanarRim> rims;
    for (const json& one : list.value) rims.push_back(rim_of({one, "rim " + std::to_string(rims.size())}));
    return rims;
}

VectorXcd planar_places(const std::string& text)
{
    const json parsed = json::parse(text, nullptr, false);
    if (parsed.is_discarded()) throw InputError("the list of points is not JSON");
    const std::vector<Complex> all = PlanarEntry{parsed, "the list of points"}.places(0);
    for (const Complex z : all)
        if (!std::isfinite(z.real()) || !std::isfinite(z.imag())) throw InputError("a point is not finite");
    return Eigen::Map<const VectorXcd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

nlohmann::ordered_json places_json(const VectorXcd& places)
{
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Complex z : places) all.push_back(place_json(z));
    return all;
}

nlohmann::ordered_json to_json(const PlanarResult& result)
{
    nlohmann::ordered_json circles = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < result.circles.size(); ++k)
        circles.push_back({{"rim", result.order[k]},
                           {"center", place_json(result.circles[k].center)},
                           {"radius", result.circles[k].radius},
                           {"residual", result.residuals[k]}});
    nlohmann::ordered_json json{
        {"version", KOEBE_VERSION},
        {"input", ""},
        {"converged", result.converged},
        {"error", result.error},
        {"sweeps", result.sweeps},
        {"levels", result.levels},
        {"unknowns", result.unknowns},
        {"circles", circles},
        {"names", module_names(result.circles.size())},
        {"module", std::vector<double>(result.module.begin(), result.module.end())},
        {"errors", std::vector<double>(result.module_errors.begin(), result.module_errors.end())}};
    if (!result.slits.empty()) json["slits"] = slits_json(result);
    return json;
}

}  // namespace koebe
