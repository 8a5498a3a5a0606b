#include "damaged_meshes.h"
#include "package/koebe_c.h"
#include "pipeline/uniformize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace koebe::test {
namespace {

constexpr double untouched = 7.0;

/// A call of the C function, with arrays that tell whether it wrote to them.
struct CCall {
    Vertices vertices;
    Triangles triangles;
    koebe_options options = KOEBE_DEFAULT_OPTIONS;
    PlanarPoints uv;
    std::array<koebe_circle, 3> circles{};
    koebe_report report{};
    std::array<char, 200> message{};
    int status = -1;

    CCall(Vertices at, Triangles faces) : vertices(std::move(at)), triangles(std::move(faces))
    {
        options.threads = 1;
        uv = PlanarPoints::Constant(vertices.rows(), 2, untouched);
    }
    int run()
    {
        return status = koebe_uniformize(vertices.data(), vertices.rows(), triangles.data(), triangles.rows(), &options,
                                         uv.data(), circles.data(), 3, &report, message.data(), message.size());
    }
    bool says(const char* word) const { return std::strstr(message.data(), word) != nullptr; }
    bool wrote() const { return !(uv.array() == untouched).all(); }
};

/// A ring of 12 quadrilaterals.
CCall ring()
{
    Vertices vertices(24, 3);
    Triangles triangles(24, 3);
    for (Index k = 0; k < 12; ++k) {
        const double turn = 2.0 * std::acos(-1.0) * k / 12.0;
        vertices.row(k) << 2.0 * std::cos(turn), 2.0 * std::sin(turn), 0.0;
        vertices.row(12 + k) << std::cos(turn), std::sin(turn), 0.0;
        const Index next = (k + 1) % 12;
        triangles.row(2 * k) << k, next, next + 12;
        triangles.row(2 * k + 1) << k, next + 12, k + 12;
    }
    return {vertices, triangles};
}

}  // namespace

TEST(KoebeC, GivesTheMapOfTheLibrary)
{
    CCall call = ring();
    call.options.even = 0.5;
    ASSERT_EQ(call.run(), KOEBE_DONE) << call.message.data();
    UniformizeOptions options;
    options.even = 0.5;
    const UniformizeResult map = uniformize(call.vertices, call.triangles, options);
    EXPECT_TRUE(call.uv == map.uv);
    EXPECT_EQ(call.report.loops, 2);
    EXPECT_EQ(call.circles[1].radius, map.loops[1].circle.radius);
    EXPECT_EQ(call.circles[2].radius, 0.0);
    EXPECT_EQ(call.report.angle_error_deg, map.distortion.angle_error_deg.mean);
    EXPECT_STREQ(call.message.data(), "");
}

TEST(KoebeC, MayWriteOverTheVertices)
{
    CCall call = ring(), apart = ring();
    ASSERT_EQ(apart.run(), KOEBE_DONE);
    ASSERT_EQ(koebe_uniformize(call.vertices.data(), 24, call.triangles.data(), 24, nullptr, call.vertices.data(),
                               nullptr, 0, nullptr, nullptr, 0),
              KOEBE_DONE);
    EXPECT_TRUE(Eigen::Map<const PlanarPoints>(call.vertices.data(), 24, 2) == apart.uv);
}

