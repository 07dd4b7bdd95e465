// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/workarounds.h"

#include <algorithm>
#include <cctype>

#include "kaamos/shader/spirv_interface.h"

namespace kaamos::vulkan {
namespace {

constexpr VkDriverId kLavapipe = VK_DRIVER_ID_MESA_LLVMPIPE;
constexpr VkDriverId kNvidia = VK_DRIVER_ID_NVIDIA_PROPRIETARY;  // its versions are not told apart
constexpr uint32_t kFirst = 24003;   // the first Mesa whose lavapipe traces rays
constexpr uint32_t kOpen = 9999999;  // no version is known to fix it

constexpr WorkaroundInfo kTable[] = {
    {Workaround::kRestoreAttributes, "B1", kLavapipe, kFirst, kOpen, true,
     shader::spirv::kRestoreAttributes,
     "a rejected ReportHit overwrites the attributes of the hit committed before"},
    {Workaround::kOwnIntersectionStages, "B2", kLavapipe, kFirst, kOpen, true, 0,
     "hit groups that share an intersection stage all run the any-hit shader of the first"},
    {Workaround::kCopyHitBuiltins, "B3", kLavapipe, kFirst, kOpen, true,
     shader::spirv::kCopyHitBuiltins,
     "a nested trace overwrites PrimitiveIndex, InstanceID, HitKind and transforms of the caller"},
    {Workaround::kPadBoxes, "B4", kLavapipe, 25000, 25000, true, 0,
     "boxes without padding let rays at shared edges through; rewrites the driver's tree"},
    {Workaround::kFirstVertexInAddress, "B5", kLavapipe, kFirst, kOpen, true, 0,
     "firstVertex is applied twice"},
    {Workaround::kSanitizeNan, "B6", kLavapipe, kFirst, kOpen, true, 0,
     "NaN in one primitive or instance hides its neighbours"},
    {Workaround::kTrackReportedT, "B7", kLavapipe, kFirst, kOpen, true,
     shader::spirv::kTrackReportedT,
     "gl_RayTmaxEXT in an intersection shader does not follow accepted reports"},
    {Workaround::kInterleaveRows, "B11", kLavapipe, kFirst, kOpen, true,
     shader::spirv::kInterleaveRows,
     "a dispatch is cut into one contiguous piece per thread, of which some end early"},
    {Workaround::kSortPrimitives, "SORT", kLavapipe, kFirst, kOpen, true, 0,
     "the tree halves the list of primitives or instances in the order of the input"},
    {Workaround::kFilterInFloats, "FILTER", kLavapipe, kFirst, kOpen, true, 0,
     "textures of 8 bits are filtered in 8 bits; applied when its first device starts"},
    {Workaround::kBoundPayloads, "PAYLOAD", kLavapipe, kFirst, kOpen, true, 0,
     "large payloads of deeply nested traces overflow the stack of a driver's thread"},
    {Workaround::kReserveCallables, "CALLABLES", kLavapipe, kFirst, kOpen, true, 0,
     "callables nested deeper than 31 run over their memory, whatever the stack size is"},
    {Workaround::kKeepMemoryWrites, "RASUAV", kLavapipe, kFirst, kOpen, true, 0,
     "a triangle that covers a tile takes away what pixel shaders there wrote to memory before"},
    {Workaround::kHalveDepthBias, "BIAS2", kLavapipe, kFirst, kOpen, true, 0,
     "the constant depth bias is doubled on D16 and D24"},
    {Workaround::kBarycentricsStage, "BARY", kLavapipe, kFirst, kOpen, true, 0,
     "pixel shaders have no barycentrics"},
    {Workaround::kRoundTenBits, "RT10", kLavapipe, kFirst, kOpen, true, 0,
     "colours in R10G10B10A2 are multiplied by 1024 and truncated"},
    {Workaround::kRefuseSnormBlend, "SNORMB", kLavapipe, kFirst, kOpen, true, 0,
     "SNORM targets are blended wrongly"},
    {Workaround::kLimitSnorm, "SNORMC", kLavapipe, kFirst, kOpen, true, 0,
     "NaN becomes the least value of SNORM targets, and less than -1 becomes -128"},
    {Workaround::kReplaceNanDepth, "NANZ", kLavapipe, kFirst, kOpen, true, 0,
     "an SV_Depth that is not a number becomes MaxDepth"},
    {Workaround::kKeepHeap, "TRIM", kLavapipe, kFirst, kOpen, false, 0,
     "memory of tiles goes back to the system after each frame; applied when a device starts"},
    {Workaround::kLimitDepth, "DEPTH16", kNvidia, 0, kOpen, true, 0,
     "the depth of a launch is taken modulo 65536"},
};

bool lists_workaround(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    const size_t comma = list.find(',');
    const std::string_view item = list.substr(0, comma);
    if (item == name || item == "all") return true;
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  }
  return false;
}

void find_unknown(std::string_view list, std::vector<std::string>* unknown) {
  while (!list.empty()) {
    const size_t comma = list.find(',');
    const std::string_view item = list.substr(0, comma);
    const bool known = item.empty() || item == "all" ||
                       std::any_of(std::begin(kTable), std::end(kTable),
                                   [&](const WorkaroundInfo& info) { return item == info.name; });
    if (!known) unknown->emplace_back(item);
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  }
}

uint32_t number_at(std::string_view text, size_t* position) {
  uint32_t value = 0;
  while (*position < text.size() && std::isdigit(static_cast<unsigned char>(text[*position]))) {
    value = std::min(value * 10 + static_cast<uint32_t>(text[*position] - '0'), 9999u);
    ++*position;
  }
  return value;
}

}  // namespace

std::span<const WorkaroundInfo> workaround_table() {
  return kTable;
}

uint32_t driver_version(std::string_view driver_info) {
  constexpr std::string_view kMesa = "Mesa ";
  const size_t found = driver_info.find(kMesa);
  if (found == std::string_view::npos) return 0;
  size_t position = found + kMesa.size();
  const uint32_t major = number_at(driver_info, &position);
  if (position >= driver_info.size() || driver_info[position] != '.') return 0;
  ++position;
  return major * 1000 + std::min(number_at(driver_info, &position), 999u);
}

Workarounds workarounds_for(VkDriverId driver, std::string_view driver_info,
                            std::string_view disabled, std::string_view enabled,
                            std::vector<std::string>* unknown) {
  find_unknown(disabled, unknown);
  find_unknown(enabled, unknown);
  const uint32_t version = driver_version(driver_info);
  Workarounds result;
  for (const WorkaroundInfo& info : kTable) {
    if (info.driver != driver || version < info.first_version || version > info.last_version) {
      continue;
    }
    if ((info.by_default || lists_workaround(enabled, info.name)) &&
        !lists_workaround(disabled, info.name)) {
      result.insert(info);
    }
  }
  return result;
}

}  // namespace kaamos::vulkan
