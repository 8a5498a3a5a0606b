#include "fit/dilatation_bounds.h"

#include "surface/harmonic_map.h"
#include "surface/laplacian.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t partners = 6;     // loops whose product with a loop is taken, where there are many
constexpr int green_poles = 2;          // as far from rims as possible
constexpr int reweightings = 16;        // for the least norm
constexpr double flat_q = 1e-3;         // of the mean |q|: smaller ones count as this in the weights
constexpr double dependent = 1e-9;      // of products: relative
constexpr double nothing_bent = 1e-14;  // of |mu|

struct DomainFaces {
    VectorXd area;          // (F) 0: turned over
    Eigen::MatrixX3cd hat;  // (F, 3) gradients of the corners' hat functions
};

DomainFaces faces_of(const Triangles& triangles, const PlanarPoints& uv)
{
    DomainFaces faces{VectorXd::Zero(triangles.rows()), Eigen::MatrixX3cd::Zero(triangles.rows(), 3)};
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const auto at = [&](int k) { return Complex(uv(triangles(f, k % 3), 0), uv(triangles(f, k % 3), 1)); };
        const double area = 0.5 * (std::conj(at(1) - at(0)) * (at(2) - at(0))).imag();
        if (!(area > 0.0)) continue;
        faces.area[f] = area;
        for (int k = 0; k < 3; ++k) faces.hat(f, k) = Complex(0.0, 0.5) * (at(k + 2) - at(k + 1)) / area;
    }
    return faces;
}

/// (F, columns) 2 du/dz of harmonic functions u with these values on vertices.
Eigen::MatrixXcd forms_of(const Triangles& triangles, const PlanarPoints& uv, const DomainFaces& faces,
                          const std::vector<Index>& held, const MatrixXd& values)
{
    const EdgeLengths lengths = edge_lengths(uv, triangles);
    Eigen::MatrixXcd forms = Eigen::MatrixXcd::Zero(triangles.rows(), values.cols());
    for (Eigen::Index k = 0; k < values.cols(); k += 2) {
        const bool two = k + 1 < values.cols();
        VectorXcd both = values.col(k).cast<Complex>();
        if (two) both += Complex(0.0, 1.0) * values.col(k + 1);
        both = harmonic_map(triangles, lengths, static_cast<Index>(uv.rows()), held, both);
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            for (int corner = 0; corner < 3; ++corner) {
                const Complex value = both[triangles(f, corner)], hat = std::conj(faces.hat(f, corner));
                forms(f, k) += value.real() * hat;
                if (two) forms(f, k + 1) += value.imag() * hat;
            }
    }
    return forms;
}

/// Forms of the holes' harmonic measures, and of Green's functions.
struct DomainForms {
    Eigen::MatrixXcd measures;        // (F, holes)
    std::vector<Index> poles;         // vertices
    std::vector<VectorXcd> of_poles;  // (F) each
};

