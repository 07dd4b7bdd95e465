// SPDX-License-Identifier: MIT
// Tests the comparison itself: what it must tolerate and what it must not.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/parity/hits.h"
#include "tests/parity/pictures.h"

namespace {

using namespace kaamos::parity;
using kaamos::effects::FloatImage;

constexpr uint32_t kWidth = 200;

// Two triangles share the picture: 1 on the left, 2 on the right.
std::vector<HitRecord> halves() {
  std::vector<HitRecord> hits(kWidth * 100);
  for (size_t i = 0; i < hits.size(); ++i) {
    hits[i].hit = 1;
    hits[i].primitive = i % kWidth < kWidth / 2 ? 1 : 2;
    hits[i].t = hits[i].primitive == 1 ? 5.0f : 9.0f;
    hits[i].cosine = 1;
    hits[i].record = 3;
    hits[i].coordinate = 9;
  }
  return hits;
}

size_t pixel(uint32_t x, uint32_t y) {
  return y * kWidth + x;
}

TEST(CompareHits, TheSameIsTheSame) {
  const auto a = halves();
  const HitDifference difference = compare_hits(a, a, kWidth);
  EXPECT_EQ(judge(difference), "");
  EXPECT_EQ(difference.count(HitChange::kNone), a.size());
  EXPECT_EQ(difference.hits, a.size());
  EXPECT_EQ(difference.worst_text, "");
}

TEST(CompareHits, TheNeighboursTriangleIsASilhouette) {
  const auto a = halves();
  auto b = a;
  b[pixel(kWidth / 2 - 1, 7)] = a[pixel(kWidth / 2, 7)];
  const HitDifference difference = compare_hits(a, b, kWidth);
  EXPECT_EQ(difference.count(HitChange::kSilhouette), 1u);
  EXPECT_EQ(judge(difference), "");
}

TEST(CompareHits, AnotherTriangleAwayFromAnEdgeIsAChangeOfVisibility) {
  const auto a = halves();
  auto b = a;
  for (uint32_t y = 0; y < 3; ++y) b[pixel(20, 10 * y + 5)] = a[pixel(kWidth - 1, 0)];
  const HitDifference difference = compare_hits(a, b, kWidth);
  EXPECT_EQ(difference.count(HitChange::kVisibility), 3u);
  // 2 in 20,000 would pass.
  EXPECT_NE(judge(difference), "");
  EXPECT_EQ(difference.worst_ray, pixel(20, 5));
  EXPECT_NE(difference.worst_text.find("primitive 1"), std::string::npos);
  EXPECT_NE(difference.worst_text.find("primitive 2"), std::string::npos);
}

TEST(CompareHits, ATiedTriangleIsASilhouetteWithoutAPictureToo) {
  const auto a = halves();
  auto b = a;
  b[3].primitive = 77;
  b[3].t = a[3].t * 1.00001f;
  EXPECT_EQ(compare_hits(a, b, 0).count(HitChange::kSilhouette), 1u);
  b[3].t = a[3].t * 1.01f;
  EXPECT_EQ(compare_hits(a, b, 0).count(HitChange::kVisibility), 1u);
}

TEST(CompareHits, TooManySilhouettesFail) {
  const auto a = halves();
  auto b = a;
  for (uint32_t y = 0; y < 100; ++y) b[pixel(kWidth / 2 - 1, y)] = a[pixel(kWidth / 2, y)];
  EXPECT_EQ(judge(compare_hits(a, b, kWidth)), "");  // 100 of 20,000: 0.5 %
  b[pixel(kWidth / 2, 50)] = a[pixel(0, 0)];
  EXPECT_NE(judge(compare_hits(a, b, kWidth)), "");
}

TEST(CompareHits, OneWrongIntegerFails) {
  const auto a = halves();
  const auto one = [&](auto change) {
    auto b = a;
    change(b[1234]);
    const HitDifference difference = compare_hits(a, b, kWidth);
    EXPECT_EQ(difference.count(HitChange::kInteger), 1u);
    EXPECT_EQ(difference.worst_ray, 1234u);
    EXPECT_NE(judge(difference), "");
  };
  one([](HitRecord& hit) { hit.record = 4; });
  one([](HitRecord& hit) { hit.kind = 0xFF; });
  one([](HitRecord& hit) { hit.instance_id = 1; });
  one([](HitRecord& hit) { hit.flags = 1; });
}

TEST(CompareHits, DistanceIsComparedAwayFromGrazing) {
  const auto a = halves();
  auto b = a;
  b[9].t *= 1.0003f;
  EXPECT_NE(judge(compare_hits(a, b, kWidth)), "");
  EXPECT_GT(compare_hits(a, b, kWidth).worst_t, 2);
  auto grazing = a;
  grazing[9].cosine = b[9].cosine = 0.01f;
  EXPECT_EQ(judge(compare_hits(grazing, b, kWidth)), "");
}

TEST(CompareHits, BarycentricsAreComparedByThePlaceThatTheyName) {
  const auto a = halves();
  auto b = a;
  b[9].barycentrics[0] = 0.01f;
  EXPECT_EQ(judge(compare_hits(a, b, kWidth)), "");
  for (size_t i = 9; i < 11; ++i) b[i].surface_point[1] = 0.01f;  // at t = 5
  EXPECT_EQ(compare_hits(a, b, kWidth).count(HitChange::kPlace), 2u);
  EXPECT_EQ(judge(compare_hits(a, b, kWidth)), "");  // 2 of 20,000: slivers
  b[11].surface_point[1] = 0.01f;
  EXPECT_NE(judge(compare_hits(a, b, kWidth)), "");
}

TEST(CompareHits, AShortDistanceIsAsGoodAsItsCoordinates) {
  auto a = halves();
  auto b = a;
  a[9].t = 1e-3f;
  b[9].t = 1e-3f + 4e-6f;  // with coordinates up to 9, four units in the last place
  EXPECT_EQ(judge(compare_hits(a, b, kWidth)), "");
  b[9].t = 1e-3f + 2e-5f;
  EXPECT_NE(judge(compare_hits(a, b, kWidth)), "");
}

TEST(CompareHits, ANumberThatIsNoneFails) {
  const auto a = halves();
  auto b = a;
  b[9].barycentrics[1] = NAN;
  EXPECT_NE(judge(compare_hits(a, b, kWidth)), "");
}

// A step at x = 100, and a slope on each side of it.
FloatImage step() {
  FloatImage image(kWidth, 100, 3);
  for (uint32_t y = 0; y < 100; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        image.at(x, y, c) = (x < 100 ? 0.1f : 0.8f) + 0.001f * static_cast<float>(y);
      }
    }
  }
  return image;
}

