// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_draco.h"

#ifdef KAAMOS_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_error.h"
#endif

namespace kaamos::effects {

#ifndef KAAMOS_HAS_DRACO

bool can_read_draco() {
  return false;
}

Status decode_draco(tinygltf::Model&, std::span<const DracoPrimitive>, std::vector<std::string>&) {
  return {};
}

#else

bool can_read_draco() {
  return true;
}

namespace {

/// The most triangles that a byte of a stream stands for: far more than any mesh needs, and few
/// enough that a file of 200 bytes cannot request any amount of memory.
constexpr std::size_t kMostTrianglesPerByte = 65536;

/// The sizes that the accessors of a primitive have room for.
struct Room {
  std::size_t points;
  std::size_t triangles;
};

std::string counted(std::size_t actual, const char* noun, std::size_t allowed) {
  return "its stream has " + std::to_string(actual) + " " + noun +
         ", its accessors have room for " + std::to_string(allowed);
}

/// The start of a stream, read before the decoder makes room for what it claims.
Status check_start(std::span<const std::uint8_t> bytes, const Room& room,
                   const std::string& where) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
      header.encoder_type != draco::TRIANGULAR_MESH)
    return gltf_error(where, "its stream is no Draco mesh");
  // 2.2 is the only version that the extension allows.
  if (header.version_major != 2 || header.version_minor != 2)
    return gltf_error(where, "its stream is of Draco's version " +
                                 std::to_string(header.version_major) + "." +
                                 std::to_string(header.version_minor) + ", 2.2 is supported");
  if (header.flags & METADATA_FLAG_MASK) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
      return gltf_error(where, "the metadata of its stream are damaged");
  }
  std::uint8_t traversal = 0;
  std::uint32_t triangles = 0, points = 0;
  bool is_read = false;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    is_read = buffer.Decode(&traversal) && draco::DecodeVarint(&points, &buffer) &&
              draco::DecodeVarint(&triangles, &buffer);
    points = 0;  // of the connectivity, which are fewer than those of the mesh
  } else {
    is_read = draco::DecodeVarint(&triangles, &buffer) && draco::DecodeVarint(&points, &buffer);
  }
  if (!is_read) return gltf_error(where, "its stream is cut");
  if (triangles > room.triangles)
    return gltf_error(where, counted(triangles, "triangles", room.triangles));
  if (points > room.points) return gltf_error(where, counted(points, "vertices", room.points));
  if (triangles / kMostTrianglesPerByte > bytes.size())
    return gltf_error(where, "its stream has " + std::to_string(bytes.size()) + " bytes for " +
                                 std::to_string(triangles) + " triangles");
  return {};
}

Result<std::unique_ptr<draco::Mesh> > decode(std::span<const std::uint8_t> bytes, const Room& room,
                                             const std::string& where) {
  try {
    const Status status = check_start(bytes, room, where);
    if (!status.ok()) return status.error();
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
      return gltf_error(where,
                        "its stream is damaged (" + decoded.status().error_msg_string() + ")");
    std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    if (mesh->num_faces() > room.triangles)
      return gltf_error(where, counted(mesh->num_faces(), "triangles", room.triangles));
    if (mesh->num_points() > room.points)
      return gltf_error(where, counted(mesh->num_points(), "vertices", room.points));
    return mesh;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return gltf_error(where, std::string("its stream is damaged (") + error.what() + ")");
  }
}

/// 0: a type that accessors do not have.
int component_type_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_INT32:
      return TINYGLTF_COMPONENT_TYPE_INT;
    case draco::DT_UINT32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default:
      return 0;
  }
}

/// Adds an accessor of these tightly packed bytes, otherwise like `like`. Returns its index.
int add_accessor(tinygltf::Model& model, tinygltf::Accessor like, std::size_t count,
                 std::vector<unsigned char> bytes) {
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  model.buffers.emplace_back().data = std::move(bytes);
  like.bufferView = static_cast<int>(model.bufferViews.size());
  like.byteOffset = 0;
  like.count = count;
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(like));
  return static_cast<int>(model.accessors.size() - 1);
}

/// The values of an attribute, of one point after the other, in the type that the stream has.
Result<std::vector<unsigned char> > values_of(const draco::PointAttribute& from,
                                              std::uint32_t points, std::uint32_t components,
                                              const std::string& where) {
  if (static_cast<std::uint32_t>(from.num_components()) != components)
    return gltf_error(where, "has " + std::to_string(static_cast<int>(from.num_components())) +
                                 " components in the stream, " + std::to_string(components) +
                                 " in its accessor");
  const auto size = components * static_cast<std::size_t>(draco::DataTypeLength(from.data_type()));
  const bool is_whole = from.buffer() && from.byte_stride() == static_cast<std::int64_t>(size) &&
                        from.size() <= from.buffer()->data_size() / size &&
                        (from.is_mapping_identity() || from.indices_map_size() >= points);
  if (!is_whole) return gltf_error(where, "its values in the stream are damaged");
  std::vector<unsigned char> out(points * size);
  for (std::uint32_t point = 0; point < points; ++point) {
    const draco::AttributeValueIndex index = from.mapped_index(draco::PointIndex(point));
    if (index.value() >= from.size())
      return gltf_error(where, "its values in the stream are damaged");
    from.GetValue(index, out.data() + point * size);
  }
  return out;
}

