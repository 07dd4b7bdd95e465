// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/checks.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/backend/backend.h"

namespace kaamos::vulkan {
namespace {

using shader::spirv::CheckEntry;
using shader::spirv::CheckState;
using shader::spirv::kCheckEntries;
using shader::spirv::kReachedEntries;
using shader::spirv::ReachedEntry;

constexpr uint64_t kEntriesAt = 64;
constexpr uint64_t kReachedAt = kEntriesAt + kCheckEntries * sizeof(CheckEntry);
constexpr uint64_t kRangesAt = kReachedAt + kReachedEntries * sizeof(ReachedEntry);

bool is_checked(const DispatchEnvironment& environment) {
  return environment.context != nullptr && environment.context->reporter != nullptr;
}

}  // namespace

rtapi::Result<uint64_t> begin_checks(const DispatchEnvironment& environment,
                                     uint32_t max_recursion_depth) {
  if (!is_checked(environment)) return uint64_t{0};
  const auto ranges = environment.context->addresses->ranges();
  const uint64_t range_bytes = ranges.size() * sizeof(shader::AddressRange);
  auto buffer = environment.checks->get(environment.stream->gpu(), kRangesAt + range_bytes + 16);
  if (!buffer) return buffer.error();
  const uint64_t address = (*buffer)->address();
  uint8_t* host = (*buffer)->host();
  const CheckState state = {
      address + kRangesAt, address + kEntriesAt, static_cast<uint32_t>(ranges.size()),
      max_recursion_depth, address + kReachedAt, 0};
  std::memset(host, 0, kRangesAt);
  std::memcpy(host, &state, sizeof(state));
  if (range_bytes != 0) std::memcpy(host + kRangesAt, ranges.data(), range_bytes);
  return address;
}

std::vector<runtime::ReachedFrom> tell_checks(const DispatchEnvironment& environment,
                                              std::span<const runtime::LinkedShader* const> shaders,
                                              checks::CodePlace place) {
  std::vector<runtime::ReachedFrom> out;
  if (!is_checked(environment)) return out;
  auto buffer = environment.checks->get(environment.stream->gpu(), kRangesAt);
  if (!buffer) return out;
  for (uint32_t i = 0; i < kCheckEntries; ++i) {
    CheckEntry entry;
    std::memcpy(&entry, (*buffer)->host() + kEntriesAt + i * sizeof(entry), sizeof(entry));
    if (entry.key == 0 || entry.report.finding == shader::Finding::kNone) continue;
    const uint32_t shader = entry.shader - 1;
    place.shader = shader < shaders.size() ? shaders[shader] : nullptr;
    std::copy_n(entry.index, 3, place.index);
    checks::report_finding(*environment.context->reporter, *environment.context->addresses, place,
                           entry.report, std::max(entry.count, 1u));
  }
  for (uint32_t i = 0; i < kReachedEntries; ++i) {
    ReachedEntry entry;
    std::memcpy(&entry, (*buffer)->host() + kReachedAt + i * sizeof(entry), sizeof(entry));
    if (entry.key == 0 || entry.shader - 1 >= shaders.size()) continue;
    out.push_back({shaders[entry.shader - 1], entry.call});
  }
  return out;
}

runtime::MissingRecords missing_records(const DispatchEnvironment& environment) {
  runtime::MissingRecords out;
  if (!is_checked(environment)) return out;
  auto buffer = environment.checks->get(environment.stream->gpu(), kRangesAt);
  if (!buffer) return out;
  CheckState state;
  std::memcpy(&state, (*buffer)->host(), sizeof(state));
  const auto add = [&](runtime::RecordKind kind, uint32_t by) {
    const bool missing = (state.ran_nothing & by) != 0;
    out.past_the_end[static_cast<size_t>(kind)] = missing;
    out.unknown[static_cast<size_t>(kind)] = missing;
  };
  add(runtime::RecordKind::kHitGroup, shader::spirv::kRayRanNothing);
  add(runtime::RecordKind::kMiss, shader::spirv::kRayRanNothing);
  add(runtime::RecordKind::kCallable, shader::spirv::kCallRanNothing);
  return out;
}

}  // namespace kaamos::vulkan
