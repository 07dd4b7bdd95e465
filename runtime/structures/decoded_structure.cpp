// SPDX-License-Identifier: MIT
//
// What kVisualizationDecodeForTools gives.
#include <cstring>
#include <string>

#include "runtime/structures/serialized_arrays.h"
#include "runtime/structures/serialized_objects.h"
#include "runtime/structures/serialized_structure.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;
using Writer = SerializedWriter;
using rtapi::RaytracingGeometryType;

constexpr uint64_t kLinkedDescBytes = sizeof(rtapi::RaytracingGeometryTrianglesDesc) +
                                      sizeof(rtapi::RaytracingGeometryOmmLinkageDesc);

// A histogram with an entry for each micromap, which says the same as a shorter one.
void decode_micromaps(const MicromapArray& array, uint64_t address, Writer& writer) {
  std::vector<rtapi::RaytracingOpacityMicromapHistogramEntry> histogram;
  std::vector<rtapi::RaytracingOpacityMicromapDesc> descs;
  std::vector<uint8_t> bits;
  for (uint32_t i = 0; i < array.size(); ++i) {
    const auto format = static_cast<uint16_t>(array.format(i));
    const auto level = array.level(i);
    histogram.push_back({1, level, static_cast<rtapi::RaytracingOpacityMicromapFormat>(format)});
    descs.push_back({static_cast<uint32_t>(bits.size()), static_cast<uint16_t>(level), format});
    bits.insert(bits.end(), array.bits(i).begin(), array.bits(i).end());
  }
  rtapi::RaytracingOpacityMicromapArrayDesc desc;
  desc.NumOmmHistogramEntries = array.size();
  address += sizeof(desc);
  desc.pOmmHistogram =
      reinterpret_cast<const rtapi::RaytracingOpacityMicromapHistogramEntry*>(address);
  address += padded(histogram.size() * sizeof(histogram[0]));
  desc.PerOmmDescs = {address, sizeof(descs[0])};
  desc.InputBuffer = address + descs.size() * sizeof(descs[0]);
  writer.put(desc);
  writer.put_array(std::span<const rtapi::RaytracingOpacityMicromapHistogramEntry>(histogram));
  writer.put_array(std::span<const rtapi::RaytracingOpacityMicromapDesc>(descs));
  writer.put_array(std::span<const uint8_t>(bits));
}

// The two descs of a linked geometry. `arrays` is where its arrays go.
void decode_linkage(const GeometryShape& shape, const MicromapLinkage& linkage, uint64_t arrays,
                    Writer& writer) {
  writer.put(desc_of(shape, arrays).Triangles);
  rtapi::RaytracingGeometryOmmLinkageDesc desc;
  desc.OpacityMicromapIndexFormat = rtapi::Format::kR32Uint;
  const ArrayCounts counts = counts_of(shape);
  desc.OpacityMicromapIndexBuffer = {arrays + counts.bytes() - padded(counts.links * 4), 4};
  desc.OpacityMicromapArray = linkage.address;
  writer.put(desc);
}

}  // namespace

uint64_t decoded_size(const AccelerationStructure& structure) {
  if (is_object(structure)) return decoded_object(structure, 0).size();
  uint64_t bytes = sizeof(rtapi::BuildRaytracingAccelerationStructureToolsVisualizationHeader);
  if (structure.micromaps != nullptr) {
    const MicromapArray& array = *structure.micromaps;
    bytes += sizeof(rtapi::RaytracingOpacityMicromapArrayDesc);
    bytes += padded(array.size() * sizeof(rtapi::RaytracingOpacityMicromapHistogramEntry));
    bytes += array.size() * sizeof(rtapi::RaytracingOpacityMicromapDesc);
    for (uint32_t i = 0; i < array.size(); ++i) bytes += array.bits(i).size();
    return padded(bytes);
  }
  if (structure.bottom_level == nullptr) {
    return bytes + structure.instances->size() * sizeof(rtapi::RaytracingInstanceDesc);
  }
  for (const GeometryShape& shape : structure.bottom_level->geometry_shapes()) {
    bytes += sizeof(rtapi::RaytracingGeometryDesc) + counts_of(shape).bytes();
    if (shape.linked) bytes += kLinkedDescBytes;
  }
  return bytes;
}

void decode_for_tools(const AccelerationStructure& structure, uint64_t address,
                      std::span<uint8_t> out) {
  Writer writer(out);
  if (is_object(structure)) return writer.put_array(decoded_object(structure, address));
  rtapi::BuildRaytracingAccelerationStructureToolsVisualizationHeader header;
  header.Type = classic_type_of(structure);
  if (header.Type == Type::kOpacityMicromapArray) {
    header.NumDescs = 1;
    writer.put(header);
    return decode_micromaps(*structure.micromaps, address + sizeof(header), writer);
  }
  if (header.Type == Type::kTopLevel) {
    header.NumDescs = static_cast<uint32_t>(structure.instances->size());
    writer.put(header);
    writer.put_array(std::span<const rtapi::RaytracingInstanceDesc>(*structure.instances));
    return;
  }
  const auto shapes = structure.bottom_level->geometry_shapes();
  header.NumDescs = static_cast<uint32_t>(shapes.size());
  writer.put(header);
  uint64_t linked =
      address + sizeof(header) + shapes.size() * sizeof(rtapi::RaytracingGeometryDesc);
  address = linked;
  for (const GeometryShape& shape : shapes) address += shape.linked ? kLinkedDescBytes : 0;
  const uint64_t arrays = address;
  for (const GeometryShape& shape : shapes) {
    rtapi::RaytracingGeometryDesc desc = desc_of(shape, address);
    if (shape.linked) {
      desc.Type = RaytracingGeometryType::kOmmTriangles;
      desc.OmmTriangles = {reinterpret_cast<const rtapi::RaytracingGeometryTrianglesDesc*>(linked),
                           reinterpret_cast<const rtapi::RaytracingGeometryOmmLinkageDesc*>(
                               linked + sizeof(rtapi::RaytracingGeometryTrianglesDesc))};
      linked += kLinkedDescBytes;
    }
    writer.put(desc);
    address += counts_of(shape).bytes();
  }
  address = arrays;
  for (const GeometryShape& shape : shapes) {
    if (shape.linked) decode_linkage(shape, *linkage_of(structure, shape.index), address, writer);
    address += counts_of(shape).bytes();
  }
  for (const GeometryShape& shape : shapes) {
    put_contents(structure.bottom_level->geometry_contents(shape.index), counts_of(shape),
                 linkage_of(structure, shape.index), writer);
  }
}

}  // namespace kaamos::runtime
