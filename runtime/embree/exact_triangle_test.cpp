// SPDX-License-Identifier: MIT
#include "runtime/embree/exact_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <random>
#include <vector>

#include "runtime/embree/testing/closed_mesh.h"

namespace kaamos::embree {
namespace {

using testing::closed_mesh;
using testing::Point;
using testing::Triangle;
__extension__ using Int128 = __int128;

ExactRay ray_from(const Point& origin, const Point& towards) {
  double o[3];
  double d[3];
  for (int i = 0; i < 3; ++i) {
    o[i] = origin[i];
    d[i] = static_cast<float>(towards[i] - origin[i]);
  }
  return ExactRay(o, d);
}

bool hits(const ExactRay& ray, const Triangle& triangle, ExactHit& hit) {
  return intersect(ray, triangle[0].data(), triangle[1].data(), triangle[2].data(), hit);
}

int hits_in_front(const ExactRay& ray, const std::vector<Triangle>& mesh) {
  ExactHit hit;
  return static_cast<int>(std::count_if(mesh.begin(), mesh.end(), [&](const Triangle& triangle) {
    return hits(ray, triangle, hit) && hit.t > 0;
  }));
}

TEST(ExactTriangle, DifferenceOfProductsHasTheExactSign) {
  // (2^52 + 1)^2 - 2^52 * (2^52 + 2) = 1, far below what rounded products can resolve.
  const double n = 0x1p52;
  EXPECT_GT(difference_of_products(n + 1, n + 1, n, n + 2), 0);
  EXPECT_LT(difference_of_products(n, n + 2, n + 1, n + 1), 0);
  EXPECT_EQ(difference_of_products(n + 1, n, n, n + 1), 0);
  // Compares with 128-bit integers, where products nearly cancel.
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    const auto a = static_cast<int64_t>(random() >> 13);
    const auto d = static_cast<int64_t>(random() >> 13);
    const auto b = a + static_cast<int64_t>(random() % 5) - 2;
    const auto c = d + static_cast<int64_t>(random() % 5) - 2;
    const Int128 exact = static_cast<Int128>(a) * d - static_cast<Int128>(b) * c;
    const double got = difference_of_products(static_cast<double>(a), static_cast<double>(d),
                                              static_cast<double>(b), static_cast<double>(c));
    ASSERT_EQ(got > 0, exact > 0) << a << ' ' << d << ' ' << b << ' ' << c;
    ASSERT_EQ(got < 0, exact < 0) << a << ' ' << d << ' ' << b << ' ' << c;
    ASSERT_NEAR(got, static_cast<double>(exact), 1e-7 * std::fabs(static_cast<double>(exact)));
  }
}

// From inside a closed mesh each ray hits one triangle, wherever it is aimed.
TEST(ExactTriangle, RaysAtEdgesAndVerticesOfAClosedMeshHitOneTriangle) {
  for (const float scale : {1e-15f, 1e-9f, 1.0f, 1e12f, 1e17f}) {
    const std::vector<Triangle> mesh = closed_mesh(6, scale);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 6000; ++i) {
      const Triangle& aim = mesh[random() % mesh.size()];
      const Point origin = {scale * (unit(random) - 0.5f) * 0.2f,
                            i % 2 == 0 ? 0.0f : scale * 0.1f * unit(random), 0};
      const float along = i % 3 == 0 ? 0.0f : unit(random);
      Point target;
      for (int k = 0; k < 3; ++k) target[k] = aim[0][k] + along * (aim[1][k] - aim[0][k]);
      ASSERT_EQ(hits_in_front(ray_from(origin, target), mesh), 1) << scale << " ray " << i;
    }
  }
}

// Integer coordinates, so that rays pass exactly through edges and vertices, and along faces of a
// fan.
TEST(ExactTriangle, AFanIsHitOnceThroughItsEdgesAndItsHub) {
  const Point rim[] = {{4, 0, 9}, {3, 3, 9}, {0, 4, 9}, {-4, 0, 9}, {-2, -2, 9}, {0, -4, 9}};
  const Point hub = {0, 0, 9};
  std::vector<Triangle> fan;
  for (int i = 0; i < 6; ++i) fan.push_back({hub, rim[i], rim[(i + 1) % 6]});
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 4; ++k) {
      const float f = static_cast<float>(k) / 4;
      const Point target = {f * rim[i][0], f * rim[i][1], 9};
      EXPECT_EQ(hits_in_front(ray_from({target[0], target[1], 0}, target), fan), 1) << i << k;
      EXPECT_EQ(hits_in_front(ray_from({0, 0, 0}, target), fan), 1) << i << k;
    }
  }
}

