// SPDX-License-Identifier: MIT
// Reads and writes volumes as files.
#include <cstring>
#include <type_traits>

#include "effects/assets/common/checksum.h"
#include "effects/assets/common/file.h"
#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

namespace {

constexpr char kMagic[8] = {'K', 'A', 'A', 'M', 'O', 'S', 'G', 'I'};
constexpr std::uint32_t kVersion = 3;  // 1 had no levels, 2 no light that materials mirror

struct Header {
  char magic[8];
  std::uint32_t version;
  float cell;
  double origin[3];
  std::uint32_t bricks[3];
  std::uint32_t padding;
  std::uint64_t brick_count;
  std::uint64_t cell_count;
  std::uint64_t checksum;  // of everything after the header
};
static_assert(sizeof(Header) == 80);

std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

template <class T>
void append(std::vector<std::uint8_t>& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* begin = reinterpret_cast<const std::uint8_t*>(values.data());
  bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(T));
}

Error damaged(const std::string& path, const std::string& what) {
  return make_error(ErrorId::kVolume, "\"" + path + "\": " + what + "; bake it again");
}

}  // namespace

Status save_volume(const std::string& path, const IndirectVolume& volume) {
  std::vector<std::uint8_t> bytes(sizeof(Header));
  append(bytes, volume.brick_starts);
  append(bytes, volume.cells);
  Header header = {};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.cell = volume.cell;
  for (int axis = 0; axis < 3; ++axis) {
    header.origin[axis] = volume.origin[axis];
    header.bricks[axis] = volume.bricks[axis];
  }
  header.brick_count = volume.brick_starts.size();
  header.cell_count = volume.cells.size();
  header.checksum = checksum(std::span(bytes).subspan(sizeof(Header)));
  std::memcpy(bytes.data(), &header, sizeof(header));
  return write_file(path, bytes);
}

Result<IndirectVolume> load_volume(const std::string& path) {
  const auto read = read_file(path);
  if (!read.ok()) return read.error();
  const std::vector<std::uint8_t>& bytes = read.value();
  Header header;
  if (bytes.size() < sizeof(header)) {
    return damaged(path, "it has " + std::to_string(bytes.size()) + " bytes, less than a header");
  }
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) {
    return damaged(path, "it begins with other letters than KAAMOSGI");
  }
  if (header.version != kVersion) {
    return damaged(path, "its version is " + std::to_string(header.version) +
                             ", this program reads " + std::to_string(kVersion));
  }
  const std::uint64_t body = bytes.size() - sizeof(header);
  if (header.brick_count > body / 4 || header.cell_count > body / sizeof(VolumeCell) ||
      header.brick_count * 4 + header.cell_count * sizeof(VolumeCell) != body) {
    return damaged(path, "it has " + std::to_string(body) +
                             " bytes behind its header, not those of " +
                             std::to_string(header.brick_count) + " bricks and " +
                             std::to_string(header.cell_count) + " cells");
  }
  if (header.checksum != checksum(std::span(bytes).subspan(sizeof(header)))) {
    return damaged(path, "its checksum is another one");
  }
  IndirectVolume volume;
  volume.cell = header.cell;
  for (int axis = 0; axis < 3; ++axis) {
    volume.origin[axis] = header.origin[axis];
    volume.bricks[axis] = header.bricks[axis];
  }
  const std::uint64_t grid = std::uint64_t{header.bricks[0]} * header.bricks[1] * header.bricks[2];
  if (grid != header.brick_count || !(header.cell > 0)) {
    return damaged(path, "its grid does not have the size that it says");
  }
  volume.brick_starts.resize(header.brick_count);
  volume.cells.resize(header.cell_count);
  const std::uint8_t* at = bytes.data() + sizeof(header);
  if (header.brick_count != 0) std::memcpy(volume.brick_starts.data(), at, header.brick_count * 4);
  if (header.cell_count != 0) {
    std::memcpy(volume.cells.data(), at + header.brick_count * 4,
                header.cell_count * sizeof(VolumeCell));
  }
  for (const std::uint32_t entry : volume.brick_starts) {
    if (entry == kNoBrick) continue;
    if (std::uint64_t{brick_start(entry)} + kCellsPerBrick > header.cell_count) {
      return damaged(path, "a brick starts at cell " + std::to_string(brick_start(entry)) + " of " +
                               std::to_string(header.cell_count));
    }
    if (brick_level(entry) > kMaxBrickLevel) {
      return damaged(path, "a brick has level " + std::to_string(brick_level(entry)) + ", " +
                               std::to_string(kMaxBrickLevel) + " is the coarsest");
    }
  }
  return volume;
}

}  // namespace kaamos::effects
