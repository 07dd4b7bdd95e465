// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_structure.h"

#include <cstring>
#include <string>

#include "runtime/backend/errors.h"
#include "runtime/structures/serialized_identifier.h"

namespace kaamos::runtime {
namespace {

using Header = rtapi::SerializedRaytracingAccelerationStructureHeader;
using Type = rtapi::RaytracingAccelerationStructureType;
using rtapi::RaytracingGeometryType;

constexpr uint32_t kOpaque = 1;
constexpr uint32_t kNoDuplicateAnyHit = 2;
constexpr uint32_t kTransformed = 4;
constexpr uint32_t kLinked = 8;

// Where the header counts blocks instead of bottom levels: its upper half.
// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER1]
constexpr uint64_t kBlocks = uint64_t{0xFFFFFFFF} << 32;
using Block = rtapi::SerializedRaytracingAccelerationStructureBlock;

struct PayloadHeader {
  uint64_t checksum;
  uint32_t type;  // Type
  uint32_t flags;
  uint64_t count;  // geometries or instances
};
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
static_assert(sizeof(PayloadHeader) == 24 && sizeof(GeometryRecord) == 24 &&
              sizeof(MicromapRecord) == 8);

constexpr uint64_t kLinkedDescBytes = sizeof(rtapi::RaytracingGeometryTrianglesDesc) +
                                      sizeof(rtapi::RaytracingGeometryOmmLinkageDesc);

uint64_t padded(uint64_t bytes) {
  return (bytes + 7) / 8 * 8;
}

// Counts that follow from the shape alone, so that damaged counts cannot contradict each other.
struct ArrayCounts {
  uint64_t floats = 0;
  uint64_t indices = 0;
  uint64_t boxes = 0;
  uint64_t links = 0;
  uint64_t bytes() const {
    return padded(floats * 4) + padded(indices * 4) + boxes * sizeof(rtapi::RaytracingAabb) +
           padded(links * 4);
  }
};
ArrayCounts counts_of(const GeometryShape& shape) {
  ArrayCounts counts;
  if (shape.type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    counts.boxes = shape.primitives;
  } else if (shape.vertices != 0 && shape.primitives != 0) {
    counts.floats = 3 * uint64_t{shape.vertices};
    if (shape.index_format != rtapi::Format::kUnknown) {
      counts.indices = 3 * uint64_t{shape.primitives};
    }
  }
  if (shape.linked) counts.links = shape.primitives;
  return counts;
}

class Writer {
 public:
  explicit Writer(std::span<uint8_t> out) : at_(out.data()) {}
  void put(const void* data, uint64_t bytes) {
    if (bytes != 0) std::memcpy(at_, data, bytes);
    std::memset(at_ + bytes, 0, padded(bytes) - bytes);
    at_ += padded(bytes);
  }
  template <typename T>
  void put(const T& value) {
    put(&value, sizeof(value));
  }
  template <typename T>
  void put_array(std::span<const T> values) {
    put(values.data(), values.size_bytes());
  }
  // `linkage` may be null where nothing is linked.
  void put_contents(const GeometryContents& contents, const ArrayCounts& counts,
                    const MicromapLinkage* linkage) {
    put_array(contents.xyz.first(counts.floats));
    put_array(contents.indices.first(counts.indices));
    put_array(contents.boxes.first(counts.boxes));
    if (linkage != nullptr) put_array(std::span<const int32_t>(linkage->indices));
  }

