// SPDX-License-Identifier: MIT
#include "runtime/structures/micromap_inputs.h"

#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/backend/errors.h"
#include "runtime/errors/text.h"
#include "runtime/structures/build_inputs.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {
namespace {

uint64_t extent(uint64_t count, uint64_t stride, uint64_t element) {
  if (count == 0) return 0;
  if (stride != 0 && count - 1 > (UINT64_MAX / 2) / stride) return UINT64_MAX;
  return (count - 1) * stride + element;
}

rtapi::Status check_range(const AddressMap& addresses, uint64_t address, uint64_t bytes,
                          const std::string& what) {
  const uint64_t available = addresses.bytes_from(address);
  if (bytes <= available) return {};
  return make_error(Id::kInputOutOfBounds, what + " at address " + errors::hex(address) + " need " +
                                               std::to_string(bytes) +
                                               " bytes, but the buffer has " +
                                               std::to_string(available) + " from there on.");
}

// Counts of what a warning names one example of.
struct Problem {
  uint64_t count = 0;
  std::string first;

  void note(const std::string& text) {
    if (count++ == 0) first = text;
  }
  void warn(const StructureEnvironment& environment, const std::string& where) const {
    if (count == 0) return;
    const std::string more = count == 1 ? "" : " (and " + std::to_string(count - 1) + " more)";
    environment.warn(Id::kMicromapUnusable,
                     where + ": " + first + more + ". Any-hit shaders decide there.");
  }
};

using Kind = std::pair<uint32_t, uint32_t>;  // level, format

std::map<Kind, uint64_t> counts_of(const MicromapInputs& inputs) {
  std::map<Kind, uint64_t> counts;
  for (const auto& entry : inputs.histogram) {
    if (entry.Count == 0) continue;
    counts[{entry.SubdivisionLevel, static_cast<uint32_t>(entry.Format)}] += entry.Count;
  }
  return counts;
}

uint32_t index_bytes(rtapi::Format format) {
  if (format == rtapi::Format::kR8Uint) return 1;
  return format == rtapi::Format::kR16Uint ? 2 : 4;
}

constexpr int64_t kLastSpecial = static_cast<int64_t>(SpecialIndex::kClusterSkip);

rtapi::Result<std::shared_ptr<MicromapLinkage>> read_linkage(
    const StructureEnvironment& environment, const BuildCommand& command, uint32_t geometry) {
  const AddressMap& addresses = *environment.context.addresses;
  const rtapi::RaytracingGeometryOmmLinkageDesc& desc = *command.linkages[geometry];
  const uint64_t triangles = primitive_count(command.geometries[geometry]);
  const std::string where = "geometry " + std::to_string(geometry) + " of the bottom level " +
                            at_address(addresses, command.dest);
  auto linkage = std::make_shared<MicromapLinkage>();
  linkage->address = desc.OpacityMicromapArray;
  linkage->indices.resize(triangles);
  const bool indexed = desc.OpacityMicromapIndexFormat != rtapi::Format::kUnknown;
  const uint32_t bytes = index_bytes(desc.OpacityMicromapIndexFormat);
  const auto& buffer = desc.OpacityMicromapIndexBuffer;
  const uint8_t* in = nullptr;
  if (indexed && triangles != 0) {
    if (auto s = check_range(addresses, buffer.StartAddress,
                             extent(triangles, buffer.StrideInBytes, bytes),
                             "geometry " + std::to_string(geometry) + ", micromap indices");
        !s) {
      return s.error();
    }
    in = addresses.host(buffer.StartAddress);
  }
  Problem missing;
  Problem skipped;
  for (uint64_t i = 0; i < triangles; ++i) {
    const int64_t index = indexed ? load_micromap_index(in + i * buffer.StrideInBytes, bytes)
                                  : static_cast<int64_t>(i);
    // The base is not added to special indices.
    const int64_t value = index < 0 ? index : index + desc.OpacityMicromapBaseLocation;
    linkage->indices[i] =
        static_cast<int32_t>(std::min<int64_t>(value, std::numeric_limits<int32_t>::max()));
    if (value == kLastSpecial) skipped.note("triangle " + std::to_string(i) + " has index -5");
    if (value >= 0 && desc.OpacityMicromapArray == 0) {
      missing.note("triangle " + std::to_string(i) + " has micromap " + std::to_string(value) +
                   ", but there is no array");
    }
  }
  missing.warn(environment, where);
  if (skipped.count != 0) {
    environment.warn(Id::kMicromapUnusable,
                     where + ": " + skipped.first +
                         ", which is for clusters. The geometry's own opacity counts there.");
  }
  const auto array = environment.structures.find(desc.OpacityMicromapArray);
  if (array == nullptr || array->micromaps == nullptr) return linkage;
  Problem past;
  for (uint64_t i = 0; i < triangles; ++i) {
    const int64_t value = linkage->indices[i];
    if (value < int64_t{array->micromaps->size()}) continue;
    past.note("triangle " + std::to_string(i) + " has micromap " + std::to_string(value) +
              ", but the array has " + std::to_string(array->micromaps->size()));
  }
  past.warn(environment, where);
  return linkage;
}

}  // namespace

