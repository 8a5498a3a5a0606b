#include "fit/marked_forms.h"

#include "fit/plane_beltrami.h"
#include "mesh/loop_with.h"
#include "surface/harmonic_solver.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

/// A function and its derivative.
struct Jet {
    Complex value, slope;
};

/// The conformal map of one side of a circle to the unit disk, a point of it to 0.
struct ToDisk {
    Circle circle;
    bool outside = false;  // of the circle
    Complex pole;

    Jet operator()(Complex z) const
    {
        const Jet w = unit(z);
        const Complex p = unit(pole).value, below = 1.0 - std::conj(p) * w.value;
        return {(w.value - p) / below, (1.0 - std::norm(p)) / (below * below) * w.slope};
    }

private:
    Jet unit(Complex z) const
    {
        const Complex arm = (z - circle.center) / circle.radius;
        return outside ? Jet{1.0 / arm, -1.0 / (arm * arm * circle.radius)} : Jet{arm, 1.0 / circle.radius};
    }
};

/// u = log |f| of the disk map f, with its pole at the map's 0; or u = arg(f - f(mark)) - arg(f) / 2, which is constant
/// on the circle on both sides of the mark and has a pole at the map's 0, too.
struct Singular {
    ToDisk map;
    bool on_rim = false;
    Complex mark;  // on the unit circle, of f

    Complex form(Complex z) const
    {
        const Jet f = map(z);
        if (!on_rim) return f.slope / f.value;
        return Complex(0.0, -1.0) * f.slope * (1.0 / (f.value - mark) - 0.5 / f.value);
    }

    /// The rise of u along a short way.
    double rise(Complex from, Complex to) const
    {
        const Complex f = map(from).value, g = map(to).value;
        if (!on_rim) return std::log(std::abs(g / f));
        return std::arg((g - mark) / (f - mark)) - 0.5 * std::arg(g / f);
    }
};

/// A form that is to be made: a sum of parts with poles. Each is imaginary along one rim, its own.
struct Wanted {
    struct Part {
        Singular function;
        std::size_t own;  // loop
        double sign;
    };
    std::vector<Part> parts;
    std::array<Index, 2> poles;
};

std::vector<Wanted> wanted_forms(const PlanarPoints& uv, const std::vector<Circle>& circles,
                                 const std::vector<VertexLoop>& loops, const std::vector<Index>& marks, Index middle)
{
    const auto place = [&](Index v) { return complex_at(uv, v); };
    std::vector<Wanted> wanted;
    std::vector<std::tuple<std::size_t, double, Index>> rim;  // loop, angle, vertex
    for (const Index v : marks) {
        const int found = loop_with(loops, v);
        const auto k = static_cast<std::size_t>(std::max(found, 0));
        if (found < 0)
            wanted.push_back({{{{{{}, false, place(v)}, false, {}}, 0, 1.0}}, {v, v}});
        else
            rim.emplace_back(k, std::arg(place(v) - circles[k].center), v);
    }
    std::ranges::sort(rim);
    const Index pole = wanted.empty() ? middle : wanted.front().poles[0];
    const auto part = [&](const auto& mark, double sign) {
        const auto& [k, angle, v] = mark;
        const ToDisk map{circles[k], k > 0, place(pole)};
        const Complex there = map(place(v)).value;
        return Wanted::Part{{map, true, there / std::abs(there)}, k, sign};
    };
    if (!wanted.empty() && !rim.empty()) wanted.push_back({{part(rim[0], 1.0)}, {std::get<Index>(rim[0]), pole}});
    for (std::size_t i = 0; rim.size() > 1 && i < (rim.size() > 2 ? rim.size() : 1); ++i) {
        const auto &here = rim[i], &next = rim[(i + 1) % rim.size()];
        wanted.push_back({{part(here, 1.0), part(next, -1.0)}, {std::get<Index>(here), std::get<Index>(next)}});
    }
    return wanted;
}

/// Minus a function on the rims that are not its own, up to a constant on each.
void take_off(const Wanted::Part& part, const PlanarPoints& uv, const std::vector<VertexLoop>& loops,
              const std::vector<Eigen::Index>& first_row, Eigen::Ref<VectorXd> values)
{
    for (std::size_t k = 0; k < loops.size(); ++k) {
        if (k == part.own) continue;
        double sum = 0.0;
        for (std::size_t i = 1; i < loops[k].size(); ++i) {
            sum += part.function.rise(complex_at(uv, loops[k][i - 1]), complex_at(uv, loops[k][i]));
            values[first_row[k] + static_cast<Eigen::Index>(i)] -= part.sign * sum;
        }
    }
}

}  // namespace

Eigen::MatrixXcd forms_of(const Triangles& triangles, const PlanarPoints& uv, const VectorXd& area, const MatrixXd& u)
{
    Eigen::MatrixXcd forms = Eigen::MatrixXcd::Zero(triangles.rows(), u.cols());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        if (!(area[f] > 0.0)) continue;
        const Complex p = face_edge(uv, triangles, f, 1), q = face_edge(uv, triangles, f, 2);
        const auto rise = [&](int corner) { return u.row(triangles(f, corner)) - u.row(triangles(f, 0)); };
        forms.row(f) = Complex(0.0, 0.5) / area[f] * (std::conj(q) * rise(1) - std::conj(p) * rise(2));
    }
    return forms;
}

MarkedForms marked_forms(const Triangles& triangles, const PlanarPoints& uv, const std::vector<Circle>& circles,
                         const std::vector<VertexLoop>& loops, const std::vector<Index>& marks, Index middle,
                         const VectorXd& area)
{
    const std::vector<Wanted> wanted = wanted_forms(uv, circles, loops, marks, middle);
    MarkedForms result;
    // Boundary values of the wanted functions, with a minus sign: harmonic functions take them off inside.
    std::vector<Index> rim;
    std::vector<Eigen::Index> first_row;
    for (const VertexLoop& loop : loops) {
        first_row.push_back(static_cast<Eigen::Index>(rim.size()));
        rim.insert(rim.end(), loop.begin(), loop.end());
    }
    MatrixXd values = MatrixXd::Zero(static_cast<Eigen::Index>(rim.size()), static_cast<Eigen::Index>(wanted.size()));
    for (std::size_t i = 0; i < wanted.size(); ++i)
        for (const Wanted::Part& part : wanted[i].parts)
            take_off(part, uv, loops, first_row, values.col(static_cast<Eigen::Index>(i)));
    MatrixXd given = MatrixXd::Zero(uv.rows(), values.cols());
    given(rim, Eigen::all) = values;
    result.forms = Eigen::MatrixXcd::Zero(triangles.rows(), values.cols());
    if (loops.size() > 1) {
        const EdgeLengths lengths = edge_lengths(uv, triangles);
        const DirichletSolver solver = harmonic_solver(triangles, lengths, static_cast<Index>(uv.rows()), rim);
        result.forms = forms_of(triangles, uv, area, solver.solve(given));
    }
    // Add the functions themselves, at the faces' centroids.
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        result.poles.push_back(wanted[i].poles);
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            if (!(area[f] > 0.0)) continue;
            const Complex centroid =
                (complex_at(uv, triangles(f, 0)) + complex_at(uv, triangles(f, 1)) + complex_at(uv, triangles(f, 2))) /
                3.0;
            for (const Wanted::Part& part : wanted[i].parts)
                result.forms(f, static_cast<Eigen::Index>(i)) += part.sign * part.function.form(centroid);
        }
    }
    return result;
}

}  // namespace koebe
