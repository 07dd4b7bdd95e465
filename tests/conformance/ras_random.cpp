// SPDX-License-Identifier: MIT
//
// Random triangles against exact arithmetic, and a closed mesh. KAAMOS_FULL=1: fifty times as many.
#include <shaders/ras_random.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/conformance/ras_reference.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 64;     // pixels
constexpr uint32_t kSlices = 200;  // triangles of a draw
constexpr uint32_t kTexel = 16;    // bytes

uint32_t triangles_per_setting() {
  const char* full = std::getenv("KAAMOS_FULL");
  return full != nullptr && std::string_view(full) == "1" ? 100000 : 2000;
}

// The values that a pixel got: z, a value, the value without perspective, 1 if it was drawn.
struct Drawn {
  float z, value, on_screen, covered;
};

class Slices {
 public:
  explicit Slices(Context& t)
      : screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, kSide, 1), context_(t) {
    TextureDesc desc = screen.colors[0].GetDesc();
    desc.DepthOrArraySize = kSlices;
    texture_ = t.device().CreateTexture(desc).value();
    t.device().CreateRenderTargetView(texture_, screen.rtv()).value();
    screen.library = kaamos_shaders_ras_random();
    GraphicsPipelineStateDesc pipeline = screen.desc("Pass", "DepthAndValues");
    pipeline.VS = screen.shader("ToOwnSlice");
    pipeline_ = screen.make(pipeline);
    BufferDesc readback = {.SizeInBytes = uint64_t{kSide} * kSide * kTexel * kSlices,
                           .Heap = HeapType::kReadback};
    readback_ = t.device().CreateBuffer(readback).value();
  }

  // Draws up to kSlices triangles.
  void draw(const std::vector<Corner>& corners) {
    CommandList list = context_.device().CreateCommandList().value();
    list.ClearRenderTargetView(screen.rtv(), screen.clear_color.data());
    screen.begin(list);
    screen.draw(list, pipeline_, corners);
    list.ResourceBarrier(ResourceBarrier::Transition(texture_, ResourceStates::kRenderTarget,
                                                     ResourceStates::kCopySource));
    PlacedSubresourceFootprint place;
    place.Footprint = {Format::kR32G32B32A32Float, kSide, kSide, 1, kSide * kTexel};
    for (uint32_t slice = 0; slice < kSlices; ++slice) {
      place.Offset = uint64_t{slice} * kSide * kSide * kTexel;
      list.CopyTextureRegion({readback_, place}, 0, 0, 0, {texture_, slice});
    }
    list.ResourceBarrier(ResourceBarrier::Transition(texture_, ResourceStates::kCopySource,
                                                     ResourceStates::kRenderTarget));
    list.Close().value();
    context_.queue().ExecuteAndWait(list).value();
  }
  const Drawn& at(uint32_t slice, uint32_t x, uint32_t y) const {
    return readback_.data<Drawn>()[(size_t{slice} * kSide + y) * kSide + x];
  }

  Screen screen;

 private:
  Context& context_;
  Texture texture_;
  PipelineState pipeline_;
  Buffer readback_;
};

struct Totals {
  uint64_t covered = 0, wrong = 0, z = 0, value = 0, on_screen = 0;
  std::string first = {};  // of the pixels that differ
};

// Fails with counts where the setting has differences.
void report(Context& t, const std::string& what, const Totals& totals) {
  t.holds(what + ": " + std::to_string(totals.covered) + " px are covered",
          totals.covered > triangles_per_setting() / 4);
  t.equal(what + ": px whose coverage differs", totals.wrong, 0u);
  t.equal(what + ": px whose depth is out of bounds", totals.z, 0u);
  t.equal(what + ": px whose linear value is out of bounds", totals.value, 0u);
  t.equal(what + ": px whose value without perspective is out of bounds", totals.on_screen, 0u);
  if (!totals.first.empty()) t.fail(what + ": first " + totals.first);
}

