#include "fit/dilatation_bounds.h"

#include "circles/circle.h"
#include "core/sort_unique.h"
#include "core/types.h"
#include "fit/plane_beltrami.h"
#include "mesh/loop_with.h"
#include "surface/harmonic_solver.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// Each form is imaginary along all rims.
struct MarkedForms {
    Eigen::MatrixXcd forms;                   ///< (F, forms)
    std::vector<std::array<Index, 2>> poles;  ///< vertices of each form's simple poles; twice the same: one pole
};

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

/// (F, C) 2 du/dz of functions u (V, C) that are linear in each face; 0 in faces without area.
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

/// For each mark inside the form of Green's function. For marks on rims, in the order of rims and angles, forms with
/// poles at two neighbours. If there are marks of both kinds, also a form with a pole at one of each. The parts with
/// poles are exact at the faces' centroids: those of the disk inside the outer circle, or outside a hole's circle. To
/// them are added harmonic functions that make them imaginary along the other rims, too.
/// @param middle a vertex far from rims @param area (F) 0 for faces to leave out @throws SolverError
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

constexpr std::size_t partners = 6;     // loops whose product with a loop is taken, where there are many
constexpr int green_poles = 2;          // as far from rims as possible
constexpr int reweightings = 16;        // for the least norm
constexpr double flat_q = 1e-3;         // of the mean |q|: smaller ones count as this in the weights
constexpr double dependent = 1e-9;      // of products: relative
constexpr double nothing_bent = 1e-14;  // of |mu|

/// (F) areas, 0 for faces that are turned over here or by mu.
VectorXd upright_areas(const Triangles& triangles, const PlanarPoints& uv, const VectorXcd& mu)
{
    VectorXd area = VectorXd::Zero(mu.size());
    for (Eigen::Index f = 0; f < area.size(); ++f) {
        const Complex p = face_edge(uv, triangles, f, 1), q = face_edge(uv, triangles, f, 2);
        if (std::abs(mu[f]) < 1.0) area[f] = std::max(0.5 * (std::conj(p) * q).imag(), 0.0);
    }
    return area;
}

/// Vertices as far as possible from rims and from each other.
std::vector<Index> pole_vertices(const PlanarPoints& uv, const std::vector<Index>& rim)
{
    std::vector<Index> poles;
    VectorXd room = VectorXd::Constant(uv.rows(), std::numeric_limits<double>::infinity());
    const auto keep_off = [&](Index v) { room = room.cwiseMin((uv.rowwise() - uv.row(v)).rowwise().norm()); };
    for (const Index v : rim) keep_off(v);
    for (int i = 0; i < green_poles; ++i) {
        Eigen::Index pole = 0;
        if (!(room.maxCoeff(&pole) > 0.0)) break;
        poles.push_back(static_cast<Index>(pole));
        keep_off(poles.back());
    }
    return poles;
}

/// Forms of the holes' harmonic measures, of marks, and of Green's functions.
struct DomainForms {
    Eigen::MatrixXcd measures;  // (F, holes)
    MarkedForms marked;
    std::vector<Index> poles;   // vertices
    Eigen::MatrixXcd of_poles;  // (F, poles)
};

