// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_meshopt.h"

#ifdef KAAMOS_HAS_MESHOPT
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <utility>
#include <vector>

#include "effects/assets/gltf/gltf_error.h"
#endif

namespace kaamos::effects {

#ifndef KAAMOS_HAS_MESHOPT

bool can_read_meshopt() {
  return false;
}

Status decode_meshopt(tinygltf::Model&, std::span<const MeshoptView>) {
  return {};
}

#else

bool can_read_meshopt() {
  return true;
}

namespace {

/// The most that a byte of a stream stands for: a two-bit header says of each 16 bytes of a column
/// that they are equal. Streams of indices have at least a byte for each triangle or index.
constexpr std::size_t kMostBytesPerByte = 64;

int decode(const MeshoptView& from, std::span<const unsigned char> stream, unsigned char* to) {
  switch (from.mode) {
    case MeshoptMode::kAttributes:
      return meshopt_decodeVertexBuffer(to, from.count, from.stride, stream.data(), stream.size());
    case MeshoptMode::kTriangles:
      return meshopt_decodeIndexBuffer(to, from.count, from.stride, stream.data(), stream.size());
    case MeshoptMode::kIndices:
      return meshopt_decodeIndexSequence(to, from.count, from.stride, stream.data(), stream.size());
  }
  return -1;
}

void apply_filter(const MeshoptView& from, unsigned char* to) {
  switch (from.filter) {
    case MeshoptFilter::kNone:
      return;
    case MeshoptFilter::kOctahedral:
      return meshopt_decodeFilterOct(to, from.count, from.stride);
    case MeshoptFilter::kQuaternion:
      return meshopt_decodeFilterQuat(to, from.count, from.stride);
    case MeshoptFilter::kExponential:
      return meshopt_decodeFilterExp(to, from.count, from.stride);
  }
}

Status decode_one(tinygltf::Model& model, const MeshoptView& from) {
  const std::vector<unsigned char>& buffer =
      model.buffers[static_cast<std::size_t>(from.buffer)].data;
  if (from.offset_bytes > buffer.size() || from.size_bytes > buffer.size() - from.offset_bytes)
    return gltf_error(from.where, "spans " + std::to_string(from.size_bytes) + " bytes from byte " +
                                      std::to_string(from.offset_bytes) + " of buffer " +
                                      std::to_string(from.buffer) + ", which has " +
                                      std::to_string(buffer.size()));
  const std::size_t size = from.count * from.stride;
  if (size / kMostBytesPerByte > from.size_bytes)
    return gltf_error(from.where, "its stream is cut: it has " + std::to_string(from.size_bytes) +
                                      " bytes for " + std::to_string(size));
  std::vector<unsigned char> bytes(size);
  if (decode(from, std::span(buffer).subspan(from.offset_bytes, from.size_bytes), bytes.data()) !=
      0)
    return gltf_error(from.where, "its stream is cut or damaged");
  apply_filter(from, bytes.data());
  tinygltf::BufferView& view = model.bufferViews[from.view];
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteOffset = 0;
  view.byteLength = bytes.size();
  model.buffers.emplace_back().data = std::move(bytes);
  return {};
}

}  // namespace

Status decode_meshopt(tinygltf::Model& model, std::span<const MeshoptView> views) {
  for (const MeshoptView& view : views)
    if (const Status status = decode_one(model, view); !status.ok()) return status;
  return {};
}

#endif

}  // namespace kaamos::effects
