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

constexpr Deviation kDeviations[] = {
    {"TRV-03", "embree/fast", "", kEmbreesT},     {"TRV-70", "embree/fast", "", kEmbreesEdges},
    {"TRV-71", "embree/fast", "", kEmbreesEdges}, {"TRV-72", "embree/fast", "", kEmbreesEdges},
    {"TRV-70", "vulkan", kMesa, kLavapipesEdges}, {"TRV-71", "vulkan", kMesa, kLavapipesEdges},
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