DomainForms domain_forms(const Triangles& triangles, const PlanarPoints& uv, const std::vector<Circle>& circles,
                         const std::vector<VertexLoop>& loops, const std::vector<Index>& marks, const VectorXd& area)
{
    std::vector<Index> rim;
    for (const VertexLoop& loop : loops) rim.insert(rim.end(), loop.begin(), loop.end());
    const EdgeLengths lengths = edge_lengths(uv, triangles);
    // The forms of harmonic functions with given values at held vertices.
    const auto forms_with = [&](const std::vector<Index>& held, const MatrixXd& values) {
        const DirichletSolver solver = harmonic_solver(triangles, lengths, static_cast<Index>(uv.rows()), held);
        return forms_of(triangles, uv, area, solver.solve(values));
    };
    // One for each hole: 1 on its rim, 0 on the others.
    MatrixXd values = MatrixXd::Zero(uv.rows(), static_cast<Eigen::Index>(loops.size()) - 1);
    for (std::size_t k = 1; k < loops.size(); ++k) values(loops[k], static_cast<Eigen::Index>(k) - 1).setOnes();
    DomainForms forms{forms_with(rim, values), {}, {}, {}};
    // Forms with poles at the landmarks.
    if (!marks.empty()) {
        const std::vector<Index> middle = pole_vertices(uv, rim);
        forms.marked = marked_forms(triangles, uv, circles, loops, marks, middle.empty() ? 0 : middle.front(), area);
    }
    // One for each of some vertices inside: 1 there, 0 on all rims.
    if (loops.size() > 3) forms.poles = pole_vertices(uv, rim);
    forms.of_poles.resize(triangles.rows(), static_cast<Eigen::Index>(forms.poles.size()));
    rim.push_back(-1);
    for (std::size_t i = 0; i < forms.poles.size(); ++i) {
        rim.back() = forms.poles[i];
        forms.of_poles.col(static_cast<Eigen::Index>(i)) = forms_with(rim, VectorXd::Unit(uv.rows(), forms.poles[i]));
    }
    return forms;
}

/// Sums of the forms that vanish at a vertex, as columns of coefficients.
MatrixXd vanishing_at(Index vertex, const Triangles& triangles, const VectorXd& area, const Eigen::MatrixXcd& forms)
{
    VectorXcd there = VectorXcd::Zero(forms.cols());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if ((triangles.row(f).array() == vertex).any()) there += area[f] * forms.row(f).transpose();
    MatrixXd parts(there.size(), 2);
    parts << there.real(), there.imag();
    const MatrixXd turn = Eigen::HouseholderQR<MatrixXd>(parts).householderQ();
    return turn.rightCols(there.size() - 2);
}

/// Products of forms, each with the norm 1. Of many measures only those with the measures that overlap most.
Eigen::MatrixXcd quadratic_differentials(const DomainForms& all, const Triangles& triangles, const VectorXd& area)
{
    const Eigen::Index holes = all.measures.cols(), count = holes + all.marked.forms.cols();
    Eigen::MatrixXcd forms(all.measures.rows(), count);
    forms << all.measures, all.marked.forms;
    const auto share_a_pole = [&](Eigen::Index i, Eigen::Index j) {
        if (i < holes || j < holes) return false;
        const auto& here = all.marked.poles[static_cast<std::size_t>(i - holes)];
        return std::ranges::any_of(all.marked.poles[static_cast<std::size_t>(j - holes)],
                                   [&](Index v) { return std::ranges::find(here, v) != here.end(); });
    };
    // For each form the partners that overlap most. Two forms with one pole would have a double pole.
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (Eigen::Index i = 0; i < count; ++i) {
        std::vector<std::pair<double, Eigen::Index>> others;
        for (Eigen::Index j = 0; j < count; ++j)
            if (j != i && !share_a_pole(i, j))
                others.emplace_back(-area.dot(forms.col(i).cwiseProduct(forms.col(j)).cwiseAbs()), j);
        std::ranges::sort(others);
        if (count > 10) others.resize(std::min(others.size(), partners));
        if (i < holes) pairs.emplace_back(i, i);
        for (const auto& [overlap, j] : others) pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
    sort_unique(pairs);
    // q = f g, and forms with a pole times measures that vanish there; all have the norm 1.
    const auto of_a_pole = all.poles.empty() ? 0 : holes - 2;
    const auto squares = static_cast<Eigen::Index>(pairs.size());
    Eigen::MatrixXcd products(forms.rows(), squares + of_a_pole * static_cast<Eigen::Index>(all.poles.size()));
    for (Eigen::Index k = 0; k < squares; ++k) {
        const auto [i, j] = pairs[static_cast<std::size_t>(k)];
        products.col(k) = forms.col(i).cwiseProduct(forms.col(j));
    }
    for (std::size_t i = 0; i < all.poles.size(); ++i)
        products.middleCols(squares + of_a_pole * static_cast<Eigen::Index>(i), of_a_pole) =
            all.of_poles.col(static_cast<Eigen::Index>(i)).asDiagonal() *
            (all.measures * vanishing_at(all.poles[i], triangles, area, all.measures));
    for (Eigen::Index k = 0; k < products.cols(); ++k) products.col(k) /= area.dot(products.col(k).cwiseAbs());
    return products;
}

/// I(q) for the sign 1, I(-q) for -1.
double reich_strebel(const VectorXd& area, const VectorXcd& mu, const VectorXcd& q, double sign)
{
    double sum = 0.0, norm = 0.0;
    for (Eigen::Index f = 0; f < area.size(); ++f) {
        if (!(area[f] > 0.0)) continue;
        const double square = std::norm(mu[f]), size = std::abs(q[f]);
        sum += area[f] * ((1.0 + square) * size + 2.0 * sign * (mu[f] * q[f]).real()) / (1.0 - square);
        norm += area[f] * size;
    }
    return sum / norm;
}

}  // namespace