int64_t load_micromap_index(const uint8_t* in, uint32_t bytes) {
  uint32_t value = 0;
  std::memcpy(&value, in, bytes);
  const int64_t all = (int64_t{1} << 8 * bytes) - 1;
  const int64_t special = static_cast<int64_t>(value) - all - 1;
  return special >= kLastSpecial ? special : value;
}

rtapi::Result<std::shared_ptr<const MicromapArray>> read_micromaps(
    const StructureEnvironment& environment, const BuildCommand& command) {
  const AddressMap& addresses = *environment.context.addresses;
  const MicromapInputs& inputs = command.micromaps;
  auto left = counts_of(inputs);
  uint64_t count = 0;
  for (const auto& [kind, of_kind] : left) count += of_kind;
  const auto& descs = inputs.descs;
  if (auto s =
          check_range(addresses, descs.StartAddress,
                      extent(count, descs.StrideInBytes, sizeof(MicromapDesc)), "micromap descs");
      !s) {
    return s.error();
  }
  const uint64_t available = addresses.bytes_from(inputs.input_buffer);
  const uint8_t* const host = available == 0 ? nullptr : addresses.host(inputs.input_buffer);
  const uint8_t* const first = count == 0 ? nullptr : addresses.host(descs.StartAddress);
  auto array = std::make_shared<MicromapArray>();
  Problem unreadable;
  Problem uncounted;
  for (uint64_t i = 0; i < count; ++i) {
    MicromapDesc desc;
    std::memcpy(&desc, first + i * descs.StrideInBytes, sizeof(desc));
    const auto format = static_cast<MicromapFormat>(desc.format);
    const std::string where = "micromap " + std::to_string(i);
    const bool known =
        desc.subdivision_level <= kMaxSubdivisionLevel &&
        (format == MicromapFormat::kTwoStates || format == MicromapFormat::kFourStates);
    const uint64_t bytes = known ? micromap_bytes(desc.subdivision_level, format) : 0;
    if (!known || desc.byte_offset > available || bytes > available - desc.byte_offset) {
      unreadable.note(!known ? where + " has subdivision level " +
                                   std::to_string(desc.subdivision_level) + " and format " +
                                   std::to_string(desc.format)
                             : where + " takes " + std::to_string(bytes) + " bytes at offset " +
                                   std::to_string(desc.byte_offset) + ", but InputBuffer has " +
                                   std::to_string(available));
      constexpr std::array<uint8_t, 1> kUnknown = {
          static_cast<uint8_t>(MicromapState::kUnknownOpaque)};
      array->add(0, MicromapFormat::kFourStates, kUnknown);
      continue;
    }
    const auto at = left.find({desc.subdivision_level, desc.format});
    if (at == left.end() || at->second == 0) {
      uncounted.note(where + " has subdivision level " + std::to_string(desc.subdivision_level) +
                     " and format " + std::to_string(desc.format) +
                     ", of which the histogram counts fewer");
    } else {
      --at->second;
    }
    array->add(desc.subdivision_level, format, {host + desc.byte_offset, bytes});
  }
  const std::string where = "the micromap array " + at_address(addresses, command.dest);
  unreadable.warn(environment, where);
  if (uncounted.count != 0)
    environment.warn(Id::kMicromapUnusable, where + ": " + uncounted.first + ".");
  return std::shared_ptr<const MicromapArray>(std::move(array));
}

rtapi::Result<std::vector<std::shared_ptr<MicromapLinkage>>> read_linkages(
    const StructureEnvironment& environment, const BuildCommand& command) {
  std::vector<std::shared_ptr<MicromapLinkage>> linkages(command.linkages.size());
  for (uint32_t i = 0; i < command.linkages.size(); ++i) {
    if (!command.linkages[i]) continue;
    auto linkage = read_linkage(environment, command, i);
    if (!linkage) return linkage.error();
    linkages[i] = *std::move(linkage);
  }
  return linkages;
}

}  // namespace kaamos::runtime
