#include "lift/pattern_place.h"

#include "core/errors.h"
#include "lift/outline_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double disk_share = 0.9;  // of the radius, without a size

double scale_in_middle(const FlatSheet& sheet)
{
    const SheetPlace place = places_in_sheet(sheet, {Complex(0.5, 0.5)}, 1e-9).front();
    return place.face < 0 ? sheet.mean_scale : sheet.scale_at(place.face, place.weights);
}

}  // namespace

Complex unit_turn(double degrees)
{
    const Complex turn = std::polar(1.0, degrees / 180.0 * std::numbers::pi);
    if (degrees != std::round(degrees / 90.0) * 90.0) return turn;
    return {std::round(turn.real()), std::round(turn.imag())};
}

PlacedFrame placed_frame(const FlatSheet& sheet, double aspect, const PatternPlace& place, const std::string& what,
                         double taken)
{
    const int repeats = std::max(1, place.repeats);
    if (repeats > 1 && sheet.periods.empty())
        throw InputError("repeats of a " + what + " are for rings and tori: another domain does not repeat");
    // The room: the domain's box, or each copy's share of the period.
    const PlaneBox domain = place.on_sphere ? PlaneBox{{0.0, 0.0}, {1.0, 1.0}} : box_around(sheet.uv);
    Complex room = domain.size();
    if (!sheet.periods.empty()) room = {std::abs(sheet.periods[0]) / repeats, room.imag()};
    // The width: as asked, or as large as fits.
    PlacedFrame frame;
    frame.scale = place.on_sphere ? scale_in_middle(sheet) : sheet.mean_scale;
    if (place.size)
        frame.width = *place.size / frame.scale;
    else if (place.in_disk)
        frame.width = disk_share * room.real() / std::hypot(1.0, aspect);
    else
        frame.width = taken * std::min(room.real(), room.imag() / aspect);
    if (repeats > 1 && frame.width > room.real() * (1.0 + 1e-12))
        throw InputError("the " + what + (what == "mesh" ? "es" : "s") +
                         " are wider than their share of the period: they have room up to a size of " +
                         std::to_string(room.real() * frame.scale));
    // A centre for each copy, along the first period.
    for (int copy = 0; copy < repeats; ++copy)
        frame.centres.push_back(
            0.5 * (domain.low + domain.high) +
            (sheet.periods.empty() ? Complex(0.0, 0.0) : sheet.periods[0] * (static_cast<double>(copy) / repeats)));
    return frame;
}

}  // namespace koebe