bool is_vulkan(const Context& t) {
  return t.target().backend == "vulkan";
}

// Compares one triangle that is all before the eye. Values without perspective on triangles that a
// driver cuts at the target's border have a test of their own.
void compare(const ExactTriangle& exact, const Slices& slices, uint32_t slice, bool vulkan,
             Totals& totals, bool with_cut_values = false) {
  const auto differs = [&](const char* what, uint32_t x, uint32_t y, float found,
                           long double expected, long double bound) {
    if (std::abs(static_cast<long double>(found) - expected) <= bound) return 0u;
    if (totals.first.empty()) {
      totals.first = std::string(what) + " at (" + std::to_string(x) + ", " + std::to_string(y) +
                     "): " + std::to_string(found) + ", expected " + std::to_string(expected) +
                     " +- " + std::to_string(bound) + " of " + exact.text();
    }
    return 1u;
  };
  // A driver that cuts triangles at the target's border rounds the new corners, which moves edges
  // a little. [RAS-54]
  const bool may_be_cut = vulkan && !exact.is_in_target();
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const Drawn& found = slices.at(slice, x, y);
      const bool covered = exact.covers(x, y);
      totals.covered += covered ? 1 : 0;
      if (covered != (found.covered == 1) &&
          !(may_be_cut && exact.distance_to_edges(x, y) <= 1.0L / 64)) {
        ++totals.wrong;
        differs("coverage", x, y, found.covered, covered ? 1 : 0, 0);
      }
      if (!covered || found.covered != 1) continue;
      const ExactTriangle::Bounds bounds = exact.bounds(x, y, vulkan);
      totals.z += differs("depth", x, y, found.z, exact.depth(x, y), bounds.depth);
      totals.value +=
          differs("linear value", x, y, found.value, exact.value(x, y, true), bounds.value);
      if (may_be_cut && !with_cut_values) continue;
      totals.on_screen += differs("value without perspective", x, y, found.on_screen,
                                  exact.value(x, y, false), bounds.on_screen);
    }
  }
}

void whole_triangles(Context& t) {
  Slices slices(t);
  std::mt19937 random(54);
  const std::pair<GridKind, const char*> kinds[] = {{GridKind::kSmall, "small"},
                                                    {GridKind::kMedium, "medium"},
                                                    {GridKind::kHuge, "huge"},
                                                    {GridKind::kSliver, "slivers"},
                                                    {GridKind::kCenters, "corners at centres"}};
  for (const auto& [kind, name] : kinds) {
    Totals totals;
    for (uint32_t first = 0; first < triangles_per_setting(); first += kSlices) {
      const auto corners = grid_triangles(slices.screen, kind, kSlices, random);
      slices.draw(corners);
      for (uint32_t i = 0; i < kSlices; ++i) {
        compare(ExactTriangle(slices.screen, &corners[size_t{i} * 3]), slices, i, is_vulkan(t),
                totals);
      }
    }
    report(t, name, totals);
  }
}

void values_of_cut_triangles(Context& t) {
  Slices slices(t);
  std::mt19937 random(33);
  Totals totals;
  for (uint32_t first = 0; first < triangles_per_setting(); first += kSlices) {
    const auto corners = grid_triangles(slices.screen, GridKind::kHuge, kSlices, random);
    slices.draw(corners);
    for (uint32_t i = 0; i < kSlices; ++i) {
      compare(ExactTriangle(slices.screen, &corners[size_t{i} * 3]), slices, i, is_vulkan(t),
              totals, true);
    }
  }
  report(t, "beyond the target", totals);
}

