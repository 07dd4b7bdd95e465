// SPDX-License-Identifier: MIT
#include "runtime/backend/dispatch_checks.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <rtapi/types.h>

namespace kaamos::runtime {
namespace {

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

DispatchProblem check_table(const AddressMap& addresses, const char* name,
                            const rtapi::GpuVirtualAddressRangeAndStride& table) {
  if (table.StartAddress % rtapi::kRaytracingShaderTableByteAlignment != 0) {
    return {DispatchFault::kTableLayout,
            text(name, " starts at ", describe_address(addresses, table.StartAddress),
                 "; it must be a multiple of 64")};
  }
  if (table.StrideInBytes % rtapi::kRaytracingShaderRecordByteAlignment != 0 ||
      table.StrideInBytes > rtapi::kRaytracingMaxShaderRecordStride) {
    return {DispatchFault::kTableLayout, text(name, " has a stride of ", table.StrideInBytes,
                                              " bytes; it must be a multiple of 32, at most 4096")};
  }
  if (table.StartAddress != 0 && table.SizeInBytes != 0 &&
      !addresses.contains(table.StartAddress, table.SizeInBytes)) {
    return {DispatchFault::kTableMemory, text(name, ": ", table.SizeInBytes, " bytes at ",
                                              describe_address(addresses, table.StartAddress),
                                              " are not inside one live buffer")};
  }
  return {};
}

}  // namespace

std::string describe_address(const AddressMap& addresses, uint64_t address) {
  if (address == 0) return "address 0";
  const auto allocation = addresses.find(address);
  if (!allocation) {
    return text("address 0x", std::hex, address, ", which is in no live buffer");
  }
  const std::string buffer =
      allocation->name.empty() ? "unnamed buffer" : text("buffer \"", allocation->name, "\"");
  return text("byte ", address - allocation->address, " of ", buffer, " (", allocation->size_bytes,
              " bytes)");
}

std::string at_address(const AddressMap& addresses, uint64_t address) {
  return "at " + describe_address(addresses, address);
}

DispatchProblem check_dispatch_rays(const AddressMap& addresses,
                                    const rtapi::DispatchRaysDesc& desc) {
  const auto& raygen = desc.RayGenerationShaderRecord;
  if (raygen.StartAddress == 0 || raygen.SizeInBytes < rtapi::kShaderIdentifierSizeInBytes) {
    return {
        DispatchFault::kTableLayout,
        text("RayGenerationShaderRecord has ", raygen.SizeInBytes, " bytes at ",
             describe_address(addresses, raygen.StartAddress), "; a record has at least 32 bytes")};
  }
  const std::pair<const char*, rtapi::GpuVirtualAddressRangeAndStride> tables[] = {
      {"RayGenerationShaderRecord", {raygen.StartAddress, raygen.SizeInBytes, 0}},
      {"MissShaderTable", desc.MissShaderTable},
      {"HitGroupTable", desc.HitGroupTable},
      {"CallableShaderTable", desc.CallableShaderTable}};
  for (const auto& [name, table] : tables) {
    DispatchProblem problem = check_table(addresses, name, table);
    if (problem.fault != DispatchFault::kNone) return problem;
  }
  // 2^30 threads in all; the first two factors cannot overflow 64 bits.
  const uint64_t plane = uint64_t{desc.Width} * desc.Height;
  if (desc.Depth != 0 && plane > rtapi::kRaytracingMaxRayGenerationShaderThreads / desc.Depth) {
    return {DispatchFault::kTooLarge, text("DispatchRays of ", desc.Width, "x", desc.Height, "x",
                                           desc.Depth, "; at most 2^30 threads are allowed")};
  }
  return {};
}

DispatchProblem check_dispatch(const uint32_t groups[3]) {
  if (*std::max_element(groups, groups + 3) <= rtapi::kCsDispatchMaxThreadGroupsPerDimension) {
    return {};
  }
  return {DispatchFault::kTooLarge, text("Dispatch of ", groups[0], "x", groups[1], "x", groups[2],
                                         " groups; at most 65535 are allowed on each axis")};
}

}  // namespace kaamos::runtime
