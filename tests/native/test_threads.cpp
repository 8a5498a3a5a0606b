// Calls at once: each gives, bit for bit, what it gives alone; progress and cancel reach the right one. The thread
// sanitizer looks on in `make test-tsan`.
#include "circle_domain.h"

#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "holes/fair_filling.h"
#include "pipeline/uniformize.h"
#include "quality/distortion.h"
#include "shape/loop_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <latch>
#include <thread>
#include <type_traits>

using namespace koebe;
using namespace koebe::test;

namespace {

constexpr std::size_t calls_at_once = 8;
constexpr Index face_count = 250;

struct Call {
    Vertices vertices;
    Triangles triangles;
    UniformizeOptions options;
};

/// Eight calls that share no road: other surfaces, engines, methods and options.
std::vector<Call> eight_calls()
{
    const CircleDomain holes = make_circle_domain(five_circles(), face_count);
    const CircleDomain disk = make_circle_domain({Circle{}}, face_count);
    const CircleDomain ring = make_round_annulus(0.4, 24, 5);
    std::vector<Call> calls;
    for (const CircleDomain* domain : {&holes, &disk, &ring})
        for (const Lift kind : {Lift::polynomial, Lift::enneper})
            calls.push_back({lift(domain->points, kind), domain->triangles, {}});
    calls.push_back(calls[0]);
    calls.back().options.engine = Engine::mesh;
    calls.push_back(calls[1]);
    calls.back().options.method = Method::ck;
    calls.back().options.balance = Balance::area;
    calls.back().options.polish = true;
    EXPECT_EQ(calls.size(), calls_at_once);
    return calls;
}

UniformizeResult run(const Call& call)
{
    ExecutionContext context;
    return uniformize(call.vertices, call.triangles, call.options, context);
}

/// Runs it for 0, 1 ... at once: no thread begins before all are there.
template <class Work>
void at_once(std::size_t count, const Work& work)
{
    std::latch all_here(static_cast<std::ptrdiff_t>(count));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i)
        threads.emplace_back([&work, &all_here, i] {
            all_here.arrive_and_wait();
            work(i);
        });
    for (std::thread& thread : threads) thread.join();
}

std::vector<UniformizeResult> one_after_the_other(const std::vector<Call>& calls)
{
    std::vector<UniformizeResult> results;
    for (const Call& call : calls) results.push_back(run(call));
    return results;
}

void expect_same(const UniformizeResult& result, const UniformizeResult& expected, std::size_t call)
{
    EXPECT_EQ(result.uv, expected.uv) << call;
    EXPECT_EQ(result.sweeps, expected.sweeps) << call;
    EXPECT_EQ(result.warnings, expected.warnings) << call;
}

/// One call alone, then eight at once.
template <class Function>
void expect_alike(const char* name, const Function& function)
{
    const auto expected = function();
    std::vector<std::decay_t<decltype(expected)>> results(calls_at_once, expected);
    at_once(calls_at_once, [&](std::size_t i) { results[i] = function(); });
    for (const auto& result : results) EXPECT_TRUE(result == expected) << name;
}

}  // namespace

TEST(Threads, eight_calls_at_once_give_what_each_gives_alone)
{
    const std::vector<Call> calls = eight_calls();
    const std::vector<UniformizeResult> expected = one_after_the_other(calls);
    std::vector<UniformizeResult> results(calls_at_once);
    at_once(calls_at_once, [&](std::size_t i) { results[i] = run(calls[i]); });
    for (std::size_t i = 0; i < calls_at_once; ++i) expect_same(results[i], expected[i], i);
}

TEST(Threads, eight_calls_may_share_one_surface)
{
    const Call call = eight_calls()[0];
    const UniformizeResult expected = run(call);
    std::vector<UniformizeResult> results(calls_at_once);
    at_once(calls_at_once, [&](std::size_t i) { results[i] = run(call); });
    for (std::size_t i = 0; i < calls_at_once; ++i) expect_same(results[i], expected, i);
}

TEST(Threads, progress_comes_on_the_thread_that_called)
{
    const std::vector<Call> calls = eight_calls();
    std::vector<std::vector<double>> fractions(calls_at_once);
    at_once(calls_at_once, [&](std::size_t i) {
        const auto caller = std::this_thread::get_id();
        ExecutionContext context(
            [&, caller, i](double fraction, const std::string&) {
                EXPECT_EQ(std::this_thread::get_id(), caller);
                fractions[i].push_back(fraction);
            },
            {});
        uniformize(calls[i].vertices, calls[i].triangles, calls[i].options, context);
    });
    for (const std::vector<double>& told : fractions) {
        EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told.back(), 1.0);
    }
}