 private:
  uint8_t* at_;
};

uint64_t checksum_of(std::span<const uint8_t> bytes, const Header& header, uint64_t payload) {
  uint64_t sum = 0xCBF29CE484222325;
  const auto add = [&sum](uint64_t word) {
    // A bijection of each word, so that a change of a single word is always detected.
    sum = (sum ^ word) * 0x9E3779B97F4A7C15;
    sum ^= sum >> 32;
  };
  add(header.SerializedSizeInBytesIncludingHeader);
  add(header.DeserializedSizeInBytes);
  add(header.NumBottomLevelAccelerationStructurePointersAfterHeader);
  for (uint64_t at = payload + sizeof(uint64_t); at + 8 <= bytes.size(); at += 8) {
    uint64_t word;
    std::memcpy(&word, &bytes[at], sizeof(word));
    add(word);
  }
  return sum;
}

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

rtapi::RaytracingGeometryFlags flags_of(const GeometryShape& shape) {
  auto flags = rtapi::RaytracingGeometryFlags::kNone;
  if (shape.opaque) flags = flags | rtapi::RaytracingGeometryFlags::kOpaque;
  if (shape.no_duplicate_any_hit) {
    flags = flags | rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  }
  return flags;
}

// A desc of the arrays that follow each other from `address` on.
rtapi::RaytracingGeometryDesc desc_of(const GeometryShape& shape, uint64_t address) {
  const ArrayCounts counts = counts_of(shape);
  rtapi::RaytracingGeometryDesc desc;
  desc.Type = shape.type;
  desc.Flags = flags_of(shape);
  if (shape.type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    desc.AABBs = {counts.boxes, {counts.boxes == 0 ? 0 : address, sizeof(rtapi::RaytracingAabb)}};
    return desc;
  }
  auto& triangles = desc.Triangles;
  triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  triangles.VertexCount = counts.floats == 0 ? 0 : shape.vertices;
  triangles.VertexBuffer = {counts.floats == 0 ? 0 : address, 12};
  if (counts.indices != 0) {
    triangles.IndexFormat = rtapi::Format::kR32Uint;
    triangles.IndexCount = static_cast<uint32_t>(counts.indices);
    triangles.IndexBuffer = address + padded(counts.floats * 4);
  }
  return desc;
}

// Parses the bytes; every read is checked against their end.
Type type_of(const AccelerationStructure& structure) {
  if (structure.micromaps != nullptr) return Type::kOpacityMicromapArray;
  return structure.bottom_level != nullptr ? Type::kBottomLevel : Type::kTopLevel;
}

const MicromapLinkage* linkage_of(const AccelerationStructure& structure, uint32_t geometry) {
  return structure.linkages.empty() ? nullptr : structure.linkages[geometry].get();
}

// The addresses after the header: of the bottom levels, or of linked geometries' micromap arrays.
std::vector<uint64_t> pointers_of(const AccelerationStructure& structure) {
  std::vector<uint64_t> pointers;
  if (structure.instances != nullptr) {
    for (const auto& instance : *structure.instances) {
      pointers.push_back(instance.AccelerationStructure);
    }
  }
  for (const auto& linkage : structure.linkages) {
    if (linkage != nullptr) pointers.push_back(linkage->address);
  }
  return pointers;
}

class Parser {
 public:
  explicit Parser(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  rtapi::Result<SerializedStructure> run();

 private:
  static rtapi::Error error(const std::string& what) {
    return make_error(Id::kSerializedData, what + ".");
  }
  template <typename T>
  bool get(T& value) {
    if (bytes_.size() - at_ < sizeof(T)) return false;
    std::memcpy(&value, &bytes_[at_], sizeof(T));
    at_ += sizeof(T);
    return true;
  }
  rtapi::Status read_header();
  rtapi::Status read_payload_header();
  rtapi::Status read_instances();
  rtapi::Status read_geometry(uint32_t index);
  rtapi::Status read_micromaps();

  std::span<const uint8_t> bytes_;
  uint64_t at_ = 0;
  Header header_;
  PayloadHeader payload_ = {};
  std::vector<uint64_t> pointers_;
  bool has_block_ = false;
  uint64_t linked_ = 0;  // geometries so far
  SerializedStructure result_;
};

rtapi::Status Parser::read_header() {
  using Match = rtapi::DriverMatchingIdentifierStatus;
  if (!get(header_)) {
    return error("its header takes 56 bytes, but there are only " + std::to_string(bytes_.size()));
  }
  const Match match = check_identifier(rtapi::SerializedDataType::kRaytracingAccelerationStructure,
                                       header_.DriverMatchingIdentifier);
  if (match == Match::kUnrecognized) {
    return error(
        "its identifier is that of another driver. Call CheckDriverMatchingIdentifier first");
  }
  if (match != Match::kCompatibleWithDevice) {
    return error("it is not of version " + std::to_string(kSerializedVersion) +
                 ". Call CheckDriverMatchingIdentifier first, and build anew");
  }
  const uint64_t size = header_.SerializedSizeInBytesIncludingHeader;
  if (size > bytes_.size()) {
    return error("it is truncated: its header says " + std::to_string(size) +
                 " bytes, but its buffer ends after " + std::to_string(bytes_.size()));
  }
  uint64_t count = header_.NumBottomLevelAccelerationStructurePointersAfterHeader;
  uint64_t begin = sizeof(Header);
  if ((count & kBlocks) == kBlocks && size <= bytes_.size() &&
      size >= sizeof(Header) + sizeof(Block) && count == (kBlocks | 1)) {
    Block block;
    get(block);
    begin += sizeof(block);
    has_block_ = block.Type == rtapi::SerializedBlockType::kOpacityMicromaps;
    count = has_block_ ? block.NumBlockPointersAfterHeader : UINT64_MAX;
  }
  if (size % 8 != 0 || size < begin + sizeof(PayloadHeader) ||
      count > (size - begin - sizeof(PayloadHeader)) / 8) {
    return error("its header is damaged: " + std::to_string(size) + " bytes with " +
                 std::to_string(count) + " addresses of bottom levels");
  }
  bytes_ = bytes_.first(size);
  pointers_.resize(count);
  if (count != 0) std::memcpy(pointers_.data(), &bytes_[at_], count * 8);
  at_ += count * 8;
  return {};
}

rtapi::Status Parser::read_payload_header() {
  const uint64_t begin = at_;
  get(payload_);
  if (payload_.checksum != checksum_of(bytes_, header_, begin)) {
    return error(
        "its checksum does not match: it is damaged, or more than the addresses of bottom levels "
        "was changed");
  }
  const bool top = payload_.type == static_cast<uint32_t>(Type::kTopLevel);
  const bool array = payload_.type == static_cast<uint32_t>(Type::kOpacityMicromapArray);
  const uint64_t most = array ? rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure
                        : top ? rtapi::kRaytracingMaxInstancesPerTopLevelAccelerationStructure
                              : rtapi::kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure;
  const uint64_t each = array ? sizeof(MicromapRecord)
                        : top ? sizeof(rtapi::RaytracingInstanceDesc)
                              : sizeof(GeometryRecord);
  const auto flags = static_cast<BuildFlags>(payload_.flags);
  const bool exclusive = rtapi::HasAny(flags, BuildFlags::kPreferFastTrace) &&
                         rtapi::HasAny(flags, BuildFlags::kPreferFastBuild);
  const bool pointers_fit = has_block_ ? !top && !array : top || pointers_.empty();
  if (payload_.type > static_cast<uint32_t>(Type::kOpacityMicromapArray) || payload_.count > most ||
      payload_.count > (bytes_.size() - at_) / each || (payload_.flags & ~0x1DFu) != 0 ||
      exclusive || !pointers_fit) {
    return error("its contents are damaged: type " + std::to_string(payload_.type) + " of " +
                 std::to_string(payload_.count) + " with build flags " +
                 std::to_string(payload_.flags));
  }
  if (header_.DeserializedSizeInBytes < 256 || header_.DeserializedSizeInBytes % 256 != 0) {
    return error("DeserializedSizeInBytes is " + std::to_string(header_.DeserializedSizeInBytes) +
                 "; it must be a multiple of 256");
  }
  result_.type = static_cast<Type>(payload_.type);
  result_.flags = flags;
  result_.size_bytes = header_.DeserializedSizeInBytes;
  return {};
}

rtapi::Status Parser::read_instances() {
  result_.instances.resize(payload_.count);
  for (uint64_t i = 0; i < payload_.count; ++i) {
    auto& instance = result_.instances[i];
    get(instance);
    const uint64_t place = instance.AccelerationStructure;
    if (place > pointers_.size()) {
      return error("instance " + std::to_string(i) + " refers to bottom level " +
                   std::to_string(place) + ", but there are only " +
                   std::to_string(pointers_.size()));
    }
    instance.AccelerationStructure = place == 0 ? 0 : pointers_[place - 1];
  }
  return {};
}

rtapi::Status Parser::read_micromaps() {
  auto array = std::make_shared<MicromapArray>();
  for (uint64_t i = 0; i < payload_.count; ++i) {
    MicromapRecord record;
    const auto has = [&](uint64_t bytes) { return bytes <= bytes_.size() - at_; };
    const bool sound = get(record) && record.level <= kMaxSubdivisionLevel && record.format >= 1 &&
                       record.format <= 2;
    const auto format = static_cast<MicromapFormat>(sound ? record.format : 1);
    const uint64_t bytes = sound ? micromap_bytes(record.level, format) : 0;
    if (!sound || !has(padded(bytes))) {
      return error("micromap " + std::to_string(i) + " is damaged");
    }
    array->add(record.level, format, bytes_.subspan(at_, bytes));
    at_ += padded(bytes);
  }
  result_.micromaps = std::move(array);
  return {};
}

rtapi::Status Parser::read_geometry(uint32_t index) {
  GeometryRecord record;
  const std::string where = "geometry " + std::to_string(index);
  if (!get(record)) return error(where + " is truncated");
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
      (!shape.linked || (!boxes && linked_ < pointers_.size())) &&
      (index == 0 || record.type == static_cast<uint32_t>(result_.shapes[0].type)) &&
      record.primitives <= rtapi::kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure;
  if (boxes) {
    sound &= plain && record.vertices == 0;
  } else if (plain) {
    sound &= record.primitives == record.vertices / 3;
  }
  if (!sound) return error(where + " is damaged");
  const uint64_t bytes = counts_of(shape).bytes();
  if (bytes > bytes_.size() - at_) {
    return error(where + " is truncated: its arrays take " + std::to_string(bytes) +
                 " bytes, but there are only " + std::to_string(bytes_.size() - at_));
  }
  result_.geometries.push_back(desc_of(shape, reinterpret_cast<uint64_t>(bytes_.data() + at_)));
  if (shape.linked) {
    const uint64_t links = uint64_t{shape.primitives} * sizeof(int32_t);
    auto linkage = std::make_shared<MicromapLinkage>();
    linkage->address = pointers_[linked_++];
    linkage->indices.resize(shape.primitives);
    if (links != 0) {
      std::memcpy(linkage->indices.data(), &bytes_[at_ + bytes - padded(links)], links);
    }
    for (const int32_t i : linkage->indices) {
      if (i < static_cast<int32_t>(SpecialIndex::kClusterSkip)) return error(where + " is damaged");
    }
    result_.linkages.resize(payload_.count);
    result_.linkages[index] = std::move(linkage);
  }
  result_.shapes.push_back(shape);
  at_ += bytes;
  return {};
}

rtapi::Result<SerializedStructure> Parser::run() {
  if (auto s = read_header(); !s) return s.error();
  if (auto s = read_payload_header(); !s) return s.error();
  if (result_.type == Type::kTopLevel) {
    if (auto s = read_instances(); !s) return s.error();
  } else if (result_.type == Type::kOpacityMicromapArray) {
    if (auto s = read_micromaps(); !s) return s.error();
  } else {
    for (uint32_t i = 0; i < payload_.count; ++i) {
      if (auto s = read_geometry(i); !s) return s.error();
    }
  }
  if (at_ != bytes_.size()) {
    return error("its contents take " + std::to_string(at_) + " bytes, but its header says " +
                 std::to_string(bytes_.size()));
  }
  return std::move(result_);
}

}  // namespace

SerializedSize serialized_size(const AccelerationStructure& structure) {
  SerializedSize size;
  size.bytes = sizeof(Header) + sizeof(PayloadHeader);
  if (structure.micromaps != nullptr) {
    const MicromapArray& array = *structure.micromaps;
    for (uint32_t i = 0; i < array.size(); ++i) {
      size.bytes += sizeof(MicromapRecord) + padded(array.bits(i).size());
    }
    return size;
  }
  if (!structure.linkages.empty()) {
    size.pointers = 1;
    size.bytes += sizeof(Block) + pointers_of(structure).size() * 8;
  }
  if (structure.bottom_level == nullptr) {
    size.pointers = structure.instances->size();
    size.bytes += size.pointers * (8 + sizeof(rtapi::RaytracingInstanceDesc));
    return size;
  }
  for (const GeometryShape& shape : structure.bottom_level->geometry_shapes()) {
    size.bytes += sizeof(GeometryRecord) + counts_of(shape).bytes();
  }
  return size;
}

void serialize(const AccelerationStructure& structure, std::span<uint8_t> out) {
  const Type type = type_of(structure);
  const std::vector<uint64_t> pointers = pointers_of(structure);
  const bool has_block = !structure.linkages.empty();
  std::vector<GeometryShape> shapes;
  if (type == Type::kBottomLevel) shapes = structure.bottom_level->geometry_shapes();
  Header header;
  header.DriverMatchingIdentifier = serialized_identifier();
  header.SerializedSizeInBytesIncludingHeader = out.size();
  header.DeserializedSizeInBytes = structure.size_bytes;
  header.NumBottomLevelAccelerationStructurePointersAfterHeader =
      has_block ? kBlocks | 1 : pointers.size();
  PayloadHeader payload = {};
  payload.type = static_cast<uint32_t>(type);
  payload.flags = static_cast<uint32_t>(structure.flags);
  payload.count = type == Type::kTopLevel      ? structure.instances->size()
                  : type == Type::kBottomLevel ? shapes.size()
                                               : structure.micromaps->size();
  Writer writer(out);
  writer.put(header);
  if (has_block) {
    writer.put(Block{rtapi::SerializedBlockType::kOpacityMicromaps, pointers.size()});
  }
  writer.put_array(std::span<const uint64_t>(pointers));
  writer.put(payload);
  if (type == Type::kTopLevel) {
    uint64_t place = 0;
    for (rtapi::RaytracingInstanceDesc instance : *structure.instances) {
      instance.AccelerationStructure = ++place;
      writer.put(instance);
    }
  }
  for (const GeometryShape& shape : shapes) {
    writer.put(record_of(shape));
    writer.put_contents(structure.bottom_level->geometry_contents(shape.index), counts_of(shape),
                        linkage_of(structure, shape.index));
  }
  for (uint32_t i = 0; type == Type::kOpacityMicromapArray && i < payload.count; ++i) {
    const MicromapArray& array = *structure.micromaps;
    writer.put(MicromapRecord{array.level(i), static_cast<uint32_t>(array.format(i))});
    writer.put_array(array.bits(i));
  }
  seal_serialized(out);
}

rtapi::Result<SerializedStructure> parse_serialized(std::span<const uint8_t> bytes) {
  return Parser(bytes).run();
}

void seal_serialized(std::span<uint8_t> bytes) {
  Header header;
  if (bytes.size() < sizeof(header) + sizeof(PayloadHeader)) return;
  std::memcpy(&header, bytes.data(), sizeof(header));
  const uint64_t size = header.SerializedSizeInBytesIncludingHeader;
  uint64_t count = header.NumBottomLevelAccelerationStructurePointersAfterHeader;
  uint64_t begin = sizeof(header);
  if (count == (kBlocks | 1)) {
    Block block;
    if (bytes.size() < begin + sizeof(block)) return;
    std::memcpy(&block, &bytes[begin], sizeof(block));
    begin += sizeof(block);
    count = block.NumBlockPointersAfterHeader;
  }
  if (size > bytes.size() || size < begin + sizeof(PayloadHeader) ||
      count > (size - begin - sizeof(PayloadHeader)) / 8) {
    return;
  }
  const uint64_t payload = begin + count * 8;
  const uint64_t checksum = checksum_of(bytes.first(size), header, payload);
  std::memcpy(&bytes[payload], &checksum, sizeof(checksum));
}

uint64_t decoded_size(const AccelerationStructure& structure) {
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

namespace {

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

void decode_for_tools(const AccelerationStructure& structure, uint64_t address,
                      std::span<uint8_t> out) {
  Writer writer(out);
  rtapi::BuildRaytracingAccelerationStructureToolsVisualizationHeader header;
  header.Type = type_of(structure);
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
    writer.put_contents(structure.bottom_level->geometry_contents(shape.index), counts_of(shape),
                        linkage_of(structure, shape.index));
  }
}

}  // namespace kaamos::runtime
