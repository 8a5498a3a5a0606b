#include "planar/filled_paths.h"
#include "svg/svg_drawing.h"

#include "core/errors.h"
#include "planar/planar_predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

using namespace koebe;

namespace {

double area_of(const std::vector<FilledBoundary>& boundaries)
{
    double twice = 0.0;
    for (const FilledBoundary& b : boundaries)
        for (std::size_t i = 0; i < b.points.size(); ++i)
            twice += cross(b.points[i], b.points[(i + 1) % b.points.size()]);
    return 0.5 * twice;
}

std::vector<Complex> box(double x, double y, double width, double height)
{
    return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

SvgDrawing drawing_of(const std::string& inside)
{
    return parse_svg("<svg xmlns='http://www.w3.org/2000/svg'>" + inside + "</svg>");
}

/// The area of a drawing as it is cut.
double cut_area(const SvgDrawing& drawing)
{
    const auto filled = [](const std::vector<SvgPath>& given) {
        std::vector<FilledPath> paths;
        for (const SvgPath& path : given) paths.push_back({path.even_odd, flattened(path, 1e-4), path.clips});
        return paths;
    };
    std::vector<std::vector<FilledPath>> clips;
    for (const std::vector<SvgPath>& clip : drawing.clips) clips.push_back(filled(clip));
    return area_of(united_paths(filled(drawing.paths), clips));
}

}  // namespace

TEST(FilledPaths, TheRuleDecidesAboutAHole)
{
    const std::vector<std::vector<Complex>> rings{box(0, 0, 4, 4), box(1, 1, 2, 2)};
    EXPECT_DOUBLE_EQ(area_of(united_paths({{false, rings}})), 16.0);
    const std::vector<FilledBoundary> ring = united_paths({{true, rings}});
    ASSERT_EQ(ring.size(), 2U);
    EXPECT_NE(ring[0].hole, ring[1].hole);
    EXPECT_EQ(ring[0].area, ring[1].area);
    EXPECT_DOUBLE_EQ(area_of(ring), 12.0);
    EXPECT_DOUBLE_EQ(area_of(united_paths({{true, rings}, {false, {box(1, 1, 2, 2)}}})), 16.0) << "the hole is filled";
}

TEST(FilledPaths, DegenerateRingsFillNothing)
{
    EXPECT_TRUE(united_paths({}).empty());
    EXPECT_TRUE(united_paths({{false, {{}, {1.0}, {1.0, 1.0}, {0.0, 1.0, 2.0}}}}).empty());
    EXPECT_TRUE(united_paths({{true, {box(0, 0, 1, 1), box(0, 0, 1, 1)}}}).empty()) << "twice round is outside";
}

TEST(FilledPaths, RandomBoxesCoverAsManyCellsAsTheyHold)
{
    std::mt19937 random(35);
    for (int trial = 0; trial < 40; ++trial) {
        bool inside[12][12] = {};
        std::vector<FilledPath> paths;
        for (int k = 0; k < 5; ++k) {
            const int x = random() % 6, y = random() % 6, w = 1 + random() % 6, h = 1 + random() % 6;
            paths.push_back({k % 2 == 0, {box(x, y, w, h)}});
            for (int i = x; i < x + w; ++i)
                for (int j = y; j < y + h; ++j) inside[i][j] = true;
        }
        double cells = 0.0;
        for (const auto& row : inside)
            for (const bool cell : row) cells += cell;
        EXPECT_NEAR(area_of(united_paths(paths)), cells, 1e-9);
    }
}

TEST(FilledPaths, ClipsLeaveTheCellsThatLieInAllOfThem)
{
    std::mt19937 random(54);
    for (int trial = 0; trial < 40; ++trial) {
        // the first set is the drawing, cut by the second; the second, by the third
        std::vector<std::vector<FilledPath>> sets(3);
        bool inside[3][12][12] = {};
        for (int k = 0; k < 9; ++k) {
            const int x = random() % 6, y = random() % 6, w = 1 + random() % 6, h = 1 + random() % 6;
            sets[k % 3].push_back({k % 2 == 0, {box(x, y, w, h)}, {}});
            if (k % 3 < 2) sets[k % 3].back().clips = {k % 3};
            for (int i = x; i < x + w; ++i)
                for (int j = y; j < y + h; ++j) inside[k % 3][i][j] = true;
        }
        double cells = 0.0;
        for (int i = 0; i < 12; ++i)
            for (int j = 0; j < 12; ++j) cells += inside[0][i][j] && inside[1][i][j] && inside[2][i][j];
        EXPECT_NEAR(area_of(united_paths(sets[0], {sets[1], sets[2]})), cells, 1e-9);
    }
}

TEST(FilledPaths, CrossingLinesAreFilledByTheNumberOfWindings)
{
    std::mt19937 random(54);
    const auto number = [&] { return static_cast<double>(random() % 100000) / 1000.0; };
    for (const int corners : {5, 20, 120}) {
        std::vector<Complex> ring;
        for (int i = 0; i < corners; ++i) ring.emplace_back(number(), number());
        for (const bool even_odd : {false, true}) {
            const std::vector<FilledBoundary> boundaries = united_paths({{even_odd, {ring}}});
            for (int sample = 0; sample < 200; ++sample) {
                const Complex z(number() + 1e-4, number() + 1e-4);
                const auto windings = [&](const std::vector<Complex>& polygon) {
                    int count = 0;
                    for (std::size_t i = 0; i < polygon.size(); ++i) {
                        const Complex a = polygon[i] - z, b = polygon[(i + 1) % polygon.size()] - z;
                        if ((a.imag() > 0.0) == (b.imag() > 0.0)) continue;
                        if ((cross(a, b) > 0.0) == (b.imag() > a.imag())) count += b.imag() > a.imag() ? 1 : -1;
                    }
                    return count;
                };
                int covered = 0;
                for (const FilledBoundary& boundary : boundaries) covered += windings(boundary.points);
                const int times = windings(ring);
                EXPECT_EQ(covered, even_odd ? std::abs(times) % 2 : times != 0 ? 1 : 0);
            }
        }
    }
}

TEST(FilledPaths, ManyLinesThroughFewPointsAreOneChain)
{
    std::vector<Complex> ring;  // most segments lie on few lines, up to rounding
    for (int i = 0; i < 400; ++i) ring.emplace_back((i * 919 % 1000) / 1000.0, (i * 729 % 1000) / 1000.0);
    const std::vector<FilledBoundary> boundaries = united_paths({{false, {ring}}});
    EXPECT_LT(boundaries.size(), 100U);
    EXPECT_NEAR(area_of(boundaries), 0.6737, 1e-3);
}

TEST(SvgDrawing, OnlyWhatIsShownIsDrawn)
{
    const std::string shown = "<path d='M10 10h10v10h-10z'/>", hidden = "<path d='M30 10h20v20h-20z'/>";
    const auto drawn = [&](const std::string& inside) {
        double area = 0.0;
        for (const SvgPath& path : drawing_of(inside).paths)
            area += area_of(united_paths({{path.even_odd, flattened(path, 1e-3)}}));
        return area;
    };
    const std::string style = "<style>.a,.b{display:none} #c>g path{visibility:hidden} .d{display:inline}</style>";
    for (const std::string& group :
         {"<g class='x b'>" + hidden + "</g>", "<g id='c'><g><g>" + hidden + "</g></g></g>",
          "<g class='d' style='display:none'>" + hidden + "</g>",
          "<g display='none'><g display='inline'>" + hidden + "</g></g>", "<g opacity='0'>" + hidden + "</g>",
          "<g fill='none'>" + hidden + "</g>", "<symbol>" + hidden + "</symbol>",
          "<g requiredExtensions='x'>" + hidden + "</g>",
          "<switch><foreignObject requiredExtensions='x'/><g/><g>" + hidden + "</g></switch>"})
        EXPECT_NEAR(drawn(style + group + shown), 100.0, 1e-9) << group;
    EXPECT_NEAR(drawn(style + "<g class='a d'>" + shown + "</g>"), 100.0, 1e-9) << "the later rule counts";
    EXPECT_NEAR(drawn("<g fill='none' stroke='red'>" + shown + "</g>"), 100.0, 1e-9) << "cutters' files are strokes";
}

TEST(SvgDrawing, ClipPathsAndWhiteMasksCut)
{
    const std::string half =
        "<clipPath id='half' clipPathUnits='objectBoundingBox'><rect width='.5' height='1'/></clipPath>";
    const std::string ring = "<path id='o' d='M0 0H6V6H0Z M2 2H4V4H2Z' clip-rule='evenodd'/>";
    struct Case {
        std::string defined, drawn;
        double area;
    };
    const std::string square = "<rect width='6' height='6' clip-path='url(#c)'/>";
    const auto beside = [](const std::string& how) {
        return "<g clip-path='url(#half)'><rect width='6' height='6'/><rect x='9' width='3' height='1' " + how +
               "/></g>";
    };
    for (const Case& one : std::vector<Case>{
             {"<clipPath id='c'><rect width='4' height='9'/></clipPath>", square, 24.0},
             {"<clipPath id='c' transform='scale(.5)'><rect width='4' height='9'/></clipPath>", square, 9.0},
             {"<clipPath id='c'>" + ring + "</clipPath>", square, 32.0},
             {"<g clip-rule='evenodd'><clipPath id='c'><path d='M0 0H6V6H0Z M2 2H4V4H2Z'/></clipPath></g>", square,
              32.0},
             {"<defs>" + ring + "</defs><clipPath id='c'><use href='#o' x='3'/></clipPath>", square, 16.0},
             {"<clipPath id='c'><path d='M0 0H6V6' fill='none'/></clipPath>", square, 18.0},
             {"<clipPath id='c'><g><rect width='9' height='9'/></g></clipPath>", square + "<path d='M7 0h1v1h-1z'/>",
              1.0},
             {half, "<rect width='6' height='6' style=\"clip-path: url('#half')\"/>", 18.0},
             {half,
              "<g clip-path='url(#half)' transform='scale(2)'><path d='M1 0h2v1h-2z'/><path d='M5 0h2v1h-2z'/></g>",
              8.0},
             {half + "<clipPath id='c' clip-path='url(#half)'><rect width='4' height='6'/></clipPath>", square, 12.0},
             {half + "<clipPath id='c'><rect clip-path='url(#half)' width='4' height='6'/><path d='M5 "
                     "0h1v1h-1z'/></clipPath>",
              square, 13.0},
             {half, "<g clip-path='url(#half)'><g clip-path='url(#half)'><path d='M0 0h8v1h-8z'/></g></g>", 4.0},
             // bounding boxes have what is not painted, but not what is not there (SVG 2, 8.10)
             {half, beside("fill='none'"), 36.0},
             {half, beside("visibility='hidden'"), 36.0},
             {half, beside("opacity='0'"), 36.0},
             {half, beside("display='none'"), 18.0},
             {"", square, 36.0},  // what is not there cuts nothing
             {"<mask id='m'><rect fill='white' width='4' height='4'/></mask>",
              "<rect mask='url(#m)' width='6' height='3'/>", 12.0},
             {"<mask id='m' maskUnits='userSpaceOnUse' width='2' height='9' x='0' y='0' fill='#fff'><circle "
              "r='9'/></mask>",
              "<rect mask='url(#m)' width='6' height='3'/>", 6.0},
             {"", "<svg width='2' height='2'><rect width='6' height='3'/></svg>", 4.0},
             {"", "<svg width='2' height='2' overflow='visible'><rect width='6' height='3'/></svg>", 18.0}}) {
        const SvgDrawing drawing = drawing_of(one.defined + one.drawn);
        EXPECT_NEAR(cut_area(drawing), one.area, 1e-2) << one.defined << one.drawn;
        EXPECT_TRUE(drawing.not_drawn.empty()) << one.defined << one.drawn;
    }
    // what is no clip is told of, and cuts nothing
    for (const char* mask : {"<rect width='4' height='4'/>", "<rect fill='white' opacity='.5' width='4' height='4'/>",
                             "<rect fill='white' width='4' height='4'/><text>a</text>"}) {
        const SvgDrawing drawing =
            drawing_of("<mask id='m'>" + std::string(mask) + "</mask><rect mask='url(#m)' width='6' height='3'/>");
        EXPECT_NEAR(cut_area(drawing), 18.0, 1e-9);
        EXPECT_EQ(drawing.not_drawn, std::vector<std::string>{"mask"});
    }
    EXPECT_THROW(drawing_of("<clipPath id='c'/>" + square), InputError) << "nothing is left";
    EXPECT_THROW(drawing_of("<clipPath id='c' clip-path='url(#c)'><rect/></clipPath>" + square), InputError);
}

TEST(SvgDrawing, UsesAndViewportsAreTransforms)
{
    const auto size_of = [](const std::string& inside) {
        const SvgDrawing drawing = drawing_of(inside);
        return drawing.high - drawing.low;
    };
    const std::string box = "<path id='p' d='M0 0h5v10h-5z'/>";
    const auto symbol = [&](const std::string& ratio) {
        return "<symbol id='s' viewBox='0 0 5 10' preserveAspectRatio='" + ratio + "'>" + box + "</symbol>" +
               "<use href='#s' x='3' width='20' height='20'/>";
    };
    EXPECT_NEAR(std::abs(size_of(symbol("")) - Complex(10.0, 20.0)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(size_of(symbol("none")) - Complex(20.0, 20.0)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(size_of(symbol("xMinYMid slice")) - Complex(20.0, 20.0)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(size_of(symbol("xMinYMid slice' overflow='visible")) - Complex(20.0, 40.0)), 0.0, 1e-9);
    EXPECT_NEAR(
        std::abs(size_of("<defs>" + box + "</defs><use href='#p' transform='scale(2)'/>") - Complex(10.0, 20.0)), 0.0,
        1e-9);
    EXPECT_NEAR(std::abs(size_of(box + "<use href='#p' x='20'/>") - Complex(25.0, 10.0)), 0.0, 1e-9);
    EXPECT_THROW(drawing_of("<g id='a'><use href='#a'/></g>"), InputError);
}

TEST(SvgDrawing, EntitiesStandForTheirText)
{
    const std::string doctype =
        "<!DOCTYPE svg [<!ENTITY ns 'http://www.w3.org/2000/svg'><!ENTITY off 'display:none'>]>";
    const SvgDrawing drawing = parse_svg(doctype + "<svg xmlns='&ns;'><path style='&off;' d='M0 0h9v9z'/>"
                                                   "<path d='M0 0h2v1h-2z'/></svg>");
    EXPECT_EQ(drawing.high - drawing.low, Complex(2.0, 1.0));
    EXPECT_THROW(parse_svg("<!DOCTYPE svg [<!ENTITY a '&a;'>]><svg xmlns='http://www.w3.org/2000/svg' id='&a;'/>"),
                 InputError);
}

TEST(SvgDrawing, AttributesMayComeInAnyOrder)
{
    const SvgDrawing last = drawing_of("<path d='M0 0H2V1H0Z' transform='scale(3)' fill-rule='evenodd'/>");
    EXPECT_EQ(last.high - last.low, Complex(6.0, 3.0));
    EXPECT_TRUE(last.paths.at(0).even_odd);
    EXPECT_THROW(drawing_of("<path d='M0 0H2V1H0Z' display='none'/>"), InputError);
}

TEST(SvgDrawing, CurvesLieWithinTheTolerance)
{
    const SvgDrawing drawing = drawing_of("<circle cx='7' cy='-2' r='5'/>");
    for (const double tolerance : {0.5, 0.01, 1e-4}) {
        const std::vector<Complex> polygon = flattened(drawing.paths.at(0), tolerance).at(0);
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Complex middle = 0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]);
            EXPECT_NEAR(std::abs(middle - Complex(7.0, 2.0)), 5.0, tolerance + 2e-3)
                << "an arc is a Bezier curve to 3e-4";
        }
    }
}
