#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "iteration/disk_patch.h"
#include "iteration/koebe_mesh.h"
#include "pipeline/uniformize.h"
#include "surface/harmonic_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;
using namespace koebe::test;

namespace {

KoebeMeshResult run(const CircleDomain& domain, Lift kind, const UniformizeOptions& options = {},
                    const KoebeMeshOptions& mesh_options = {})
{
    ExecutionContext context;
    const Surface surface = analyze_surface(domain.triangles, static_cast<Index>(domain.points.size()));
    return koebe_mesh(lift(domain.points, kind), surface, domain.loops, options, context, mesh_options);
}

std::vector<Circle> mapped_circles(const KoebeMeshResult& result)
{
    std::vector<Circle> circles;
    for (const VectorXcd& loop : result.outcome.loops) circles.push_back(fit_circle_least_squares(loop));
    return circles;
}

double error_of(const CircleDomain& domain, const KoebeMeshResult& result)
{
    return inversive_distance_error(mapped_circles(result), domain.circles);
}

std::vector<Circle> six_circles()
{
    auto circles = five_circles();
    circles.push_back({{0.05, 0.62}, 0.1});
    return circles;
}

/// Steps until every later change is below the bound.
int steps_to(const KoebeMeshResult& result, double roundness_excess)
{
    const auto& history = result.outcome.history;
    const double limit = history.back().mean_roundness.all.paper;
    int steps = static_cast<int>(history.size());
    while (steps > 1 && std::abs(history[steps - 2].mean_roundness.all.paper - limit) < roundness_excess * limit)
        --steps;
    return steps;
}

}  // namespace

class KoebeMeshMethod : public testing::TestWithParam<Method> {};

TEST_P(KoebeMeshMethod, slow_finds_the_circles_of_a_lifted_circle_domain)
{
    UniformizeOptions options;
    options.method = GetParam();
    // That all methods agree on the other lifts, slow_all_methods_find_the_same_circles shows.
    for (const Lift kind : {Lift::plane, Lift::enneper}) {
        double first = 0.0, last = 0.0;
        for (const Index faces : {1000, 6000}) {
            const CircleDomain domain = make_circle_domain(five_circles(), faces);
            const KoebeMeshResult result = run(domain, kind, options);
            EXPECT_TRUE(result.outcome.converged) << to_string(kind);
            last = error_of(domain, result);
            if (first == 0.0) first = last;
        }
        EXPECT_LT(first, 2e-3) << to_string(kind);
        EXPECT_LT(last, 5e-4) << to_string(kind);
    }
}

TEST_P(KoebeMeshMethod, the_outer_loop_is_on_the_unit_circle_and_the_others_are_nearly_round)
{
    UniformizeOptions options;
    options.method = GetParam();
    const CircleDomain domain = make_circle_domain(six_circles(), 4000);
    const KoebeMeshResult result = run(domain, Lift::polynomial, options);
    for (const Complex z : result.outcome.loops[0]) EXPECT_NEAR(std::abs(z), 1.0, 1e-14);
    for (std::size_t k = 1; k < domain.loops.size(); ++k) {
        EXPECT_LT(deviation_from(mapped_circles(result)[k], result.outcome.loops[k]), 2e-3);
        EXPECT_EQ(result.outcome.loops[k], gather_loop(result.positions, domain.loops[k]));
    }
    for (Eigen::Index f = 0; f < domain.triangles.rows(); ++f) {
        const Complex a = result.positions[domain.triangles(f, 0)];
        EXPECT_GT(std::imag(std::conj(result.positions[domain.triangles(f, 1)] - a) *
                            (result.positions[domain.triangles(f, 2)] - a)),
                  0.0);
    }
}

TEST_P(KoebeMeshMethod, a_circle_domain_is_a_fixed_point)
{
    // Loops 1 to n keep their circles up to the automorphism that the normalization of loop 0 leaves.
    UniformizeOptions options;
    options.method = GetParam();
    const CircleDomain domain = make_circle_domain(six_circles(), 8000);
    const KoebeMeshResult result = run(domain, Lift::plane, options);
    const std::vector<Circle> found = mapped_circles(result);
    const Moebius to_first = center_circle(domain.circles[1]), found_to_first = center_circle(found[1]);
    const Complex turn = to_first(domain.circles[2]).center / found_to_first(found[2]).center;
    const VectorXcd expected = to_first(domain.points);
    const VectorXcd moved = turn / std::abs(turn) * found_to_first(result.positions);
    EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 2e-3);
}