DomainForms domain_forms(const Triangles& triangles, const PlanarPoints& uv, const std::vector<VertexLoop>& loops,
                         const DomainFaces& faces)
{
    std::vector<Index> rim;
    for (const VertexLoop& loop : loops) rim.insert(rim.end(), loop.begin(), loop.end());
    const auto rim_size = static_cast<Eigen::Index>(rim.size());
    MatrixXd values = MatrixXd::Zero(rim_size, static_cast<Eigen::Index>(loops.size()) - 1);
    auto begin = static_cast<Eigen::Index>(loops[0].size());
    for (std::size_t k = 1; k < loops.size(); ++k) {
        const auto size = static_cast<Eigen::Index>(loops[k].size());
        values.col(static_cast<Eigen::Index>(k) - 1).segment(begin, size).setOnes();
        begin += size;
    }
    DomainForms forms{forms_of(triangles, uv, faces, rim, values), {}, {}};
    if (loops.size() < 4) return forms;
    VectorXd room = VectorXd::Constant(uv.rows(), std::numeric_limits<double>::infinity());
    const auto keep_off = [&](Index v) { room = room.cwiseMin((uv.rowwise() - uv.row(v)).rowwise().norm()); };
    for (const Index v : rim) keep_off(v);
    rim.push_back(-1);
    VectorXd one = VectorXd::Zero(rim_size + 1);
    one[rim_size] = 1.0;
    for (int i = 0; i < green_poles; ++i) {
        Eigen::Index pole = 0;
        if (!(room.maxCoeff(&pole) > 0.0)) break;
        rim.back() = static_cast<Index>(pole);
        keep_off(rim.back());
        forms.poles.push_back(rim.back());
        forms.of_poles.push_back(forms_of(triangles, uv, faces, rim, one).col(0));
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
    const Eigen::MatrixXcd& forms = all.measures;
    const Eigen::Index holes = forms.cols();
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (Eigen::Index i = 0; i < holes; ++i) {
        std::vector<std::pair<double, Eigen::Index>> others;
        for (Eigen::Index j = 0; j < holes; ++j)
            if (j != i) others.emplace_back(-area.dot(forms.col(i).cwiseProduct(forms.col(j)).cwiseAbs()), j);
        std::ranges::sort(others);
        if (holes > 10) others.resize(std::min(others.size(), partners));
        pairs.emplace_back(i, i);
        for (const auto& [overlap, j] : others) pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const auto of_a_pole = all.poles.empty() ? 0 : holes - 2;
    const auto squares = static_cast<Eigen::Index>(pairs.size());
    Eigen::MatrixXcd products(forms.rows(), squares + of_a_pole * static_cast<Eigen::Index>(all.poles.size()));
    for (Eigen::Index k = 0; k < squares; ++k) {
        const auto [i, j] = pairs[static_cast<std::size_t>(k)];
        products.col(k) = forms.col(i).cwiseProduct(forms.col(j));
    }
    for (std::size_t i = 0; i < all.poles.size(); ++i)
        products.middleCols(squares + of_a_pole * static_cast<Eigen::Index>(i), of_a_pole) =
            all.of_poles[i].asDiagonal() * (forms * vanishing_at(all.poles[i], triangles, area, forms));
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
                                   const std::vector<VertexLoop>& loops, const VectorXcd& mu)
{
    DomainFaces faces = faces_of(triangles, uv);
    for (Eigen::Index f = 0; f < mu.size(); ++f)
        if (!(std::abs(mu[f]) < 1.0)) faces.area[f] = 0.0;
    DilatationBounds bounds;
    if (loops.size() < 2 || !((faces.area.array() > 0.0).select(mu.cwiseAbs(), 0.0).maxCoeff() > nothing_bent))
        return bounds;
    const DomainForms forms = domain_forms(triangles, uv, loops, faces);
    const Eigen::MatrixXcd products = quadratic_differentials(forms, triangles, faces.area);
    if (!products.allFinite()) return bounds;
    VectorXd pairing(products.cols());
    for (Eigen::Index k = 0; k < products.cols(); ++k) {
        double sum = 0.0;
        for (Eigen::Index f = 0; f < mu.size(); ++f)
            if (faces.area[f] > 0.0) sum += faces.area[f] * (mu[f] * products(f, k)).real() / (1.0 - std::norm(mu[f]));
        pairing[k] = sum;
    }
    VectorXd size = forms.measures.cwiseAbs2().rowwise().sum();
    for (int i = 0; i < reweightings; ++i) {
        const double mean = faces.area.dot(size) / faces.area.sum();
        const VectorXd root = (faces.area.array() / (size.array().square() + std::pow(flat_q * mean, 2)).sqrt()).sqrt();
        MatrixXd rows(2 * products.rows(), products.cols());
        rows << root.asDiagonal() * products.real(), root.asDiagonal() * products.imag();
        Eigen::CompleteOrthogonalDecomposition<MatrixXd> gram;
        gram.setThreshold(dependent);
        gram.compute(rows.transpose() * rows);
        const VectorXcd q = products * gram.solve(pairing).cast<Complex>();
        size = q.cwiseAbs();
        if (!(faces.area.dot(size) > 0.0) || !size.allFinite()) break;
        const double least = 1.0 / reich_strebel(faces.area, mu, q, -1.0);
        if (i > 0 && !(least > bounds.lower)) continue;
        bounds = {std::max(least, 1.0), std::max(reich_strebel(faces.area, mu, q, 1.0), 1.0)};
    }
    return bounds;
}

}  // namespace koebe
