// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "effects/assets/gltf/gltf_error.h"

namespace kaamos::effects {
namespace {

/// A checked range of elements in a buffer: reading any element i < count stays inside.
struct ElementView {
  const std::uint8_t* data = nullptr;  ///< null if all elements are zero
  std::size_t stride = 0;
  std::size_t count = 0;
  int component_type = 0;
  std::uint32_t components = 0;
  bool normalized = false;
};

std::uint32_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_INT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 8;
    default:
      return 0;
  }
}

template <class T>
T load(const std::uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

template <class T>
float scaled(const std::uint8_t* p, bool normalized) {
  const T value = load<T>(p);
  if (!normalized) return static_cast<float>(value);
  const double unit = static_cast<double>(value) / std::numeric_limits<T>::max();
  return static_cast<float>(std::max(unit, -1.0));
}

float component(const ElementView& view, const std::uint8_t* p) {
  switch (view.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled<std::int8_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled<std::uint8_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled<std::int16_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled<std::uint16_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return scaled<std::int32_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return scaled<std::uint32_t>(p, view.normalized);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return static_cast<float>(load<double>(p));
    default:
      return load<float>(p);
  }
}

std::uint32_t index_component(int component_type, const std::uint8_t* p) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *p;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(p);
    default:
      return load<std::uint32_t>(p);
  }
}

bool is_index_type(int component_type) {
  return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Checks that `view.count` elements from `offset` lie in the buffer view, and points view.data at
/// the first.
Status place(const tinygltf::Model& model, int buffer_view, std::size_t offset,
             const std::string& where, ElementView& view) {
  const Result<std::span<const std::uint8_t>> bytes = buffer_view_bytes(model, buffer_view, where);
  if (!bytes.ok()) return bytes.error();
  const std::size_t size = std::size_t{component_size(view.component_type)} * view.components;
  if (view.stride == 0) view.stride = size;
  if (view.stride < size || view.stride > 65536)
    return gltf_error(where, "the stride of bufferView " + std::to_string(buffer_view) + " is " +
                                 std::to_string(view.stride) + " bytes, " + std::to_string(size) +
                                 "..65536 are allowed");
  if (view.count == 0) return {};
  const std::size_t needed = (view.count - 1) * view.stride + size;
  if (offset > bytes.value().size() || needed > bytes.value().size() - offset)
    return gltf_error(where, "needs " + std::to_string(needed) + " bytes from byte " +
                                 std::to_string(offset) + " of bufferView " +
                                 std::to_string(buffer_view) + ", which has " +
                                 std::to_string(bytes.value().size()) +
                                 ": the file is cut or its count, offset or stride is wrong");
  view.data = bytes.value().data() + offset;
  return {};
}

Status locate(const tinygltf::Model& model, int id, const std::string& where, ElementView& view) {
  const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(id)];
  view.component_type = a.componentType;
  view.components = accessor_components(model, id);
  view.count = a.count;
  view.normalized = a.normalized;
  if (component_size(a.componentType) == 0)
    return gltf_error(where, "component type " + std::to_string(a.componentType) +
                                 " is unknown, 5120..5126 and 5130 are allowed");
  const std::size_t limit = a.bufferView < 0 ? kMaxZeroElements : kMaxAccessorElements;
  if (a.count > limit)
    return gltf_error(where, "has " + std::to_string(a.count) + " elements, " +
                                 std::to_string(limit) + " are allowed");
  if (a.bufferView < 0) return {};
  if (static_cast<std::size_t>(a.bufferView) < model.bufferViews.size())
    view.stride = model.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
  return place(model, a.bufferView, a.byteOffset, where, view);
}

/// Replaces the elements that a sparse accessor lists. Calls `store(index, pointer to the value)`.
template <class Store>
Status apply_sparse(const tinygltf::Model& model, const tinygltf::Accessor& a,
                    const ElementView& base, const std::string& where, Store store) {
  if (!a.sparse.isSparse) return {};
  const std::string place_name = where + ", sparse";
  if (a.sparse.count < 0 || static_cast<std::size_t>(a.sparse.count) > a.count)
    return gltf_error(place_name, "count is " + std::to_string(a.sparse.count) + ", 0.." +
                                      std::to_string(a.count) + " are allowed");
  if (a.sparse.indices.byteOffset < 0 || a.sparse.values.byteOffset < 0)
    return gltf_error(place_name, "a byte offset is negative");
  if (!is_index_type(a.sparse.indices.componentType))
    return gltf_error(place_name, "indices have component type " +
                                      std::to_string(a.sparse.indices.componentType) +
                                      ", 5121, 5123 and 5125 are allowed");
  ElementView indices;
  indices.count = static_cast<std::size_t>(a.sparse.count);
  indices.component_type = a.sparse.indices.componentType;
  indices.components = 1;
  Status status = place(model, a.sparse.indices.bufferView,
                        static_cast<std::size_t>(a.sparse.indices.byteOffset),
                        place_name + " indices", indices);
  if (!status.ok()) return status.error();
  ElementView values = base;
  values.count = indices.count;
  values.stride = 0;
  values.data = nullptr;
  status =
      place(model, a.sparse.values.bufferView, static_cast<std::size_t>(a.sparse.values.byteOffset),
            place_name + " values", values);
  if (!status.ok()) return status.error();
  for (std::size_t i = 0; i < indices.count; ++i) {
    const std::uint32_t index =
        index_component(indices.component_type, indices.data + i * indices.stride);
    if (index >= a.count)
      return gltf_error(place_name, "index " + std::to_string(i) + " is " + std::to_string(index) +
                                        ", 0.." + std::to_string(a.count - 1) + " are allowed");
    store(index, values.data + i * values.stride);
  }
  return {};
}

