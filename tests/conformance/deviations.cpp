// SPDX-License-Identifier: MIT
//
// Rules that a target breaks because of a driver fault, each with its evidence, or by design. A
// rule that passes is shown as a pass whether it has an entry or not.
#include "tests/conformance/rules.h"

namespace kaamos::conformance {

namespace {

constexpr char kEmbreesEdges[] =
    "by design: Embree's triangles may both be hit at a shared edge or vertex, or neither (fast); "
    "precision exact keeps the rule";
constexpr char kEmbreesT[] =
    "by design: Embree's default triangles round t, so that it misses the ends of an interval by "
    "an ulp; precisions robust and exact keep the rule";
// Counted by these tests. Vulkan itself lets a ray hit both triangles at a shared edge.
constexpr char kLavapipesEdges[] =
    "fault of Mesa 25.0's triangle test: edges belong to both of their triangles, so that rays "
    "that meet one exactly hit both";
constexpr char kMesa[] = "Mesa 25.0.";
// Deviations of draws, found and measured by these tests.
constexpr char kHuge[] =
    "HUGE: fault of Mesa 25.0's rasterizer: triangles that reach beyond 1e7 pixels lose coverage";
constexpr char kCutOnScreen[] =
    "NOPERSP: fault of Mesa 25.0's clipping: noperspective values are wrong or NaN on triangles "
    "that "
    "reach beyond the target";
constexpr char kNanInDepth[] =
    "NANCMP: fault of Mesa 25.0's depth test: a NaN in the depth buffer passes all comparisons but "
    "NEVER";
constexpr char kBiasWithoutDepth[] =
    "BIAS0: fault of Mesa 25.0's depth bias: without a depth buffer it is doubled, as on D24";
constexpr char kPlanes[] =
    "PLANE: fault of Mesa 25.0's setup: planes of attributes are through corners that are not "
    "rounded, in float32, so constants come out with errors up to 2^-12";
constexpr char kInterlock[] =
    "by design: Mesa 25.0 has no VK_EXT_fragment_shader_interlock; the order holds as long as a "
    "tile "
    "is one thread's";
constexpr char kNanTimesZero[] =
    "NANB: fault of Mesa 25.0's blending: a factor of zero leaves NaN out";
constexpr char kSnormBlend[] = "SNORMB: Mesa 25.0 blends SNORM wrongly, so that it is refused";

constexpr Deviation kDeviations[] = {
    {"TRV-03", "embree/fast", "", kEmbreesT},     {"TRV-70", "embree/fast", "", kEmbreesEdges},
    {"TRV-71", "embree/fast", "", kEmbreesEdges}, {"TRV-72", "embree/fast", "", kEmbreesEdges},
    {"TRV-70", "vulkan", kMesa, kLavapipesEdges}, {"TRV-71", "vulkan", kMesa, kLavapipesEdges},
    {"RAS-32", "vulkan", kMesa, kHuge},           {"RAS-33", "vulkan", kMesa, kCutOnScreen},
    {"RAS-61", "vulkan", kMesa, kNanInDepth},     {"RAS-66", "vulkan", kMesa, kBiasWithoutDepth},
    {"RAS-75", "vulkan", kMesa, kPlanes},         {"RAS-103", "vulkan", kMesa, kInterlock},
    {"RAS-124", "vulkan", kMesa, kNanTimesZero},  {"RAS-125", "vulkan", kMesa, kSnormBlend},
};

}  // namespace

const Deviation* find_deviation(std::string_view rule, std::string_view target,
                                std::string_view device_name) {
  for (const Deviation& each : kDeviations) {
    if (each.rule == rule && each.target == target &&
        device_name.find(each.driver) != std::string_view::npos) {
      return &each;
    }
  }
  return nullptr;
}

}  // namespace kaamos::conformance