TEST(ComparePictures, SilhouettesAreCountedAndNotMeasured) {
  const FloatImage a = step();
  FloatImage b = a;
  for (uint32_t c = 0; c < 3; ++c) b.at(99, 30, c) = a.at(100, 30, c);
  const PictureDifference difference = compare_pictures(a, b);
  EXPECT_EQ(difference.silhouettes, 1u);
  EXPECT_TRUE(std::isinf(difference.psnr));
  EXPECT_NEAR(difference.psnr_of_all, 10 * std::log10(20000 / 0.49), 0.1);
  EXPECT_EQ(judge(difference), "");
}

TEST(ComparePictures, APixelThatNoNeighbourExplainsIsMeasured) {
  const FloatImage a = step();
  FloatImage b = a;
  for (uint32_t c = 0; c < 3; ++c) b.at(40, 30, c) = 0.9f;
  const PictureDifference difference = compare_pictures(a, b);
  EXPECT_EQ(difference.silhouettes, 0u);
  EXPECT_LT(difference.psnr, 50);
  EXPECT_EQ(difference.worst_x, 40u);
  EXPECT_EQ(difference.worst_y, 30u);
  EXPECT_NE(judge(difference), "");
}

TEST(ComparePictures, AnotherSizeFails) {
  EXPECT_NE(judge(compare_pictures(step(), FloatImage(3, 3, 3))), "");
}

TEST(CompareSums, RaysThatChangedAreCountedWhereTheSameTriangleIsSeen) {
  const FloatImage ids(kWidth, 100, 2, 5.0f);
  const FloatImage a(kWidth, 100, 1, 3.0f);
  FloatImage b = a;
  b.at(5, 5) = 1.0f;
  SumDifference difference = compare_sums(a, b, ids, ids, 4);
  EXPECT_EQ(difference.different, 2.0);
  EXPECT_EQ(difference.worst_x, 5u);
  EXPECT_EQ(judge(difference), "");  // 2 of 80,000
  for (uint32_t x = 10; x < 20; ++x) b.at(x, 50) = 2.0f;
  EXPECT_NE(judge(compare_sums(a, b, ids, ids, 4)), "");
  FloatImage other_ids = ids;
  for (uint32_t x = 10; x < 20; ++x) other_ids.at(x, 50, 1) = 6.0f;
  difference = compare_sums(a, b, ids, other_ids, 4);
  EXPECT_EQ(difference.changed, 10u);
  EXPECT_EQ(judge(difference), "");
}

TEST(CompareLayers, OneValueTooFarIsFound) {
  const FloatImage ids(kWidth, 100, 2, 5.0f);
  const FloatImage a(kWidth, 100, 4, 20.0f);
  FloatImage b = a;
  b.at(7, 8, 3) = 20.1f;
  const LayerDifference difference = compare_layers(a, b, ids, ids, 1e-3);
  EXPECT_EQ(difference.above, 1u);
  EXPECT_NEAR(difference.worst, 0.005, 1e-5);
  EXPECT_EQ(difference.worst_x, 7u);
}

}  // namespace