Status take_attribute(tinygltf::Model& model, const draco::Mesh& mesh, std::uint32_t id,
                      const std::string& where, int& accessor) {
  const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(id);
  if (!from)
    return gltf_error(where,
                      "names attribute " + std::to_string(id) + ", which the stream does not have");
  tinygltf::Accessor like = model.accessors[static_cast<std::size_t>(accessor)];
  const int type = component_type_of(from->data_type());
  if (type == 0) return gltf_error(where, "has a type in the stream that glTF does not have");
  Result<std::vector<unsigned char> > values =
      values_of(*from, mesh.num_points(), accessor_components(model, accessor), where);
  if (!values.ok()) return values.error();
  if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
    like.normalized = false;
  } else if (like.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
    like.normalized = from->normalized();
  }
  like.componentType = type;
  accessor = add_accessor(model, std::move(like), mesh.num_points(), std::move(values.value()));
  return {};
}

Status take_triangles(tinygltf::Model& model, const draco::Mesh& mesh, const std::string& where,
                      tinygltf::Primitive& primitive) {
  std::vector<unsigned char> bytes(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t));
  unsigned char* to = bytes.data();
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(i))) {
      const std::uint32_t index = point.value();
      if (index >= mesh.num_points())
        return gltf_error(where, "triangle " + std::to_string(i) + " of its stream names vertex " +
                                     std::to_string(index) + " of " +
                                     std::to_string(mesh.num_points()));
      std::memcpy(to, &index, sizeof index);
      to += sizeof index;
    }
  }
  tinygltf::Accessor like;
  like.type = TINYGLTF_TYPE_SCALAR;
  like.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  // A strip is compressed as the list of its triangles.
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.indices =
      add_accessor(model, like, std::size_t{mesh.num_faces()} * 3, std::move(bytes));
  return {};
}

Result<std::size_t> count_of(const tinygltf::Model& model, int accessor, const std::string& where) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size())
    return gltf_error(where, "names accessor " + std::to_string(accessor) + " of " +
                                 std::to_string(model.accessors.size()));
  const std::size_t count = model.accessors[static_cast<std::size_t>(accessor)].count;
  if (count > kMaxAccessorElements)
    return gltf_error(where, "has " + std::to_string(count) + " elements, " +
                                 std::to_string(kMaxAccessorElements) + " are allowed");
  return count;
}

Result<Room> room_of(const tinygltf::Model& model, const DracoPrimitive& compressed,
                     const tinygltf::Primitive& primitive) {
  Room room = {kMaxAccessorElements, 0};
  for (const auto& [name, id] : compressed.attributes) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) continue;
    const Result<std::size_t> count =
        count_of(model, found->second, compressed.where + ", " + name);
    if (!count.ok()) return count.error();
    room.points = std::min(room.points, count.value());
  }
  std::size_t corners = room.points;
  if (primitive.indices >= 0) {
    const Result<std::size_t> count =
        count_of(model, primitive.indices, compressed.where + ", indices");
    if (!count.ok()) return count.error();
    corners = count.value();
  }
  const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  room.triangles = is_strip ? std::max<std::size_t>(corners, 2) - 2 : corners / 3;
  return room;
}

Status decode_one(tinygltf::Model& model, const DracoPrimitive& compressed,
                  std::vector<std::string>& warnings) {
  const std::string& where = compressed.where;
  tinygltf::Primitive& primitive = model.meshes[compressed.mesh].primitives[compressed.primitive];
  const Result<Room> room = room_of(model, compressed, primitive);
  if (!room.ok()) return room.error();
  const Result<std::span<const std::uint8_t> > bytes =
      buffer_view_bytes(model, compressed.view, where);
  if (!bytes.ok()) return bytes.error();
  const Result<std::unique_ptr<draco::Mesh> > decoded = decode(bytes.value(), room.value(), where);
  if (!decoded.ok()) return decoded.error();
  const draco::Mesh& mesh = *decoded.value();
  if (mesh.num_points() < room.value().points)
    warnings.push_back(where + ": " + counted(mesh.num_points(), "vertices", room.value().points) +
                       "; those of the stream are read");
  for (const auto& [name, id] : compressed.attributes) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) continue;
    const Status status = take_attribute(model, mesh, id, where + ", " + name, found->second);
    if (!status.ok()) return status;
  }
  return take_triangles(model, mesh, where, primitive);
}

}  // namespace

Status decode_draco(tinygltf::Model& model, std::span<const DracoPrimitive> primitives,
                    std::vector<std::string>& warnings) {
  for (const DracoPrimitive& primitive : primitives) {
    const Status status = decode_one(model, primitive, warnings);
    if (!status.ok()) return status;
  }
  return {};
}

#endif

}  // namespace kaamos::effects
