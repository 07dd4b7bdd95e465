// SPDX-License-Identifier: MIT
#include "d3d12/container/container.h"

#include <cctype>
#include <cstring>
#include <string>

#include "d3d12/com/errors.h"
#include "d3d12/container/checksum.h"

namespace kaamos::d3d12 {

namespace {

struct Header {
  uint32_t magic;
  std::array<uint32_t, 4> checksum;
  uint16_t major, minor;
  uint32_t size_bytes;
  uint32_t part_count;
};
static_assert(sizeof(Header) == 32);

struct PartHeader {
  uint32_t fourcc;
  uint32_t size_bytes;
};

constexpr uint32_t kMagic = fourcc("DXBC");
constexpr size_t kChecksumEnd = 20;

constexpr size_t align(size_t offset) {
  return (offset + 3) / 4 * 4;
}

std::string name_of(uint32_t fourcc) {
  std::string out;
  for (int i = 0; i < 4; ++i, fourcc >>= 8) {
    const char c = static_cast<char>(fourcc & 0xFF);
    out += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  }
  return "\"" + out + "\"";
}

rtapi::Error damaged(size_t offset, const std::string& what) {
  return make_error(ErrorId::kBytecode, "byte " + std::to_string(offset) +
                                            " of the container: " + what +
                                            ". Pass all bytes that the compiler or the "
                                            "serializer gave, unchanged, and their size.");
}

std::string bytes_text(uint64_t count) {
  return std::to_string(count) + " bytes";
}

}  // namespace

std::vector<std::byte> write_container(std::span<const Part> parts) {
  size_t size = sizeof(Header) + parts.size() * sizeof(uint32_t);
  std::vector<uint32_t> offsets;
  for (const Part& part : parts) {
    offsets.push_back(static_cast<uint32_t>(size));
    size = align(size + sizeof(PartHeader) + part.bytes.size());
  }
  std::vector<std::byte> out(size);
  Header header = {
      kMagic, {}, 1, 0, static_cast<uint32_t>(size), static_cast<uint32_t>(parts.size())};
  std::memcpy(out.data(), &header, sizeof(header));
  for (size_t i = 0; i < parts.size(); ++i) {
    const PartHeader part = {parts[i].fourcc, static_cast<uint32_t>(parts[i].bytes.size())};
    std::byte* place = out.data() + offsets[i];
    std::memcpy(out.data() + sizeof(Header) + i * sizeof(uint32_t), &offsets[i], sizeof(uint32_t));
    std::memcpy(place, &part, sizeof(part));
    if (part.size_bytes != 0) {
      std::memcpy(place + sizeof(part), parts[i].bytes.data(), part.size_bytes);
    }
  }
  header.checksum = container_checksum(std::span(out).subspan(kChecksumEnd));
  std::memcpy(out.data(), &header, sizeof(header));
  return out;
}

rtapi::Result<std::vector<Part>> read_container(const void* bytes, size_t size) {
  if (bytes == nullptr) return make_error(ErrorId::kBytecode, "the pointer to the bytes is null.");
  if (size < sizeof(Header)) {
    return damaged(size, "it ends here, and a container has at least 32 bytes");
  }
  const auto* data = static_cast<const std::byte*>(bytes);
  Header header;
  std::memcpy(&header, data, sizeof(header));
  if (header.magic != kMagic) {
    return damaged(0, "it begins with " + name_of(header.magic) + " instead of \"DXBC\"");
  }
  if (header.major != 1 || header.minor != 0) {
    return damaged(kChecksumEnd, "its version is " + std::to_string(header.major) + "." +
                                     std::to_string(header.minor) + " instead of 1.0");
  }
  if (header.size_bytes > size || header.size_bytes < sizeof(Header)) {
    return damaged(offsetof(Header, size_bytes), "it says that it has " +
                                                     bytes_text(header.size_bytes) + ", and " +
                                                     bytes_text(size) + " were passed");
  }
  const size_t parts_begin = sizeof(Header) + uint64_t{header.part_count} * sizeof(uint32_t);
  if (parts_begin > header.size_bytes) {
    return damaged(offsetof(Header, part_count),
                   "it says that it has " + std::to_string(header.part_count) +
                       " parts, whose offsets alone are longer than its " +
                       bytes_text(header.size_bytes));
  }
  std::vector<Part> parts;
  for (size_t i = 0; i < header.part_count; ++i) {
    const size_t entry = sizeof(Header) + i * sizeof(uint32_t);
    uint32_t offset = 0;
    std::memcpy(&offset, data + entry, sizeof(offset));
    if (offset < parts_begin || uint64_t{offset} + sizeof(PartHeader) > header.size_bytes) {
      return damaged(entry, "part " + std::to_string(i) + " is at offset " +
                                std::to_string(offset) + ", which is not between " +
                                std::to_string(parts_begin) + " and its end at " +
                                std::to_string(header.size_bytes));
    }
    PartHeader part;
    std::memcpy(&part, data + offset, sizeof(part));
    const size_t begin = size_t{offset} + sizeof(PartHeader);
    if (part.size_bytes > header.size_bytes - begin) {
      return damaged(offset + 4, "part " + name_of(part.fourcc) + " has " +
                                     bytes_text(part.size_bytes) + ", and " +
                                     bytes_text(header.size_bytes - begin) + " are left");
    }
    parts.push_back({part.fourcc, {data + begin, part.size_bytes}});
  }
  const bool is_unsigned = header.checksum == std::array<uint32_t, 4>{};
  const std::span whole(data + kChecksumEnd, header.size_bytes - kChecksumEnd);
  if (!is_unsigned && header.checksum != container_checksum(whole)) {
    return damaged(4, "the checksum is not that of the bytes behind it: a byte was changed");
  }
  return parts;
}

}  // namespace kaamos::d3d12