TEST_P(KoebeMeshMethod, changes_decay_geometrically_in_sweeps)
{
    UniformizeOptions options;
    options.method = GetParam();
    options.tolerance = 1e-11;
    const CircleDomain domain = make_circle_domain(six_circles(), 2000);
    const KoebeMeshResult result = run(domain, Lift::polynomial, options);
    EXPECT_TRUE(result.outcome.converged);
    EXPECT_LE(result.outcome.sweeps, 8);
}

TEST_P(KoebeMeshMethod, reruns_are_bit_identical_and_units_do_not_matter)
{
    UniformizeOptions options;
    options.method = GetParam();
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const KoebeMeshResult result = run(domain, Lift::enneper, options);
    EXPECT_EQ(run(domain, Lift::enneper, options).positions, result.positions);
    const Surface surface = analyze_surface(domain.triangles, static_cast<Index>(domain.points.size()));
    for (const double scale : {1e-8, 1e8}) {
        ExecutionContext context;
        const Vertices scaled = scale * lift(domain.points, Lift::enneper);
        const KoebeMeshResult again = koebe_mesh(scaled, surface, domain.loops, options, context);
        EXPECT_LT((again.positions - result.positions).cwiseAbs().maxCoeff(), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, KoebeMeshMethod, testing::Values(Method::gk, Method::ck, Method::against_outer),
                         [](const auto& method) {
                             return method.param == Method::gk ? "gk" : method.param == Method::ck ? "ck" : "outer";
                         });

TEST(KoebeMesh, slow_all_methods_find_the_same_circles_and_gk_in_the_fewest_steps)
{
    const CircleDomain domain = make_circle_domain(six_circles(), 3000);
    for (const Lift kind : curved_lifts) {
        const KoebeMeshResult gk = run(domain, kind);
        for (const Method method : {Method::ck, Method::against_outer}) {
            UniformizeOptions options;
            options.method = method;
            const KoebeMeshResult other = run(domain, kind, options);
            EXPECT_LT(inversive_distance_error(mapped_circles(gk), mapped_circles(other)), 1e-3) << to_string(kind);
            EXPECT_LT(gk.outcome.steps, other.outcome.steps);
            EXPECT_LT(steps_to(gk, 1e-3), steps_to(other, 1e-3)) << to_string(kind);
            EXPECT_LT(steps_to(gk, 1e-5), steps_to(other, 1e-5)) << to_string(kind);
        }
    }
}

TEST(KoebeMesh, the_history_names_the_open_loops)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 600);
    UniformizeOptions options;
    options.max_sweeps = 2;
    options.tolerance = 0.0;
    const auto gk = run(domain, Lift::sphere, options).outcome;
    EXPECT_FALSE(gk.converged);
    EXPECT_EQ(gk.sweeps, 2);
    EXPECT_EQ(gk.steps, 6);
    const std::vector<std::pair<int, int>> expected{{0, 1}, {2, 3}, {0, 4}, {0, 1}, {2, 3}, {0, 4}};
    for (std::size_t s = 0; s < expected.size(); ++s) {
        EXPECT_EQ(gk.history[s].pair, expected[s]);
        EXPECT_EQ(gk.history[s].step, static_cast<int>(s) + 1);
        EXPECT_GT(gk.history[s].mean_roundness.all.paper, 0.0);
    }
    options.method = Method::ck;
    const auto ck = run(domain, Lift::sphere, options).outcome;
    EXPECT_EQ(ck.steps, 10);
    for (int s = 0; s < ck.steps; ++s) EXPECT_EQ(ck.history[s].pair, std::pair(s % 5, s % 5));
    options.method = Method::against_outer;
    const auto outer = run(domain, Lift::sphere, options).outcome;
    EXPECT_EQ(outer.steps, 8);
    for (int s = 0; s < outer.steps; ++s) EXPECT_EQ(outer.history[s].pair, std::pair(0, 1 + s % 4));
}

