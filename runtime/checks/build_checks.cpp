// SPDX-License-Identifier: MIT
#include "runtime/checks/build_checks.h"

#include <cmath>
#include <cstring>
#include <string>

#include "runtime/checks/names.h"
#include "runtime/structures/build_inputs.h"

namespace kaamos::checks {
namespace {

using rtapi::RaytracingGeometryDesc;
using rtapi::RaytracingGeometryType;

uint64_t mix(uint64_t hash, uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  return hash ^ (hash >> 29);
}

std::string geometry_name(const runtime::BuildCommand& command, uint32_t index,
                          const ProofInputs& inputs) {
  return "geometry " + std::to_string(index) + " of the bottom level at " +
         address_name(inputs.addresses, command.dest);
}

// Looks for the first index that is past the vertices.
void check_indices(const ProofInputs& inputs, const std::string& where,
                   const RaytracingGeometryDesc& desc, const RaytracingGeometryDesc& host,
                   GeometryContents& contents) {
  const auto& t = host.Triangles;
  if (t.IndexFormat == rtapi::Format::kUnknown) return;
  const bool wide = t.IndexFormat == rtapi::Format::kR32Uint;
  const auto* bytes = reinterpret_cast<const uint8_t*>(t.IndexBuffer);
  const uint32_t count = t.IndexCount / 3 * 3;
  uint32_t bad = 0;
  uint32_t first = 0;
  uint32_t first_value = 0;
  contents.indices = 1;
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t value = 0;
    std::memcpy(&value, bytes + size_t{i} * (wide ? 4 : 2), wide ? 4 : 2);
    contents.indices = mix(contents.indices, value);
    if (value < t.VertexCount) continue;
    if (bad++ == 0) {
      first = i;
      first_value = value;
    }
  }
  if (bad == 0) return;
  inputs.reporter.report(
      Id::kIndexOutOfRange,
      where + ": index " + std::to_string(first_value) + " of triangle " +
          std::to_string(first / 3) + " (element " + std::to_string(first) + " of the indices at " +
          address_name(inputs.addresses, desc.Triangles.IndexBuffer) + "), but VertexCount is " +
          std::to_string(t.VertexCount) +
          (bad > 1 ? "; there are " + std::to_string(bad) + " such indices" : "") +
          ". Their triangles are never hit. Check that VertexCount is the number of vertices and "
          "IndexFormat that of the buffer.");
}

void check_vertices(const ProofInputs& inputs, const std::string& where,
                    const RaytracingGeometryDesc& desc, const RaytracingGeometryDesc& host,
                    GeometryContents& contents) {
  const uint32_t count = host.Triangles.VertexCount;
  std::vector<float> xyz(size_t{count} * 3);
  RaytracingGeometryDesc plain = host;
  plain.Triangles.Transform3x4 = 0;  // it is applied to what was read
  if (count != 0) runtime::decode_vertices(plain.Triangles, xyz.data());
  contents.active = 1;
  for (uint32_t i = 0; i < count; ++i) {
    const float* p = xyz.data() + size_t{i} * 3;
    if (std::isnan(p[0])) {
      contents.active = mix(contents.active, i);
      continue;
    }
    if (!std::isnan(p[1]) && !std::isnan(p[2])) continue;
    inputs.reporter.report(
        Id::kVertexNotANumber,
        where + ": vertex " + std::to_string(i) + " (" +
            address_name(inputs.addresses, desc.Triangles.VertexBuffer.StartAddress) + " + " +
            std::to_string(i) + " * " + std::to_string(desc.Triangles.VertexBuffer.StrideInBytes) +
            ") has NaN in Y or Z but a number in X. Its triangles are treated as inactive here; "
            "DXR defines that only for NaN in X. Write NaN to X, or numbers to all three.");
    return;
  }
}

void check_boxes(const ProofInputs& inputs, const std::string& where,
                 const RaytracingGeometryDesc& host, GeometryContents& contents) {
  contents.active = 1;
  for (uint64_t i = 0; i < host.AABBs.AABBCount; ++i) {
    rtapi::RaytracingAabb box;
    std::memcpy(&box,
                reinterpret_cast<const uint8_t*>(host.AABBs.AABBs.StartAddress) +
                    i * host.AABBs.AABBs.StrideInBytes,
                sizeof box);
    if (std::isnan(box.MinX)) {
      contents.active = mix(contents.active, i);
      continue;
    }
    const float others[] = {box.MinY, box.MinZ, box.MaxX, box.MaxY, box.MaxZ};
    for (const float value : others) {
      if (!std::isnan(value)) continue;
      inputs.reporter.report(
          Id::kVertexNotANumber,
          where + ": box " + std::to_string(i) +
              " has NaN in a component other than MinX. It is treated as inactive "
              "here; DXR defines that only for NaN in MinX.");
      return;
    }
  }
}

bool overlap(uint64_t a, uint64_t a_bytes, uint64_t b, uint64_t b_bytes) {
  return a < b + b_bytes && b < a + a_bytes;
}

}  // namespace

