// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_streams.h"

#include <nlohmann/json.hpp>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_error.h"

namespace kaamos::effects {
namespace {

using Json = nlohmann::json;

// What to make of a stream, in words that it uses.
bool is_mode(const std::string& name, MeshoptMode& mode) {
  mode = name == "TRIANGLES" ? MeshoptMode::kTriangles
         : name == "INDICES" ? MeshoptMode::kIndices
                             : MeshoptMode::kAttributes;
  return mode != MeshoptMode::kAttributes || name == "ATTRIBUTES";
}

bool is_filter(const std::string& name, MeshoptFilter& filter) {
  filter = name == "OCTAHEDRAL"    ? MeshoptFilter::kOctahedral
           : name == "QUATERNION"  ? MeshoptFilter::kQuaternion
           : name == "EXPONENTIAL" ? MeshoptFilter::kExponential
                                   : MeshoptFilter::kNone;
  return filter != MeshoptFilter::kNone || name.empty() || name == "NONE";
}

// The strides that a stream may have; empty: this is one of them.
std::string allowed_strides(const MeshoptView& view) {
  const std::size_t stride = view.stride;
  if (view.mode != MeshoptMode::kAttributes) return stride == 2 || stride == 4 ? "" : "2 and 4 are";
  if (view.filter == MeshoptFilter::kOctahedral)
    return stride == 4 || stride == 8 ? "" : "4 and 8 are";
  if (view.filter == MeshoptFilter::kQuaternion) return stride == 8 ? "" : "8 is";
  return stride >= 4 && stride <= 256 && stride % 4 == 0 ? "" : "multiples of 4 from 4 to 256 are";
}

/// A member that may be missing, as 0.
Status read_size(const Json& from, const char* member, const std::string& where, std::size_t& to) {
  const auto number = from.value(member, std::int64_t{0});
  if (number < 0)
    return gltf_error(
        where, std::string(member) + " is " + std::to_string(number) + ", which is negative");
  to = static_cast<std::size_t>(number);
  return {};
}

}  // namespace

Result<MeshoptView> read_meshopt_view(const Json& from, std::size_t view, std::int64_t view_bytes,
                                      const std::string& where) {
  MeshoptView out{};
  Status status = read_size(from, "byteOffset", where, out.offset_bytes);
  if (status.ok()) status = read_size(from, "byteLength", where, out.size_bytes);
  if (status.ok()) status = read_size(from, "byteStride", where, out.stride);
  if (status.ok()) status = read_size(from, "count", where, out.count);
  if (!status.ok()) return status.error();
  if (out.count > kMaxAccessorElements)
    return gltf_error(where, "count is " + std::to_string(out.count) + ", 0 to " +
                                 std::to_string(kMaxAccessorElements) + " are allowed");
  const auto mode = from["mode"].get<std::string>();
  if (!is_mode(mode, out.mode))
    return gltf_error(where,
                      "mode is \"" + mode + "\", ATTRIBUTES, TRIANGLES and INDICES are allowed");
  const auto filter = from.value("filter", std::string());
  if (!is_filter(filter, out.filter))
    return gltf_error(where, "filter is \"" + filter +
                                 "\", NONE, OCTAHEDRAL, QUATERNION and EXPONENTIAL are allowed");
  if (out.mode != MeshoptMode::kAttributes && out.filter != MeshoptFilter::kNone)
    return gltf_error(where, "has a filter, which only ATTRIBUTES may have");
  if (const std::string allowed = allowed_strides(out); !allowed.empty())
    return gltf_error(where,
                      "byteStride is " + std::to_string(out.stride) + ", " + allowed + " allowed");
  if (out.mode == MeshoptMode::kTriangles && out.count % 3 != 0)
    return gltf_error(where,
                      "count is " + std::to_string(out.count) + ", multiples of 3 are allowed");
  if (out.count * out.stride != static_cast<std::size_t>(view_bytes))
    return gltf_error(where, "count times byteStride are " +
                                 std::to_string(out.count * out.stride) +
                                 " bytes, the bufferView has " + std::to_string(view_bytes));
  out.view = view;
  out.buffer = from["buffer"].get<int>();
  out.where = where;
  return out;
}

Result<DracoPrimitive> read_draco_primitive(const Json& primitive, const Json& from,
                                            const std::string& where) {
  const auto mode = primitive.value("mode", std::int64_t{4});
  if (mode != 4 && mode != 5)
    return gltf_error(where, "the primitive's mode is " + std::to_string(mode) +
                                 ", 4 and 5 (triangles and strips) are allowed");
  DracoPrimitive out{0, 0, from["bufferView"].get<int>(), {}, where};
  for (const auto& [name, id] : from["attributes"].items()) {
    const auto number = id.get<std::int64_t>();
    if (number < 0 || number > 0xFFFFFFFF)
      return gltf_error(where, "attribute " + name + " is " + std::to_string(number) +
                                   ", 0 to 4294967295 are allowed");
    out.attributes[name] = static_cast<std::uint32_t>(number);
  }
  return out;
}

}  // namespace kaamos::effects
