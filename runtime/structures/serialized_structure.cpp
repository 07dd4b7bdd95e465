// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_structure.h"

#include <cstring>
#include <string>

#include "runtime/structures/serialized_arrays.h"
#include "runtime/structures/serialized_frame.h"
#include "runtime/structures/serialized_objects.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;
using rtapi::RaytracingGeometryType;
using Writer = SerializedWriter;

constexpr uint32_t kOpaque = 1;
constexpr uint32_t kNoDuplicateAnyHit = 2;
constexpr uint32_t kTransformed = 4;
constexpr uint32_t kLinked = 8;

struct GeometryRecord {
  uint32_t type;
  uint32_t vertex_format;
  uint32_t index_format;
  uint32_t flags;
  uint32_t vertices;
  uint32_t primitives;
};
struct MicromapRecord {
  uint32_t level;
  uint32_t format;
};
static_assert(sizeof(GeometryRecord) == 24 && sizeof(MicromapRecord) == 8);

GeometryRecord record_of(const GeometryShape& shape) {
  GeometryRecord record;
  record.type = static_cast<uint32_t>(shape.type);
  record.vertex_format = static_cast<uint32_t>(shape.vertex_format);
  record.index_format = static_cast<uint32_t>(shape.index_format);
  record.flags = (shape.opaque ? kOpaque : 0) |
                 (shape.no_duplicate_any_hit ? kNoDuplicateAnyHit : 0) |
                 (shape.transformed ? kTransformed : 0) | (shape.linked ? kLinked : 0);
  record.vertices = shape.vertices;
  record.primitives = shape.primitives;
  return record;
}

// The addresses after the header: of the bottom levels, or of linked geometries' micromap arrays.
SerializedFrame frame_of(const AccelerationStructure& structure) {
  if (is_object(structure)) return frame_of_object(structure);
  SerializedFrame frame;
  frame.type = classic_type_of(structure);
  frame.flags = static_cast<uint32_t>(structure.flags);
  frame.size_bytes = structure.size_bytes;
  if (frame.type == Type::kOpacityMicromapArray) {
    frame.count = structure.micromaps->size();
    return frame;
  }
  if (frame.type == Type::kTopLevel) {
    frame.count = structure.instances->size();
    for (const auto& instance : *structure.instances) {
      frame.pointers.push_back(instance.AccelerationStructure);
    }
    return frame;
  }
  frame.count = structure.bottom_level->geometry_shapes().size();
  if (!structure.linkages.empty()) frame.block = rtapi::SerializedBlockType::kOpacityMicromaps;
  for (const auto& linkage : structure.linkages) {
    if (linkage != nullptr) frame.pointers.push_back(linkage->address);
  }
  return frame;
}

void put_contents(const AccelerationStructure& structure, Writer& writer) {
  if (is_object(structure)) return put_object(structure, writer);
  if (structure.micromaps != nullptr) {
    const MicromapArray& array = *structure.micromaps;
    for (uint32_t i = 0; i < array.size(); ++i) {
      writer.put(MicromapRecord{array.level(i), static_cast<uint32_t>(array.format(i))});
      writer.put_array(array.bits(i));
    }
    return;
  }
  if (structure.bottom_level == nullptr) {
    uint64_t place = 0;
    for (rtapi::RaytracingInstanceDesc instance : *structure.instances) {
      instance.AccelerationStructure = ++place;
      writer.put(instance);
    }
    return;
  }
  for (const GeometryShape& shape : structure.bottom_level->geometry_shapes()) {
    writer.put(record_of(shape));
    put_contents(structure.bottom_level->geometry_contents(shape.index), counts_of(shape),
                 linkage_of(structure, shape.index), writer);
  }
}

// Parses what follows the frame; every read is checked against the end.
class Parser {
 public:
  Parser(SerializedFrame frame, std::span<const uint8_t> contents)
      : frame_(std::move(frame)), size_(contents.size()), reader_(contents) {}
  rtapi::Result<SerializedStructure> run();