DilatationBounds dilatation_bounds(const Triangles& triangles, const PlanarPoints& uv,
                                   const std::vector<Circle>& circles, const std::vector<VertexLoop>& loops,
                                   const std::vector<Index>& marks, const VectorXcd& mu)
{
    const VectorXd area = upright_areas(triangles, uv, mu);
    DilatationBounds bounds;
    if (!((area.array() > 0.0).select(mu.cwiseAbs(), 0.0).maxCoeff() > nothing_bent)) return bounds;
    const DomainForms forms = domain_forms(triangles, uv, circles, loops, marks, area);
    const Eigen::MatrixXcd products = quadratic_differentials(forms, triangles, area);
    if (products.cols() == 0 || !products.allFinite()) return bounds;
    // Re of the integral of mu q / (1 - |mu|^2), for each product q.
    VectorXd pairing(products.cols());
    for (Eigen::Index k = 0; k < products.cols(); ++k) {
        double sum = 0.0;
        for (Eigen::Index f = 0; f < mu.size(); ++f)
            if (area[f] > 0.0) sum += area[f] * (mu[f] * products(f, k)).real() / (1.0 - std::norm(mu[f]));
        pairing[k] = sum;
    }
    VectorXd size = marks.empty() ? VectorXd(forms.measures.cwiseAbs2().rowwise().sum())
                                  : VectorXd(products.cwiseAbs().rowwise().sum());
    // Maximize it over the norm of q: least squares with weights 1 / |q|, again and again.
    for (int i = 0; i < reweightings; ++i) {
        const double mean = area.dot(size) / area.sum();
        const VectorXd root = (area.array() / (size.array().square() + std::pow(flat_q * mean, 2)).sqrt()).sqrt();
        MatrixXd rows(2 * products.rows(), products.cols());
        rows << root.asDiagonal() * products.real(), root.asDiagonal() * products.imag();
        Eigen::CompleteOrthogonalDecomposition<MatrixXd> gram;
        gram.setThreshold(dependent);
        gram.compute(rows.transpose() * rows);
        const VectorXcd q = products * gram.solve(pairing).cast<Complex>();
        size = q.cwiseAbs();
        if (!(area.dot(size) > 0.0) || !size.allFinite()) break;
        const double least = 1.0 / reich_strebel(area, mu, q, -1.0);
        if (i > 0 && !(least > bounds.lower)) continue;
        bounds = {std::max(least, 1.0), std::max(reich_strebel(area, mu, q, 1.0), 1.0), q};
    }
    return bounds;
}

}  // namespace koebe