TEST(KoebeMesh, a_step_puts_the_loops_it_opens_on_circles)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1500);
    KoebeMeshOptions recorded;
    recorded.record_steps = true;
    for (const Method method : {Method::gk, Method::ck, Method::against_outer}) {
        UniformizeOptions options;
        options.method = method;
        options.max_sweeps = 1;
        const KoebeOutcome outcome = run(domain, Lift::polynomial, options, recorded).outcome;
        ASSERT_EQ(outcome.step_images.size(), outcome.history.size());
        for (std::size_t s = 0; s < outcome.history.size(); ++s) {
            const auto [i, j] = outcome.history[s].pair;
            const VectorXcd outer = gather_loop(outcome.step_images[s], domain.loops[i]);
            EXPECT_LT((outer.array().abs() - 1.0).abs().maxCoeff(), 1e-12);
            // One loop is open with CK, and no other is round yet in the first step; else a second one is round.
            const VectorXcd other = gather_loop(outcome.step_images[s], domain.loops[i == j ? (i + 1) % 5 : j]);
            EXPECT_LT(other.cwiseAbs().maxCoeff(), 1.0);
            if (i == j)
                EXPECT_GT(deviation_from(fit_circle_least_squares(other), other), s == 0 ? 1e-4 : 0.0);
            else
                EXPECT_LT(other.cwiseAbs().maxCoeff() - other.cwiseAbs().minCoeff(), 1e-12);
        }
    }
}

TEST(KoebeMesh, partners_that_change_lead_to_the_same_circles)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 3000);
    UniformizeOptions options;
    options.tolerance = 1e-8;
    KoebeMeshOptions changing;
    changing.partners = Partners::changing;
    const KoebeMeshResult result = run(domain, Lift::enneper, options, changing);
    EXPECT_TRUE(result.outcome.converged);
    EXPECT_EQ(result.outcome.sweeps % 5, 0);  // whole rounds
    EXPECT_LT(error_of(domain, result), 1e-3);
}

TEST(KoebeMesh, a_schedule_is_followed)
{
    // The orders of Figs. 2 and 4.
    const CircleDomain domain =
        make_circle_domain({Circle{}, {{0.45, 0.0}, 0.2}, {{-0.3, 0.4}, 0.2}, {{-0.2, -0.45}, 0.25}}, 2000);
    UniformizeOptions options;
    KoebeMeshOptions fig4;
    fig4.schedule = {{0, 2}, {3, 0}, {0, 2}, {3, 1}, {0, 2}};
    const KoebeMeshResult gk = run(domain, Lift::sphere, options, fig4);
    EXPECT_TRUE(gk.outcome.converged);
    EXPECT_LT(error_of(domain, gk), 1e-3);
    for (int s = 0; s < gk.outcome.steps; ++s)
        EXPECT_EQ(gk.outcome.history[s].pair, std::pair(fig4.schedule[s % 5][0], fig4.schedule[s % 5][1]));
    options.method = Method::ck;
    KoebeMeshOptions fig2;
    fig2.schedule = {{0}, {3}, {1}, {2}};
    const KoebeMeshResult ck = run(domain, Lift::sphere, options, fig2);
    EXPECT_TRUE(ck.outcome.converged);
    EXPECT_LT(error_of(domain, ck), 1e-3);
    EXPECT_EQ(ck.outcome.history[1].pair, std::pair(3, 3));
}