TEST(KoebeC, RefusesArgumentsThatAreWrong)
{
    const CCall good = ring();
    const auto refused = [&](const char* word, const auto& spoil) {
        CCall call = good;
        spoil(call);
        EXPECT_EQ(call.run(), KOEBE_WRONG_USAGE) << word;
        EXPECT_TRUE(call.says("InputError: ") && call.says(word)) << call.message.data();
        EXPECT_FALSE(call.wrote());
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refused("NaN", [](CCall& call) { call.vertices(5, 1) = nan; });
    refused("NaN", [](CCall& call) { call.vertices(5, 1) = -HUGE_VAL; });
    refused("vertex that does not exist", [](CCall& call) { call.triangles(3, 2) = 99; });
    refused("vertex that does not exist", [](CCall& call) { call.triangles(3, 2) = -1; });
    refused("even", [](CCall& call) { call.options.even = nan; });
    refused("even", [](CCall& call) { call.options.even = 1.5; });
    refused("threads", [](CCall& call) { call.options.threads = -1; });
    refused("numbered from 0", [](CCall& call) { call.options.center = -2; });
    refused("does not exist", [](CCall& call) { call.options.center = 24; });
    refused("24", [](CCall& call) { call.options.outer_vertex = 24; });
    refused("24", [](CCall& call) { call.options.point = 24; });
}

TEST(KoebeC, RefusesPointersAndLengthsThatAreWrong)
{
    CCall call = ring();
    const auto refused = [&](const double* vertices, int64_t vertex_count, const int32_t* triangles,
                             int64_t triangle_count, double* uv, koebe_circle* circles, int64_t circle_count) {
        EXPECT_EQ(koebe_uniformize(vertices, vertex_count, triangles, triangle_count, nullptr, uv, circles,
                                   circle_count, nullptr, call.message.data(), call.message.size()),
                  KOEBE_WRONG_USAGE);
        EXPECT_TRUE(call.says("InputError: ")) << call.message.data();
        EXPECT_FALSE(call.wrote());
    };
    const double* const at = call.vertices.data();
    const int32_t* const faces = call.triangles.data();
    double* const uv = call.uv.data();
    constexpr int64_t huge = std::numeric_limits<int64_t>::max();
    refused(nullptr, 24, faces, 24, uv, nullptr, 0);
    refused(at, 24, nullptr, 24, uv, nullptr, 0);
    refused(at, 24, faces, 24, nullptr, nullptr, 0);
    refused(at, 24, faces, 24, uv, nullptr, 1);
    refused(at, 24, faces, 24, uv, nullptr, -1);
    refused(at, -1, faces, 24, uv, nullptr, 0);
    refused(at, huge, faces, 24, uv, nullptr, 0);
    refused(at, 24, faces, -1, uv, nullptr, 0);
    refused(at, 24, faces, huge, uv, nullptr, 0);
    refused(at, 24, faces, 0, uv, nullptr, 0);
    refused(nullptr, 0, nullptr, 0, nullptr, nullptr, 0);
}

TEST(KoebeC, CutsAMessageThatHasNoRoom)
{
    CCall call = ring();
    call.triangles(0, 0) = 99;
    for (std::size_t size = 0; size < 20; ++size) {
        std::array<char, 21> message;
        message.fill('#');
        EXPECT_EQ(koebe_uniformize(call.vertices.data(), 24, call.triangles.data(), 24, nullptr, call.uv.data(),
                                   nullptr, 0, nullptr, message.data(), size),
                  KOEBE_WRONG_USAGE);
        EXPECT_EQ(message[size], '#');
        if (size > 0) EXPECT_EQ(std::strlen(message.data()), size - 1);
    }
}

TEST(KoebeC, AnswersForAnyMesh)
{
    int maps = 0;
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        NamedMesh mesh = random_mesh(seed);
        if (seed % 3 > 0) {  // a ring with points anywhere, every second one damaged
            const CCall whole = ring();
            mesh = {"ring", whole.vertices, whole.triangles};
            std::normal_distribution<double> some(0.0, 0.2 * (seed % 5) + 0.01);
            for (double& number : mesh.vertices.reshaped()) number += some(random);
            if (seed % 3 > 1) mesh = damaged(mesh, random);
        }
        CCall call(mesh.vertices, mesh.triangles);
        call.run();
        const bool mapped = call.status == KOEBE_DONE || call.status == KOEBE_NOT_CONVERGED;
        EXPECT_TRUE(mapped || call.status == KOEBE_CANNOT_BE_MAPPED || call.status == KOEBE_WRONG_USAGE) << seed;
        EXPECT_EQ(call.message[0] == '\0', call.status == KOEBE_DONE) << seed;
        EXPECT_EQ(call.wrote(), mapped) << seed;
        if (mapped) EXPECT_TRUE(call.uv.allFinite() && call.uv.rowwise().norm().maxCoeff() <= 1.0 + 1e-12) << seed;
        if (call.status == KOEBE_DONE) EXPECT_EQ(call.report.flipped, call.report.below_resolution) << seed;
        maps += mapped ? 1 : 0;
    }
    EXPECT_GT(maps, 80);
}

TEST(KoebeC, GivesTheSameOnSeveralThreads)
{
    CCall alone = ring();
    ASSERT_EQ(alone.run(), KOEBE_DONE);
    std::vector<CCall> calls(4, ring());
    std::vector<std::thread> threads;
    for (CCall& call : calls)
        threads.emplace_back([&call] {
            for (int k = 0; k < 20; ++k) call.run();
        });
    for (std::thread& thread : threads) thread.join();
    for (const CCall& call : calls) EXPECT_TRUE(call.status == KOEBE_DONE && call.uv == alone.uv);
}

}  // namespace koebe::test