std::vector<GeometryContents> check_geometries(const ProofInputs& inputs,
                                               const runtime::BuildCommand& command) {
  std::vector<GeometryContents> out(command.geometries.size());
  for (uint32_t i = 0; i < command.geometries.size(); ++i) {
    const RaytracingGeometryDesc& desc = command.geometries[i];
    // The build itself fails where inputs lie outside of memory.
    if (!runtime::check_inputs(desc, i, inputs.addresses)) continue;
    const RaytracingGeometryDesc host = runtime::as_host_sees(desc, inputs.addresses);
    const std::string where = geometry_name(command, i, inputs);
    if (desc.Type == RaytracingGeometryType::kTriangles) {
      check_indices(inputs, where, desc, host, out[i]);
      check_vertices(inputs, where, desc, host, out[i]);
    } else {
      check_boxes(inputs, where, host, out[i]);
    }
  }
  return out;
}

void check_instances(const ProofInputs& inputs,
                     const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  bool flags_told = false;
  bool level_told = false;
  for (uint32_t i = 0; i < instances.size(); ++i) {
    const auto& instance = instances[i];
    const std::string where = "instance " + std::to_string(i);
    if ((instance.Flags & 12) == 12 && !flags_told) {
      flags_told = true;
      inputs.reporter.report(
          Id::kInstanceFlags,
          where + " has both kForceOpaque and kForceNonOpaque. Set at most one.");
    }
    if (instance.AccelerationStructure == 0 || level_told) continue;
    StructureState state;
    const TrackedStructure* level = inputs.structures.find(instance.AccelerationStructure, state);
    const bool alive = state == StructureState::kAlive;
    if (alive && !level->top) continue;
    level_told = true;
    inputs.reporter.report(
        Id::kInstanceStructure,
        where + " refers to " + address_name(inputs.addresses, instance.AccelerationStructure) +
            ": " +
            (alive ? std::string("it is a top level")
                   : "a bottom level " +
                         inputs.structures.history(instance.AccelerationStructure, state)) +
            ". The instance is never hit. Write the address of a bottom level that is built, or "
            "0.");
  }
}

void check_update_contents(const ProofInputs& inputs, const runtime::BuildCommand& command,
                           const std::vector<GeometryContents>& contents) {
  if (!rtapi::HasAny(command.flags, runtime::BuildFlags::kPerformUpdate)) return;
  StructureState state;
  const TrackedStructure* source = inputs.structures.find(command.source, state);
  if (source == nullptr || state != StructureState::kAlive) return;
  if (source->contents.size() != contents.size()) return;  // the update itself fails on this
  for (uint32_t i = 0; i < contents.size(); ++i) {
    const bool indices = contents[i].indices != source->contents[i].indices;
    const bool active = contents[i].active != source->contents[i].active;
    if (!indices && !active) continue;
    inputs.reporter.report(
        Id::kUpdateChanges,
        "geometry " + std::to_string(i) + " of the update of " +
            address_name(inputs.addresses, command.source) + " has different " +
            (indices ? "indices" : "inactive vertices or boxes (NaN in X)") +
            " from its build. An update may only move vertices and boxes; build anew.");
    return;
  }
}

void check_ranges(const ProofInputs& inputs, const runtime::BuildCommand& command,
                  uint64_t dest_bytes, uint64_t scratch_bytes) {
  const auto report = [&](const std::string& text) {
    inputs.reporter.report(Id::kMemoryOverlap, text);
  };
  if (overlap(command.dest, dest_bytes, command.scratch, scratch_bytes)) {
    report("scratch (" + range_name(inputs.addresses, command.scratch, scratch_bytes) +
           ") overlaps the destination (" + range_name(inputs.addresses, command.dest, dest_bytes) +
           "). Give each memory of its own.");
  }
  if (command.source != 0 && command.source != command.dest &&
      overlap(command.dest, dest_bytes, command.source, dest_bytes)) {
    report("source " + address_name(inputs.addresses, command.source) + " and destination " +
           address_name(inputs.addresses, command.dest) + " of the update, " +
           std::to_string(dest_bytes) +
           " bytes each, overlap in part. Update in place, or into memory of its own.");
  }
}

}  // namespace kaamos::checks