TEST(KoebeMesh, what_cannot_be_is_an_error)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 600);
    const auto refused = [&](Method method, const KoebeMeshOptions& mesh_options) {
        UniformizeOptions options;
        options.method = method;
        try {
            run(domain, Lift::plane, options, mesh_options);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto scheduled = [](Sweep schedule) {
        KoebeMeshOptions mesh_options;
        mesh_options.schedule = std::move(schedule);
        return mesh_options;
    };
    const Sweep pairs{{0, 1}, {2, 3}, {0, 4}};
    EXPECT_EQ(refused(Method::gk, scheduled(pairs)), "");
    EXPECT_NE(refused(Method::ck, scheduled(pairs)), "");
    EXPECT_NE(refused(Method::gk, scheduled({{0, 1}, {2, 3}})).find("never opens loop 4"), std::string::npos);
    EXPECT_NE(refused(Method::gk, scheduled({{0, 1}, {2, 3}, {4, 5}})).find("names loop 5"), std::string::npos);
    EXPECT_NE(refused(Method::gk, scheduled({{0, 1}, {2, 3}, {4, 4}})).find("twice"), std::string::npos);
    EXPECT_NE(refused(Method::against_outer, scheduled(pairs)).find("fills loop 0"), std::string::npos);
    KoebeMeshOptions changing;
    changing.partners = Partners::changing;
    EXPECT_NE(refused(Method::ck, changing), "");
    KoebeMeshOptions flow;
    flow.annulus = AnnulusBackend::yamabe;
    EXPECT_NE(refused(Method::gk, flow).find("reflected metric"), std::string::npos);
}

TEST(KoebeMesh, both_engines_find_the_same_circles)
{
    const CircleDomain domain = make_circle_domain(six_circles(), 4000);
    for (const Lift kind : curved_lifts) {
        std::vector<Circle> circles[2];
        for (const Engine engine : {Engine::condensed, Engine::mesh}) {
            UniformizeOptions options;
            options.engine = engine;
            ExecutionContext context;
            for (const LoopReport& loop :
                 uniformize(lift(domain.points, kind), domain.triangles, options, context).loops)
                circles[engine == Engine::mesh].push_back(loop.circle);
        }
        EXPECT_LT(inversive_distance_error(circles[1], circles[0]), 2e-3) << to_string(kind);
    }
}

TEST(KoebeMesh, two_loops_are_one_step)
{
    const CircleDomain annulus = make_round_annulus(0.3, 96, 20);
    const KoebeMeshResult result = run(annulus, Lift::sphere);
    EXPECT_TRUE(result.outcome.converged);
    EXPECT_EQ(result.outcome.steps, 1);
    EXPECT_LT(error_of(annulus, result), 1e-3);
}

/// Between two edges of one length the disk's faces grow, but what it maps is still the disk.
TEST(KoebeMesh, disks_of_long_rims_have_faces_in_proportion_to_their_edges)
{
    for (const Index count : {400, 2000}) {
        VectorXcd rim(count);
        Vertices loop = Vertices::Zero(count, 3);
        std::vector<Index> fixed;
        for (Index i = 0; i < count; ++i) {
            rim[i] = std::polar(1.0, -2.0 * std::numbers::pi * i / count);
            loop.row(i).head<2>() << rim[i].real(), rim[i].imag();
            fixed.push_back(i);
        }
        DiskPatch patch(loop);
        patch.refill(rim);
        EXPECT_LT(patch.triangles().rows(), 16 * count);
        const auto extended = [&](const VectorXcd& values) {
            return harmonic_map(patch.triangles(), patch.lengths(), patch.vertex_count(), fixed, values);
        };
        const VectorXcd z = extended(rim);
        EXPECT_LT((extended(rim.array().cube()) - VectorXcd(z.array().cube())).cwiseAbs().maxCoeff(), 5e-3);
    }
}

TEST(KoebeMesh, edges_between_vertices_of_one_loop_do_no_harm)
{
    // An ear on every second edge of the smallest hole: its inner edge joins two vertices of the loop, as an edge of
    // the disk that fills it might. f is constant on the ear, but g puts its tip between the two.
    CircleDomain domain = make_circle_domain(five_circles(), 600);
    VertexLoop& loop = domain.loops[4];
    VertexLoop with_ears;
    for (std::size_t b = 0; b < loop.size(); ++b) {
        const Index from = loop[b], to = loop[(b + 1) % loop.size()];
        with_ears.push_back(from);
        if (b % 2 == 1) continue;
        const Index tip = static_cast<Index>(domain.points.size());
        domain.points.conservativeResize(tip + 1);
        domain.points[tip] = 0.4 * (domain.points[from] + domain.points[to]) + 0.2 * domain.circles[4].center;
        domain.triangles.conservativeResize(domain.triangles.rows() + 1, 3);
        domain.triangles.bottomRows(1) << to, from, tip;
        with_ears.push_back(tip);
    }
    loop = with_ears;
    const KoebeMeshResult result = run(domain, Lift::sphere);
    EXPECT_TRUE(result.outcome.converged);
    EXPECT_TRUE(result.positions.allFinite());
    EXPECT_EQ(result.outcome.raised_angles, 0);
}

TEST(KoebeMesh, one_loop_is_the_riemann_map)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 4000);
    const KoebeMeshResult result = run(disk, Lift::enneper);
    EXPECT_TRUE(result.outcome.converged);
    EXPECT_EQ(result.outcome.steps, 0);
    // Enneper's surface is symmetric, so the normalized map is a rotation of the disk.
    Complex turn = (result.positions.array() * disk.points.array().conjugate()).sum();
    turn /= std::abs(turn);
    EXPECT_LT((result.positions.array() - turn * disk.points.array()).abs().maxCoeff(), 2e-3);
}

TEST(KoebeMesh, slow_the_metric_of_the_image_in_print_drifts)
{
    // What the paper writes, and why it is not the default: each sweep adds an error of the size of the first.
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    UniformizeOptions options;
    options.tolerance = 0.0;
    for (const auto metric : {KoebeMeshOptions::Metric::planar, KoebeMeshOptions::Metric::reflected})
        for (const Method method : {Method::gk, Method::ck}) {
            options.method = method;
            KoebeMeshOptions in_print;
            in_print.metric = metric;
            std::vector<double> errors;
            for (const int sweeps : {2, 4, 8}) {
                options.max_sweeps = sweeps;
                errors.push_back(error_of(domain, run(domain, Lift::polynomial, options, in_print)));
            }
            EXPECT_GT(errors[1], 1.5 * errors[0]);
            EXPECT_GT(errors[2], 1.5 * errors[1]);
            options.max_sweeps = 2;
            EXPECT_LT(error_of(domain, run(domain, Lift::polynomial, options)), 0.1 * errors[0]);
        }
}