Result<std::string> accessor_place(const tinygltf::Model& model, int accessor,
                                   const std::string& where) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size())
    return gltf_error(where, "names accessor " + std::to_string(accessor) + " of " +
                                 std::to_string(model.accessors.size()));
  return where + ", accessor " + std::to_string(accessor);
}

}  // namespace

std::uint32_t accessor_components(const tinygltf::Model& model, int accessor) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) return 0;
  const int type = model.accessors[static_cast<std::size_t>(accessor)].type;
  return static_cast<std::uint32_t>(
      std::max(0, tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type))));
}

Result<std::span<const std::uint8_t>> buffer_view_bytes(const tinygltf::Model& model, int id,
                                                        const std::string& where) {
  if (id < 0 || static_cast<std::size_t>(id) >= model.bufferViews.size())
    return gltf_error(where, "names bufferView " + std::to_string(id) + " of " +
                                 std::to_string(model.bufferViews.size()));
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(id)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    return gltf_error(where, "bufferView " + std::to_string(id) + " names buffer " +
                                 std::to_string(view.buffer) + " of " +
                                 std::to_string(model.buffers.size()));
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return gltf_error(
        where, "bufferView " + std::to_string(id) + " spans " + std::to_string(view.byteLength) +
                   " bytes from byte " + std::to_string(view.byteOffset) + " of buffer " +
                   std::to_string(view.buffer) + ", which has " + std::to_string(data.size()));
  return std::span<const std::uint8_t>(data.data() + view.byteOffset, view.byteLength);
}

Result<std::vector<float>> read_floats(const tinygltf::Model& model, int accessor,
                                       std::uint32_t components, const std::string& user) {
  const Result<std::string> where = accessor_place(model, accessor, user);
  if (!where.ok()) return where.error();
  if (accessor_components(model, accessor) != components)
    return gltf_error(where.value(), "has " + std::to_string(accessor_components(model, accessor)) +
                                         " components, " + std::to_string(components) +
                                         " are expected");
  ElementView view;
  Status status = locate(model, accessor, where.value(), view);
  if (!status.ok()) return status.error();
  std::vector<float> out(view.count * components, 0.0f);
  const std::uint32_t size = component_size(view.component_type);
  const auto store = [&](std::size_t index, const std::uint8_t* p) {
    for (std::uint32_t c = 0; c < components; ++c)
      out[index * components + c] = component(view, p + c * size);
  };
  if (view.data)
    for (std::size_t i = 0; i < view.count; ++i) store(i, view.data + i * view.stride);
  status = apply_sparse(model, model.accessors[static_cast<std::size_t>(accessor)], view,
                        where.value(), store);
  if (!status.ok()) return status.error();
  return out;
}

Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor,
                                                const std::string& user) {
  const Result<std::string> where = accessor_place(model, accessor, user);
  if (!where.ok()) return where.error();
  ElementView view;
  Status status = locate(model, accessor, where.value(), view);
  if (!status.ok()) return status.error();
  if (view.components != 1 || !is_index_type(view.component_type))
    return gltf_error(where.value(),
                      "has component type " + std::to_string(view.component_type) + " and " +
                          std::to_string(view.components) +
                          " components; indices are 1 component of type 5121, 5123 or "
                          "5125");
  std::vector<std::uint32_t> out(view.count, 0);
  const auto store = [&](std::size_t index, const std::uint8_t* p) {
    out[index] = index_component(view.component_type, p);
  };
  if (view.data)
    for (std::size_t i = 0; i < view.count; ++i) store(i, view.data + i * view.stride);
  status = apply_sparse(model, model.accessors[static_cast<std::size_t>(accessor)], view,
                        where.value(), store);
  if (!status.ok()) return status.error();
  return out;
}

}  // namespace kaamos::effects