TEST(Threads, a_cancel_stops_its_own_call_and_no_other)
{
    const std::vector<Call> calls = eight_calls();
    const std::vector<UniformizeResult> expected = one_after_the_other(calls);
    std::vector<UniformizeResult> results(calls_at_once);
    std::vector<char> cancelled(calls_at_once, 0);
    at_once(calls_at_once, [&](std::size_t i) {
        CancelToken token;
        std::size_t reports = 0;
        // Every second call, each at another moment, and by a thread that is not the one that called.
        ExecutionContext context(
            [&](double, const std::string&) {
                if (i % 2 == 0 && ++reports == 1 + i / 2) std::thread([token]() mutable { token.cancel(); }).join();
            },
            token);
        try {
            results[i] = uniformize(calls[i].vertices, calls[i].triangles, calls[i].options, context);
        } catch (const Cancelled&) {
            cancelled[i] = 1;
        }
    });
    for (std::size_t i = 0; i < calls_at_once; ++i) {
        EXPECT_EQ(cancelled[i], i % 2 == 0 ? 1 : 0) << i;
        if (!cancelled[i]) expect_same(results[i], expected[i], i);
    }
}

TEST(Threads, what_was_left_behind_disturbs_no_later_call)
{
    const std::vector<Call> calls = eight_calls();
    const UniformizeResult expected = run(calls[0]);
    for (int again = 0; again < 6; ++again) {
        CancelToken token;
        ExecutionContext context(
            [&](double fraction, const std::string&) {
                if (fraction > 0.1) token.cancel();
            },
            token);
        EXPECT_THROW(uniformize(calls[1].vertices, calls[1].triangles, calls[1].options, context), Cancelled);
        expect_same(run(calls[0]), expected, 0);  // while that one runs on to its next checkpoint
    }
}

TEST(Threads, the_other_functions_give_at_once_what_they_give_alone)
{
    const CircleDomain holes = make_circle_domain(five_circles(), face_count);
    const CircleDomain disk = make_circle_domain({Circle{}}, face_count);
    const CircleDomain ring = make_round_annulus(0.4, 24, 5);
    const Vertices surface = lift(holes.points, Lift::enneper);
    const auto lengths = [](const CircleDomain& domain) {
        return edge_lengths(lift(domain.points, Lift::enneper), domain.triangles);
    };
    const auto annulus = [&](AnnulusBackend backend) {
        return annulus_map(ring.triangles, lengths(ring), static_cast<Index>(ring.points.size()), ring.loops[0],
                           ring.loops[1], {.backend = backend})
            .positions;
    };
    expect_alike("disk_map", [&] {
        return disk_map(disk.triangles, lengths(disk), static_cast<Index>(disk.points.size()), disk.loops[0]).positions;
    });
    expect_alike("annulus_map", [&] { return annulus(AnnulusBackend::harmonic); });
    expect_alike("annulus_map, yamabe", [&] { return annulus(AnnulusBackend::yamabe); });
    expect_alike("measure_distortion", [&] {
        PlanarPoints uv(holes.points.size(), 2);
        uv << holes.points.real(), holes.points.imag();
        return measure_distortion(surface, holes.triangles, uv).angle_error_deg.mean;
    });
    expect_alike("match_loops", [] { return match_loops(five_circles(), five_circles()).distance; });
}

// Of triangulations that are as good, as there are of a round hole, CGAL takes the first that it meets.
TEST(Threads, faired_holes_are_the_same_each_time)
{
    const CircleDomain holes = make_circle_domain(five_circles(), face_count);
    const Vertices surface = lift(holes.points, Lift::enneper);
    expect_alike("fill_and_fair_holes", [&] { return fill_and_fair_holes(surface, holes.triangles).vertices; });
}

namespace {

void expect_same_map_on_any_number_of_threads(const CircleDomain& domain)
{
    const Vertices vertices = lift(domain.points, Lift::enneper);
    UniformizeOptions options;
    options.threads = 1;
    const UniformizeResult one = uniformize(vertices, domain.triangles, options);
    EXPECT_TRUE(one.converged);
    for (const int threads : {2, 3}) {
        options.threads = threads;
        const UniformizeResult several = uniformize(vertices, domain.triangles, options);
        EXPECT_EQ(one.uv, several.uv);
        EXPECT_EQ(one.distortion.angle_error_deg.mean, several.distortion.angle_error_deg.mean);
        EXPECT_EQ(one.distortion.area.log_sd, several.distortion.area.log_sd);
        for (std::size_t k = 0; k < one.loops.size(); ++k)
            EXPECT_EQ(one.loops[k].circle.center, several.loops[k].circle.center);
    }
}

}  // namespace

TEST(Threads, a_large_surface_has_the_same_map_on_any_number_of_threads)
{
    expect_same_map_on_any_number_of_threads(make_circle_domain(five_circles(), 110000));  // is factored in pieces
}

TEST(Threads, a_surface_with_long_boundaries_has_the_same_map_on_any_number_of_threads)
{
    std::vector<Circle> circles{Circle{}};
    for (int k = 0; k < 14; ++k) circles.push_back({std::polar(0.75, 0.449 * k), 0.12});
    for (int k = 0; k < 8; ++k) circles.push_back({std::polar(0.4, 0.785 * k + 0.2), 0.1});
    expect_same_map_on_any_number_of_threads(make_circle_domain(circles, 20000));  // and so has no Sigma
}