TEST(KoebeMesh, the_reflection_in_print_is_in_a_hole_that_the_next_step_opens)
{
    // Where it is decides the small triangles of the next metric, and so the O(h^2) of the circles after the step.
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    UniformizeOptions options;
    options.max_sweeps = 1;
    const auto after_first_step = [&](KoebeMeshOptions::Metric metric, const Sweep& schedule) {
        KoebeMeshOptions in_print;
        in_print.metric = metric;
        in_print.schedule = schedule;
        return run(domain, Lift::polynomial, options, in_print).outcome.history[0].circles;
    };
    const Sweep sweep{{0, 1}, {2, 3}, {4, 0}}, same_hole{{0, 1}, {2, 4}, {3, 0}}, other_hole{{0, 1}, {3, 2}, {4, 0}},
        still_open{{0, 1}, {1, 2}, {3, 4}};
    for (const auto metric : {KoebeMeshOptions::Metric::reflected, KoebeMeshOptions::Metric::reflected_last}) {
        const auto first = after_first_step(metric, sweep);
        const auto difference = [&](const Sweep& to) {
            return inversive_distance_error(after_first_step(metric, to), first);
        };
        EXPECT_EQ(difference(same_hole), 0.0);
        EXPECT_EQ(difference(still_open), 0.0);  // hole 1 is open in both steps, so hole 2 is the next one
        if (metric == KoebeMeshOptions::Metric::reflected)
            EXPECT_GT(difference(other_hole), 1e-4);
        else
            EXPECT_EQ(difference(other_hole), 0.0);
    }
}

TEST(KoebeMesh, a_loop_opened_twice_in_a_row_needs_no_reflection)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    UniformizeOptions options;
    options.method = Method::ck;
    options.max_sweeps = 1;
    KoebeMeshOptions in_print;
    in_print.metric = KoebeMeshOptions::Metric::reflected;
    in_print.schedule = {{0}, {0}, {1}, {2}, {3}, {4}};
    EXPECT_LT(error_of(domain, run(domain, Lift::polynomial, options, in_print)), 0.1);
}

TEST(KoebeMesh, slow_the_yamabe_flow_maps_the_annuli_as_the_one_form_does)
{
    // The first step starts from the surface, and the two maps differ by O(h^2).
    for (const Method method : {Method::gk, Method::ck, Method::against_outer}) {
        UniformizeOptions options;
        options.method = method;
        options.max_sweeps = 1;
        KoebeMeshOptions form;
        form.metric = KoebeMeshOptions::Metric::reflected;
        form.record_steps = true;
        KoebeMeshOptions flow = form;
        flow.annulus = AnnulusBackend::yamabe;
        double difference[2];
        for (const int fine : {0, 1}) {
            const CircleDomain domain = make_circle_domain(five_circles(), fine ? 6000 : 1500);
            const VectorXcd a = run(domain, Lift::polynomial, options, form).outcome.step_images[0],
                            b = run(domain, Lift::polynomial, options, flow).outcome.step_images[0];
            Complex turn = (a.array() * b.array().conjugate()).sum();
            turn /= std::abs(turn);
            difference[fine] = (a - turn * b).cwiseAbs().maxCoeff();
        }
        EXPECT_LT(difference[0], 1e-2);
        EXPECT_LT(difference[1], 0.8 * difference[0]);
    }
}

TEST(KoebeMesh, progress_never_goes_back_and_cancelling_stops_it)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Surface surface = analyze_surface(domain.triangles, static_cast<Index>(domain.points.size()));
    const Vertices vertices = lift(domain.points, Lift::sphere);
    double last = -1.0;
    int calls = 0;
    CancelToken token;
    const auto progress = [&](double fraction, const std::string&) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++calls;
    };
    ExecutionContext context(progress, token);
    const KoebeMeshResult result = koebe_mesh(vertices, surface, domain.loops, {}, context);
    EXPECT_GE(calls, result.outcome.steps);

    ExecutionContext cancelled([&](double, const std::string&) { token.cancel(); }, token);
    EXPECT_THROW(koebe_mesh(vertices, surface, domain.loops, {}, cancelled), Cancelled);
}