// Triangles of which parts may be behind the eye, nearer or farther than is drawn.
void cut_triangles(Context& t) {
  Slices slices(t);
  std::mt19937 random(28);
  Totals totals;
  uint64_t unsure = 0;
  for (uint32_t first = 0; first < triangles_per_setting(); first += kSlices) {
    const auto corners = eye_triangles(kSlices, random);
    slices.draw(corners);
    for (uint32_t i = 0; i < kSlices; ++i) {
      const ProjectedTriangle exact(kSide, &corners[size_t{i} * 3]);
      for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
          const Drawn& found = slices.at(i, x, y);
          const ProjectedTriangle::Pixel pixel = exact.at(x, y);
          totals.covered += pixel.inside ? 1 : 0;
          if (pixel.near_border) {
            ++unsure;
            continue;
          }
          totals.wrong += pixel.inside != (found.covered == 1) ? 1 : 0;
          if (!pixel.inside || found.covered != 1) continue;
          totals.z += std::abs(found.z - pixel.depth) <= pixel.depth_bound ? 0 : 1;
          totals.value += std::abs(found.value - pixel.value) <= pixel.value_bound ? 0 : 1;
        }
      }
    }
  }
  report(t, "behind the eye", totals);
  t.holds("few are near a border: " + std::to_string(unsure), unsure * 20 < totals.covered);
}

// Triangles with NaN or infinity beside whole ones.
void not_finite(Context& t) {
  constexpr float kNot[] = {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()};
  Slices slices(t);
  std::mt19937 random(30);
  Totals totals;
  uint64_t of_dropped = 0;
  for (uint32_t first = 0; first < triangles_per_setting(); first += kSlices) {
    auto corners = grid_triangles(slices.screen, GridKind::kMedium, kSlices, random);
    std::vector<bool> dropped(kSlices);
    for (uint32_t i = 0; i < kSlices; ++i) {
      dropped[i] = random() % 2 == 0;
      // Infinity may be drawn; the CPU backend drops it. [RAS-31]
      const size_t kinds = is_vulkan(t) ? 1 : 3;
      if (dropped[i]) {
        corners[i * 3 + random() % 3].position[random() % 4] = kNot[random() % kinds];
      }
    }
    slices.draw(corners);
    for (uint32_t i = 0; i < kSlices; ++i) {
      if (!dropped[i]) {
        compare(ExactTriangle(slices.screen, &corners[size_t{i} * 3]), slices, i, is_vulkan(t),
                totals);
        continue;
      }
      for (uint32_t place = 0; place < kSide * kSide; ++place) {
        of_dropped += slices.at(i, place % kSide, place / kSide).covered != 0 ? 1 : 0;
      }
    }
  }
  report(t, "beside them", totals);
  t.equal("px of triangles with NaN or infinity", of_dropped, 0u);
}

void a_closed_mesh(Context& t) {
  constexpr uint32_t kRings = 388;  // 301,088 triangles
  Screen screen(t, {Format::kR32G32Float}, Format::kUnknown, 512);
  screen.library = kaamos_shaders_ras_random();
  GraphicsPipelineStateDesc desc = screen.desc("Sphere", "Windings");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline, {.number = kRings});
    list.DrawInstanced(kRings * kRings * 6, 1, 0, 0);
  });
  t.equal("px with more fronts than backs, or less",
          screen.differing<float>([](uint32_t, uint32_t) { return 0.0f; }, 0), 0u);
  const uint32_t twice =
      screen.count([&](uint32_t x, uint32_t y) { return screen.texel<float>(x, y, 1) == 2; });
  const uint32_t more =
      screen.count([&](uint32_t x, uint32_t y) { return screen.texel<float>(x, y, 1) > 2; });
  t.holds("covered by one front and one back: " + std::to_string(twice), twice > 80000);
  // At its border the mesh may be folded by rounding.
  t.holds("covered more often: " + std::to_string(more), more < 200);
}

}  // namespace

std::vector<RuleTest> ras_random_tests() {
  return {{"RAS-54, RAS-70", whole_triangles, "*"},
          {"RAS-33", values_of_cut_triangles, "*"},
          {"RAS-28", cut_triangles, "*"},
          {"RAS-30", not_finite, "*"},
          {"RAS-50", a_closed_mesh, "*"}};
}

}  // namespace kaamos::conformance