TEST(ExactTriangle, TheOrderOfTheCornersOnlyTurnsTheFace) {
  std::mt19937 random(3);
  const auto coordinate = [&] { return static_cast<float>(random() % 5) - 2; };
  int on_edges = 0;
  for (int i = 0; i < 20000; ++i) {
    Triangle triangle;
    for (Point& p : triangle) p = {coordinate(), coordinate(), 5 + coordinate()};
    const ExactRay ray = ray_from({coordinate(), coordinate(), 0}, {coordinate(), coordinate(), 5});
    ExactHit first;
    const bool hit = hits(ray, triangle, first);
    if (hit && (first.u == 0 || first.v == 0)) ++on_edges;
    ExactHit turned;
    EXPECT_EQ(hits(ray, {triangle[1], triangle[2], triangle[0]}, turned), hit);
    EXPECT_TRUE(!hit || turned.clockwise == first.clockwise);
    EXPECT_EQ(hits(ray, {triangle[0], triangle[2], triangle[1]}, turned), hit);
    EXPECT_TRUE(!hit || turned.clockwise != first.clockwise);
  }
  EXPECT_GT(on_edges, 100);
}

TEST(ExactTriangle, ClockwiseIsAFrontFace) {
  ExactHit hit;
  const Triangle triangle = {{{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}}};
  ASSERT_TRUE(hits(ray_from({0, 0.5f, -1}, {0, 0.5f, 0}), triangle, hit));
  EXPECT_TRUE(hit.clockwise);
  EXPECT_EQ(hit.t, 1);
  EXPECT_EQ(hit.u, 0.25);
  EXPECT_EQ(hit.v, 0.25);
  ASSERT_TRUE(hits(ray_from({0, 0.5f, 1}, {0, 0.5f, 0}), triangle, hit));
  EXPECT_FALSE(hit.clockwise);
}

TEST(ExactTriangle, AgreesWithLongDouble) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> around(-1, 1);
  double worst_t = 0;
  int compared = 0;
  for (int i = 0; i < 50000; ++i) {
    Triangle p;
    for (Point& v : p) v = {around(random), around(random), around(random) + 3};
    const Point target = {(p[0][0] + p[1][0] + p[2][0]) / 3, (p[0][1] + p[1][1] + p[2][1]) / 3,
                          (p[0][2] + p[1][2] + p[2][2]) / 3};
    const ExactRay ray = ray_from({around(random), around(random), 0}, target);
    long double e[3], f[3], s[3], h[3], q[3];
    for (int k = 0; k < 3; ++k) {
      e[k] = static_cast<long double>(p[1][k]) - p[0][k];
      f[k] = static_cast<long double>(p[2][k]) - p[0][k];
      s[k] = static_cast<long double>(ray.origin[k]) - p[0][k];
    }
    const double* d = ray.direction;
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3, n = (k + 2) % 3;
      h[k] = d[m] * f[n] - d[n] * f[m];
      q[k] = s[m] * e[n] - s[n] * e[m];
    }
    const long double det = e[0] * h[0] + e[1] * h[1] + e[2] * h[2];
    if (std::fabs(static_cast<double>(det)) < 1e-4) continue;
    ExactHit hit;
    ASSERT_TRUE(hits(ray, p, hit));
    ++compared;
    const auto t = static_cast<double>((f[0] * q[0] + f[1] * q[1] + f[2] * q[2]) / det);
    const auto u = static_cast<double>((s[0] * h[0] + s[1] * h[1] + s[2] * h[2]) / det);
    const auto v = static_cast<double>((d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det);
    worst_t = std::max(worst_t, std::fabs(hit.t / t - 1));
    EXPECT_NEAR(hit.u, u, 1e-10);
    EXPECT_NEAR(hit.v, v, 1e-10);
    EXPECT_EQ(hit.clockwise, det > 0);
  }
  EXPECT_GT(compared, 40000);
  EXPECT_LT(worst_t, 1e-10);  // a ten-thousandth of a float ulp
}

TEST(ExactTriangle, DegenerateOnesAreFound) {
  const auto degenerate = [](const Point& a, const Point& b, const Point& c) {
    return is_degenerate(a.data(), b.data(), c.data());
  };
  EXPECT_TRUE(degenerate({1, 2, 3}, {1, 2, 3}, {4, 5, 7}));
  EXPECT_TRUE(degenerate({0, 0, 0}, {1, 3, 5}, {3, 9, 15}));
  EXPECT_TRUE(degenerate({1e9f, 1, 1e-3f}, {1e9f, 1, 1e-3f}, {1e9f, 1, 1e-3f}));
  EXPECT_FALSE(degenerate({0, 0, 0}, {1, 3, 5}, {3, 9, std::nextafter(15.0f, 0.0f)}));
  EXPECT_FALSE(degenerate({0, 0, 0}, {1e-12f, 0, 0}, {0, 1e-12f, 0}));
}

}  // namespace
}  // namespace kaamos::embree
