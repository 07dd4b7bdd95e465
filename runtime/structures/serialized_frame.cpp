// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_frame.h"

#include "runtime/structures/serialized_identifier.h"
#include "runtime/structures/serialized_structure.h"

namespace kaamos::runtime {
namespace {

using Block = rtapi::SerializedRaytracingAccelerationStructureBlock;

// Where the header counts blocks instead of bottom levels: its upper half.
// [DXR: D3D12_SERIALIZED_RAYTRACING_ACCELERATION_STRUCTURE_HEADER1]
constexpr uint64_t kBlocks = uint64_t{0xFFFFFFFF} << 32;

struct PayloadHeader {
  uint64_t checksum;
  uint32_t type;
  uint32_t flags;
  uint64_t count;
};
static_assert(sizeof(PayloadHeader) == 24);

uint64_t checksum_of(std::span<const uint8_t> bytes, const SerializedHeader& header,
                     uint64_t payload) {
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

// Where the addresses are, and how many.
struct Extent {
  std::optional<rtapi::SerializedBlockType> block;
  uint64_t pointers_at = sizeof(SerializedHeader);
  uint64_t count = 0;
  uint64_t payload_at() const { return pointers_at + count * 8; }
};

// False: it does not fit; extent.count then says what was read.
bool read_extent(std::span<const uint8_t> bytes, const SerializedHeader& header, Extent& extent) {
  extent.count = header.NumBottomLevelAccelerationStructurePointersAfterHeader;
  if (extent.count == (kBlocks | 1) && bytes.size() >= extent.pointers_at + sizeof(Block)) {
    Block block;
    std::memcpy(&block, &bytes[extent.pointers_at], sizeof(block));
    extent.pointers_at += sizeof(block);
    extent.count = block.NumBlockPointersAfterHeader;
    extent.block = block.Type;
    if (block.Type > rtapi::SerializedBlockType::kClusterLevel) return false;
  }
  const uint64_t least = extent.pointers_at + sizeof(PayloadHeader);
  return bytes.size() % 8 == 0 && bytes.size() >= least &&
         extent.count <= (bytes.size() - least) / 8;
}

rtapi::Status check_header(std::span<const uint8_t> bytes, SerializedHeader& header) {
  using Match = rtapi::DriverMatchingIdentifierStatus;
  if (bytes.size() < sizeof(header)) {
    return serialized_error("its header takes 56 bytes, but there are only " +
                            std::to_string(bytes.size()));
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  const Match match = check_identifier(rtapi::SerializedDataType::kRaytracingAccelerationStructure,
                                       header.DriverMatchingIdentifier);
  if (match == Match::kUnrecognized) {
    return serialized_error(
        "its identifier is that of another driver. Call CheckDriverMatchingIdentifier first");
  }
  if (match != Match::kCompatibleWithDevice) {
    return serialized_error("it is not of version " + std::to_string(kSerializedVersion) +
                            ". Call CheckDriverMatchingIdentifier first, and build anew");
  }
  const uint64_t size = header.SerializedSizeInBytesIncludingHeader;
  if (size > bytes.size()) {
    return serialized_error("it is truncated: its header says " + std::to_string(size) +
                            " bytes, but its buffer ends after " + std::to_string(bytes.size()));
  }
  return {};
}

}  // namespace

rtapi::Error serialized_error(const std::string& what) {
  return make_error(Id::kSerializedData, what + ".");
}

uint64_t SerializedFrame::bytes() const {
  return sizeof(SerializedHeader) + (block ? sizeof(Block) : 0) + pointers.size() * 8 +
         sizeof(PayloadHeader);
}

void put_frame(const SerializedFrame& frame, uint64_t all_bytes, SerializedWriter& writer) {
  SerializedHeader header;
  header.DriverMatchingIdentifier = serialized_identifier();
  header.SerializedSizeInBytesIncludingHeader = all_bytes;
  header.DeserializedSizeInBytes = frame.size_bytes;
  header.NumBottomLevelAccelerationStructurePointersAfterHeader =
      frame.block ? kBlocks | 1 : frame.pointers.size();
  writer.put(header);
  if (frame.block) writer.put(Block{*frame.block, frame.pointers.size()});
  writer.put_array(frame.pointers);
  writer.put(PayloadHeader{0, static_cast<uint32_t>(frame.type), frame.flags, frame.count});
}

rtapi::Result<SerializedFrame> parse_frame(std::span<const uint8_t> bytes,
                                           std::span<const uint8_t>& contents) {
  SerializedHeader header;
  if (auto s = check_header(bytes, header); !s) return s.error();
  bytes = bytes.first(header.SerializedSizeInBytesIncludingHeader);
  Extent extent;
  if (!read_extent(bytes, header, extent)) {
    return serialized_error("its header is damaged: " + std::to_string(bytes.size()) +
                            " bytes with " + std::to_string(extent.count) +
                            " addresses of what it refers to");
  }
  const uint64_t begin = extent.payload_at();
  PayloadHeader payload;
  std::memcpy(&payload, &bytes[begin], sizeof(payload));
  if (payload.checksum != checksum_of(bytes, header, begin)) {
    return serialized_error(
        "its checksum does not match: it is damaged, or more than the addresses after its header "
        "was changed");
  }
  SerializedFrame frame;
  frame.type = static_cast<rtapi::RaytracingAccelerationStructureType>(payload.type);
  frame.flags = payload.flags;
  frame.count = payload.count;
  frame.size_bytes = header.DeserializedSizeInBytes;
  frame.block = extent.block;
  frame.pointers.resize(extent.count);
  if (extent.count != 0) {
    std::memcpy(frame.pointers.data(), &bytes[extent.pointers_at], extent.count * 8);
  }
  contents = bytes.subspan(begin + sizeof(payload));
  return frame;
}

void seal_serialized(std::span<uint8_t> bytes) {
  SerializedHeader header;
  if (bytes.size() < sizeof(header)) return;
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.SerializedSizeInBytesIncludingHeader > bytes.size()) return;
  bytes = bytes.first(header.SerializedSizeInBytesIncludingHeader);
  Extent extent;
  if (!read_extent(bytes, header, extent)) return;
  const uint64_t checksum = checksum_of(bytes, header, extent.payload_at());
  std::memcpy(&bytes[extent.payload_at()], &checksum, sizeof(checksum));
}

}  // namespace kaamos::runtime
