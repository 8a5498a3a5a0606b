#include "surface/one_form.h"

#include "core/connectivity.h"

namespace koebe {

OneForm exterior_derivative(const Triangles& triangles, const VectorXd& f)
{
    OneForm form(triangles.size());
    for (Index h = 0; h < static_cast<Index>(form.size()); ++h)
        form[h] = f[target(triangles, h)] - f[origin(triangles, h)];
    return form;
}

OneForm exterior_derivative_of_corners(const VectorXd& f)
{
    OneForm form(f.size());
    for (Index h = 0; h < static_cast<Index>(form.size()); ++h) form[h] = f[next_halfedge(h)] - f[h];
    return form;
}

VectorXd circulation(const OneForm& form)
{
    return Eigen::Map<const EdgeLengths>(form.data(), form.size() / 3, 3).rowwise().sum();
}

VectorXd divergence(const Triangles& triangles, const EdgeLengths& half_cotangents, const OneForm& form,
                    Index vertex_count)
{
    VectorXd result = VectorXd::Zero(vertex_count);
    for (Index h = 0; h < static_cast<Index>(form.size()); ++h) {
        const double flow = half_cotangents.data()[h] * form[h];
        result[origin(triangles, h)] += flow;
        result[target(triangles, h)] -= flow;
    }
    return result;
}

double squared_norm(const EdgeLengths& half_cotangents, const OneForm& form)
{
    return (Eigen::Map<const VectorXd>(half_cotangents.data(), half_cotangents.size()).array() * form.array().square())
        .sum();
}

double wedge_integral(const OneForm& a, const OneForm& b)
{
    double sum = 0.0;
    // Both forms are constant covectors on a face: take half their determinant on two edges that leave one corner.
    for (Eigen::Index h = 0; h < a.size(); h += 3) sum += 0.5 * (a[h + 2] * b[h] - a[h] * b[h + 2]);
    return sum;
}

}  // namespace koebe
