#include "report/pattern_dxf.h"

#include "files/text_writer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace koebe {
namespace {

constexpr double between_sheets = 20.0;  // mm

struct Layer {
    const char* name;
    int color;  // of AutoCAD's index
};
constexpr std::array layers = {Layer{"CUT", 7}, Layer{"SEAM", 8}, Layer{"MARK", 1}, Layer{"TEXT", 3}, Layer{"PAGE", 9}};
constexpr const char *text_layer = "TEXT", *page_layer = "PAGE";

/// Pairs of a group's code and its value, a line each.
class DxfText {
public:
    void add(int code, const std::string& value) { text_ += std::to_string(code) + "\n" + value + "\n"; }
    void add(int code, int value) { add(code, std::to_string(value)); }
    void add(int code, double value)
    {
        char text[32];
        add(code, std::string(text, io::write_number(text, value + 0.0)));
    }
    /// @param code of x; y and z have the codes 10 and 20 larger
    void add_point(int code, double x, double y)
    {
        add(code, x);
        add(code + 10, y);
        add(code + 20, 0.0);
    }
    void begin_section(const char* name)
    {
        add(0, "SECTION");
        add(2, name);
    }
    void add_polyline(const std::string& layer, const PlanarPoints& points, bool closed)
    {
        add(0, "POLYLINE");
        add(8, layer);
        add(66, 1);
        add_point(10, 0.0, 0.0);
        add(70, closed ? 1 : 0);
        for (const auto& point : points.rowwise()) {
            add(0, "VERTEX");
            add(8, layer);
            add_point(10, point[0], point[1]);
        }
        add(0, "SEQEND");
        add(8, layer);
    }
    void add_label(const PatternLabel& label, double shift)
    {
        add(0, "TEXT");
        add(8, text_layer);
        add_point(10, label.at[0] + shift, label.at[1]);
        add(40, label.height);
        add(1, label.text);
        add(50, label.angle_deg);
        add(72, 1);  // the middle of the text
        add_point(11, label.at[0] + shift, label.at[1]);
        add(73, 2);
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

PlanarPoints shifted(PlanarPoints points, double shift)
{
    points.col(0).array() += shift;
    return points;
}

PlanarPoints box(double left, double low, double width, double height)
{
    PlanarPoints corners(4, 2);
    corners << left, low, left + width, low, left + width, low + height, left, low + height;
    return corners;
}

void add_tables(DxfText& dxf)
{
    dxf.begin_section("TABLES");
    // One line type: solid. Group code 72 is 65 ('A') by definition, 73 and 40 say that it has no dashes.
    dxf.add(0, "TABLE");
    dxf.add(2, "LTYPE");
    dxf.add(70, 1);
    dxf.add(0, "LTYPE");
    dxf.add(2, "CONTINUOUS");
    dxf.add(70, 0);
    dxf.add(3, "Solid line");
    dxf.add(72, 65);
    dxf.add(73, 0);
    dxf.add(40, 0.0);
    dxf.add(0, "ENDTAB");
    // The layers: name, flags, colour, line type.
    dxf.add(0, "TABLE");
    dxf.add(2, "LAYER");
    dxf.add(70, static_cast<int>(layers.size()));
    for (const Layer& layer : layers) {
        dxf.add(0, "LAYER");
        dxf.add(2, layer.name);
        dxf.add(70, 0);
        dxf.add(62, layer.color);
        dxf.add(6, "CONTINUOUS");
    }
    dxf.add(0, "ENDTAB");
    dxf.add(0, "ENDSEC");
}

}  // namespace

std::string pattern_dxf(const Pattern& pattern)
{
    double width = -between_sheets, height = 0.0;
    for (const PatternSheet& sheet : pattern.sheets) {
        width += sheet.width + between_sheets;
        height = std::max(height, sheet.height);
    }
    DxfText dxf;
    dxf.begin_section("HEADER");
    dxf.add(9, "$ACADVER");
    dxf.add(1, "AC1009");
    dxf.add(9, "$INSUNITS");  // of later versions, for readers that ask
    dxf.add(70, 4);           // millimetres
    dxf.add(9, "$EXTMIN");
    dxf.add_point(10, 0.0, 0.0);
    dxf.add(9, "$EXTMAX");
    dxf.add_point(10, width, height);
    dxf.add(0, "ENDSEC");
    add_tables(dxf);
    dxf.begin_section("ENTITIES");
    double shift = 0.0;
    for (const PatternSheet& sheet : pattern.sheets) {
        if (pattern.page.any()) {
            const double w = sheet.width / sheet.columns, h = sheet.height / sheet.rows;
            for (int row = 0; row < sheet.rows; ++row)
                for (int column = 0; column < sheet.columns; ++column)
                    dxf.add_polyline(page_layer, box(shift + column * w, row * h, w, h), true);
        }
        for (const PatternLine& line : sheet.lines)
            dxf.add_polyline(layers[static_cast<std::size_t>(line.kind)].name, shifted(line.points, shift),
                             line.closed);
        for (const PatternLabel& label : sheet.labels) dxf.add_label(label, shift);
        shift += sheet.width + between_sheets;
    }
    dxf.add(0, "ENDSEC");
    dxf.add(0, "EOF");
    return dxf.take();
}

}  // namespace koebe