 private:
  rtapi::Status check_frame();
  rtapi::Status read_contents();
  rtapi::Status read_instances();
  rtapi::Status read_geometry(uint32_t index);
  rtapi::Status read_micromaps();

  SerializedFrame frame_;
  uint64_t size_;
  SerializedReader reader_;
  uint64_t linked_ = 0;  // geometries so far
  SerializedStructure result_;
};

rtapi::Status Parser::check_frame() {
  const bool top = frame_.type == Type::kTopLevel;
  const bool array = frame_.type == Type::kOpacityMicromapArray;
  const uint64_t most = array ? rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure
                        : top ? rtapi::kRaytracingMaxInstancesPerTopLevelAccelerationStructure
                              : rtapi::kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure;
  const uint64_t each = array ? sizeof(MicromapRecord)
                        : top ? sizeof(rtapi::RaytracingInstanceDesc)
                              : sizeof(GeometryRecord);
  const auto flags = static_cast<BuildFlags>(frame_.flags);
  const bool exclusive = rtapi::HasAny(flags, BuildFlags::kPreferFastTrace) &&
                         rtapi::HasAny(flags, BuildFlags::kPreferFastBuild);
  const bool linked = frame_.block == rtapi::SerializedBlockType::kOpacityMicromaps;
  const bool pointers_fit =
      frame_.block ? linked && !top && !array : top || frame_.pointers.empty();
  if (frame_.type > Type::kOpacityMicromapArray || frame_.count > most ||
      frame_.count > reader_.left() / each || (frame_.flags & ~0x1DFu) != 0 || exclusive ||
      !pointers_fit) {
    return serialized_error("its contents are damaged: type " +
                            std::to_string(static_cast<uint32_t>(frame_.type)) + " of " +
                            std::to_string(frame_.count) + " with build flags " +
                            std::to_string(frame_.flags));
  }
  if (frame_.size_bytes < 256 || frame_.size_bytes % 256 != 0) {
    return serialized_error("DeserializedSizeInBytes is " + std::to_string(frame_.size_bytes) +
                            "; it must be a multiple of 256");
  }
  result_.flags = flags;
  return {};
}

rtapi::Status Parser::read_instances() {
  result_.instances.resize(frame_.count);
  for (uint64_t i = 0; i < frame_.count; ++i) {
    auto& instance = result_.instances[i];
    reader_.get(instance);
    const uint64_t place = instance.AccelerationStructure;
    if (place > frame_.pointers.size()) {
      return serialized_error("instance " + std::to_string(i) + " refers to bottom level " +
                              std::to_string(place) + ", but there are only " +
                              std::to_string(frame_.pointers.size()));
    }
    instance.AccelerationStructure = place == 0 ? 0 : frame_.pointers[place - 1];
  }
  return {};
}

rtapi::Status Parser::read_micromaps() {
  auto array = std::make_shared<MicromapArray>();
  for (uint64_t i = 0; i < frame_.count; ++i) {
    MicromapRecord record;
    const bool sound = reader_.get(record) && record.level <= kMaxSubdivisionLevel &&
                       record.format >= 1 && record.format <= 2;
    const auto format = static_cast<MicromapFormat>(sound ? record.format : 1);
    const uint64_t bytes = sound ? micromap_bytes(record.level, format) : 0;
    const uint8_t* bits = reader_.take(bytes);
    if (!sound || bits == nullptr) {
      return serialized_error("micromap " + std::to_string(i) + " is damaged");
    }
    array->add(record.level, format, {bits, bytes});
  }
  result_.micromaps = std::move(array);
  return {};
}

