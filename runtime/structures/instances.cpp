// SPDX-License-Identifier: MIT
#include "runtime/structures/instances.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/backend/errors.h"

namespace kaamos::runtime {
namespace {

constexpr uint64_t kInstanceBytes = sizeof(rtapi::RaytracingInstanceDesc);

rtapi::Error instance_error(const std::string& what) {
  return make_error(Id::kStructureSource, what);
}

rtapi::Result<std::vector<rtapi::RaytracingInstanceDesc>> read_descs(const AddressMap& addresses,
                                                                     const BuildCommand& command) {
  std::vector<rtapi::RaytracingInstanceDesc> descs(command.instance_count);
  if (command.instance_count == 0) return descs;
  const bool pointers = command.instance_layout == rtapi::ElementsLayout::kArrayOfPointers;
  const uint64_t wanted = uint64_t{command.instance_count} * (pointers ? 8 : kInstanceBytes);
  if (!addresses.contains(command.instance_descs, wanted)) {
    return instance_error(std::to_string(command.instance_count) + " instance descs " +
                          at_address(addresses, command.instance_descs) + " need " +
                          std::to_string(wanted) + " bytes, but the buffer has " +
                          std::to_string(addresses.bytes_from(command.instance_descs)) +
                          " from there on.");
  }
  if (!pointers) {
    std::memcpy(descs.data(), addresses.host(command.instance_descs), wanted);
    return descs;
  }
  const auto* each = reinterpret_cast<const uint64_t*>(addresses.host(command.instance_descs));
  for (uint32_t i = 0; i < command.instance_count; ++i) {
    if (!addresses.contains(each[i], kInstanceBytes)) {
      return instance_error("instance desc " + std::to_string(i) + " (64 bytes) is " +
                            at_address(addresses, each[i]) +
                            ", which is not inside a live buffer.");
    }
    std::memcpy(&descs[i], addresses.host(each[i]), kInstanceBytes);
  }
  return descs;
}

constexpr char kMissing[] =
    "there is no bottom level at its address, so it is inactive. Was one built, and not "
    "overwritten or freed?";

}  // namespace

const char* activate_instance(const StructureMap& structures, Instance& instance) {
  if (instance.desc.AccelerationStructure == 0) return nullptr;
  const auto structure = structures.find(instance.desc.AccelerationStructure);
  if (structure == nullptr || structure->bottom_level == nullptr) {
    return kMissing;
  }
  if (structure->bottom_level->empty()) return nullptr;
  const float* matrix = &instance.desc.Transform[0][0];
  if (!invert_transform(matrix, instance.world_to_object)) {
    return "its transform is singular or not finite, so it is inactive";
  }
  if (!world_bounds(matrix, structure->bottom_level->object_bounds(), instance.bounds)) {
    return "its bounds reach past 1.8e18, so it is inactive";
  }
  instance.bottom_level = structure->bottom_level;
  return nullptr;
}

rtapi::Result<std::vector<Instance>> read_instances(const StructureEnvironment& environment,
                                                    const BuildCommand& command) {
  auto descs = read_descs(*environment.context.addresses, command);
  if (!descs) return descs.error();
  return activate_instances(environment, command.dest, *descs, InstanceNotes::kAll);
}

std::vector<Instance> activate_instances(const StructureEnvironment& environment,
                                         uint64_t top_level,
                                         std::span<const rtapi::RaytracingInstanceDesc> descs,
                                         InstanceNotes notes) {
  std::vector<Instance> instances(descs.size());
  constexpr uint32_t kMostNotes = 8;
  uint32_t written = 0;
  for (uint32_t i = 0; i < instances.size(); ++i) {
    instances[i].desc = descs[i];
    instances[i].id = descs[i].InstanceID;
    const char* note = activate_instance(environment.structures, instances[i]);
    if (note == nullptr || (note == kMissing && notes == InstanceNotes::kMissingMayCome)) continue;
    if (written++ >= kMostNotes) continue;
    environment.warn(Id::kInstanceInactive,
                     "top level " + at_address(*environment.context.addresses, top_level) +
                         ", instance " + std::to_string(i) + ": " + note + ".");
  }
  return instances;
}

std::shared_ptr<const std::vector<rtapi::RaytracingInstanceDesc>> records_of(
    std::span<const Instance> instances) {
  auto records = std::make_shared<std::vector<rtapi::RaytracingInstanceDesc>>();
  records->reserve(instances.size());
  for (const Instance& instance : instances) records->push_back(instance.desc);
  return records;
}

bool invert_transform(const float matrix[12], float inverse[12]) {
  double m[12];
  for (int i = 0; i < 12; ++i) {
    if (!std::isfinite(matrix[i])) return false;
    m[i] = matrix[i];
  }
  const double cofactors[9] = {
      m[5] * m[10] - m[6] * m[9], m[2] * m[9] - m[1] * m[10], m[1] * m[6] - m[2] * m[5],
      m[6] * m[8] - m[4] * m[10], m[0] * m[10] - m[2] * m[8], m[2] * m[4] - m[0] * m[6],
      m[4] * m[9] - m[5] * m[8],  m[1] * m[8] - m[0] * m[9],  m[0] * m[5] - m[1] * m[4]};
  const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
  if (determinant == 0 || !std::isfinite(determinant)) return false;
  for (int row = 0; row < 3; ++row) {
    double translation = 0;
    for (int column = 0; column < 3; ++column) {
      const double value = cofactors[3 * row + column] / determinant;
      inverse[4 * row + column] = static_cast<float>(value);
      translation -= value * m[4 * column + 3];
    }
    inverse[4 * row + 3] = static_cast<float>(translation);
  }
  return std::all_of(inverse, inverse + 12, [](float v) { return std::isfinite(v); });
}

bool world_bounds(const float matrix[12], const Bounds& object, Bounds& world) {
  for (int row = 0; row < 3; ++row) {
    double low = matrix[4 * row + 3];
    double high = low;
    double magnitude = std::fabs(low);
    for (int column = 0; column < 3; ++column) {
      const double a = double{matrix[4 * row + column]} * object.lower[column];
      const double b = double{matrix[4 * row + column]} * object.upper[column];
      low += std::min(a, b);
      high += std::max(a, b);
      magnitude += std::max(std::fabs(a), std::fabs(b));
    }
    // 8 ulp of the largest term: six roundings of the transform, and two of the box test.
    const double pad = 8 * FLT_EPSILON * magnitude + 16 * FLT_MIN;
    world.lower[row] = static_cast<float>(low - pad);
    world.upper[row] = static_cast<float>(high + pad);
    if (!(std::fabs(world.lower[row]) < kLargestCoordinate) ||
        !(std::fabs(world.upper[row]) < kLargestCoordinate)) {
      return false;
    }
  }
  return true;
}

}  // namespace kaamos::runtime