rtapi::Status Parser::read_geometry(uint32_t index) {
  GeometryRecord record;
  const std::string where = "geometry " + std::to_string(index);
  if (!reader_.get(record)) return serialized_error(where + " is truncated");
  GeometryShape shape;
  shape.type = static_cast<RaytracingGeometryType>(record.type);
  shape.index = index;
  shape.vertex_format = static_cast<rtapi::Format>(record.vertex_format);
  shape.index_format = static_cast<rtapi::Format>(record.index_format);
  shape.opaque = (record.flags & kOpaque) != 0;
  shape.no_duplicate_any_hit = (record.flags & kNoDuplicateAnyHit) != 0;
  shape.transformed = (record.flags & kTransformed) != 0;
  shape.linked = (record.flags & kLinked) != 0;
  shape.vertices = record.vertices;
  shape.primitives = record.primitives;
  const bool boxes = shape.type == RaytracingGeometryType::kProceduralPrimitiveAabbs;
  const bool indexed = shape.index_format == rtapi::Format::kR16Uint ||
                       shape.index_format == rtapi::Format::kR32Uint;
  const bool plain = shape.index_format == rtapi::Format::kUnknown;
  bool sound =
      record.type <= 1 && record.flags < 16 && (indexed || plain) &&
      (!shape.linked || (!boxes && linked_ < frame_.pointers.size())) &&
      (index == 0 || record.type == static_cast<uint32_t>(result_.shapes[0].type)) &&
      record.primitives <= rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure;
  if (boxes) {
    sound &= plain && record.vertices == 0;
  } else if (plain) {
    sound &= record.primitives == record.vertices / 3;
  }
  if (!sound) return serialized_error(where + " is damaged");
  const uint64_t bytes = counts_of(shape).bytes();
  const uint64_t left = reader_.left();
  const uint8_t* arrays = reader_.take(bytes);
  if (arrays == nullptr) {
    return serialized_error(where + " is truncated: its arrays take " + std::to_string(bytes) +
                            " bytes, but there are only " + std::to_string(left));
  }
  result_.geometries.push_back(desc_of(shape, reinterpret_cast<uint64_t>(arrays)));
  if (shape.linked) {
    const uint64_t links = uint64_t{shape.primitives} * sizeof(int32_t);
    auto linkage = std::make_shared<MicromapLinkage>();
    linkage->address = frame_.pointers[linked_++];
    linkage->indices.resize(shape.primitives);
    if (links != 0) {
      std::memcpy(linkage->indices.data(), arrays + bytes - padded(links), links);
    }
    for (const int32_t i : linkage->indices) {
      if (i < static_cast<int32_t>(SpecialIndex::kClusterSkip))
        return serialized_error(where + " is damaged");
    }
    result_.linkages.resize(frame_.count);
    result_.linkages[index] = std::move(linkage);
  }
  result_.shapes.push_back(shape);
  return {};
}

rtapi::Status Parser::read_contents() {
  if (is_object(frame_.type)) return get_object(frame_, reader_, result_);
  if (auto s = check_frame(); !s) return s;
  if (result_.type == Type::kTopLevel) return read_instances();
  if (result_.type == Type::kOpacityMicromapArray) return read_micromaps();
  for (uint32_t i = 0; i < frame_.count; ++i) {
    if (auto s = read_geometry(i); !s) return s;
  }
  return {};
}

rtapi::Result<SerializedStructure> Parser::run() {
  result_.type = frame_.type;
  result_.size_bytes = frame_.size_bytes;
  if (auto s = read_contents(); !s) return s.error();
  if (reader_.left() != 0) {
    return serialized_error("its contents take " + std::to_string(size_ - reader_.left()) +
                            " bytes, but its header leaves " + std::to_string(size_));
  }
  return std::move(result_);
}

}  // namespace

SerializedSize serialized_size(const AccelerationStructure& structure) {
  const SerializedFrame frame = frame_of(structure);
  Writer counter;
  put_contents(structure, counter);
  return {frame.bytes() + counter.bytes(), frame.pointers_or_blocks()};
}

void serialize(const AccelerationStructure& structure, std::span<uint8_t> out) {
  Writer writer(out);
  put_frame(frame_of(structure), out.size(), writer);
  put_contents(structure, writer);
  seal_serialized(out);
}

rtapi::Result<SerializedStructure> parse_serialized(std::span<const uint8_t> bytes) {
  std::span<const uint8_t> contents;
  auto frame = parse_frame(bytes, contents);
  if (!frame) return frame.error();
  return Parser(*std::move(frame), contents).run();
}

}  // namespace kaamos::runtime
