// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>

#include "effects/assets/gltf/gltf_extensions.h"
#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/gltf/gltf_streams.h"

namespace kaamos::effects {
namespace {

using Json = nlohmann::json;

enum class Kind : std::uint8_t { kWhole, kNumber, kText, kObject, kList, kWholes };

struct Member {
  const char* name;
  Kind kind;
  bool required = false;
};

// Members whose mistakes the parser would refuse without saying where, or would read as something
// else.
constexpr std::array kAccessor = {
    Member{"componentType", Kind::kWhole, true}, Member{"count", Kind::kWhole, true},
    Member{"type", Kind::kText, true},           Member{"bufferView", Kind::kWhole},
    Member{"byteOffset", Kind::kWhole},          Member{"sparse", Kind::kObject}};
constexpr std::array kSparse = {Member{"count", Kind::kWhole, true},
                                Member{"indices", Kind::kObject, true},
                                Member{"values", Kind::kObject, true}};
constexpr std::array kSparseIndices = {Member{"bufferView", Kind::kWhole, true},
                                       Member{"componentType", Kind::kWhole, true},
                                       Member{"byteOffset", Kind::kWhole}};
constexpr std::array kSparseValues = {Member{"bufferView", Kind::kWhole, true},
                                      Member{"byteOffset", Kind::kWhole}};
constexpr std::array kBuffer = {Member{"byteLength", Kind::kWhole, true},
                                Member{"uri", Kind::kText}};
constexpr std::array kBufferView = {
    Member{"buffer", Kind::kWhole, true}, Member{"byteLength", Kind::kWhole, true},
    Member{"byteOffset", Kind::kWhole}, Member{"byteStride", Kind::kWhole}};
constexpr std::array kMeshopt = {Member{"buffer", Kind::kWhole, true},
                                 Member{"byteLength", Kind::kWhole, true},
                                 Member{"byteStride", Kind::kWhole, true},
                                 Member{"count", Kind::kWhole, true},
                                 Member{"mode", Kind::kText, true},
                                 Member{"byteOffset", Kind::kWhole},
                                 Member{"filter", Kind::kText}};
constexpr std::array kMesh = {Member{"primitives", Kind::kList, true}};
constexpr std::array kPrimitive = {
    Member{"attributes", Kind::kObject, true}, Member{"indices", Kind::kWhole},
    Member{"material", Kind::kWhole}, Member{"mode", Kind::kWhole}, Member{"targets", Kind::kList}};
constexpr std::array kDraco = {Member{"bufferView", Kind::kWhole, true},
                               Member{"attributes", Kind::kObject, true}};
constexpr std::array kNode = {Member{"mesh", Kind::kWhole}, Member{"camera", Kind::kWhole},
                              Member{"skin", Kind::kWhole}, Member{"children", Kind::kWholes}};
constexpr std::array kSkin = {Member{"joints", Kind::kWholes, true},
                              Member{"inverseBindMatrices", Kind::kWhole}};
constexpr std::array kScene = {Member{"nodes", Kind::kWholes}};
constexpr std::array kImage = {Member{"uri", Kind::kText}, Member{"bufferView", Kind::kWhole},
                               Member{"mimeType", Kind::kText}};
constexpr std::array kTexture = {Member{"source", Kind::kWhole}, Member{"sampler", Kind::kWhole}};
constexpr std::array kTextureSampler = {
    Member{"magFilter", Kind::kWhole}, Member{"minFilter", Kind::kWhole},
    Member{"wrapS", Kind::kWhole}, Member{"wrapT", Kind::kWhole}};
constexpr std::array kMaterial = {
    Member{"pbrMetallicRoughness", Kind::kObject}, Member{"normalTexture", Kind::kObject},
    Member{"occlusionTexture", Kind::kObject},     Member{"emissiveTexture", Kind::kObject},
    Member{"emissiveFactor", Kind::kList},         Member{"alphaMode", Kind::kText},
    Member{"alphaCutoff", Kind::kNumber}};
constexpr std::array kCamera = {Member{"type", Kind::kText, true}};
constexpr std::array kPerspective = {Member{"yfov", Kind::kNumber, true},
                                     Member{"znear", Kind::kNumber, true}};
constexpr std::array kOrthographic = {
    Member{"xmag", Kind::kNumber, true}, Member{"ymag", Kind::kNumber, true},
    Member{"znear", Kind::kNumber, true}, Member{"zfar", Kind::kNumber, true}};
constexpr std::array kAnimation = {Member{"channels", Kind::kList, true},
                                   Member{"samplers", Kind::kList, true}};
constexpr std::array kChannel = {Member{"sampler", Kind::kWhole, true},
                                 Member{"target", Kind::kObject, true}};
constexpr std::array kTarget = {Member{"path", Kind::kText, true}, Member{"node", Kind::kWhole}};
constexpr std::array kSampler = {Member{"input", Kind::kWhole, true},
                                 Member{"output", Kind::kWhole, true}};
constexpr std::array kLight = {Member{"type", Kind::kText, true}, Member{"spot", Kind::kObject}};

const char* words_of(Kind kind) {
  switch (kind) {
    case Kind::kWhole:
      return "a whole number";
    case Kind::kNumber:
      return "a number";
    case Kind::kText:
      return "a text";
    case Kind::kObject:
      return "an object";
    case Kind::kList:
      return "a list";
    case Kind::kWholes:
      return "a list of whole numbers";
  }
  return "";
}

Status fail(const std::string& where, const std::string& what) {
  return make_error(ErrorId::kGltf, (where.empty() ? "" : where + ": ") + what);
}

const Json* find(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::string text(const Json& object, const char* key) {
  const Json* value = find(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

/// An extension of an object; none: it does not have it.
Json* extension_of(Json& object, const char* name) {
  const auto all = object.find("extensions");
  if (all == object.end() || !all->is_object()) return nullptr;
  const auto found = all->find(name);
  return found == all->end() ? nullptr : &*found;
}

constexpr char kMeshoptName[] = "EXT_meshopt_compression";

/// True for a buffer whose views are all compressed, so that nothing of it is needed.
bool is_fallback(Json& buffer) {
  const Json* extension = extension_of(buffer, kMeshoptName);
  if (!extension || !extension->is_object()) return false;
  const Json* fallback = find(*extension, "fallback");
  return fallback && fallback->is_boolean() && fallback->get<bool>();
}

class Checker {
 public:
  Checker(Json& root, std::optional<std::size_t> binary_bytes)
      : root_(root), binary_bytes_(binary_bytes) {}
  Status run(std::vector<std::string>& warnings);
  std::vector<HiddenIndices> hidden;
  std::vector<DracoPrimitive> draco_primitives;
  std::vector<MeshoptView> meshopt_views;
  std::vector<std::size_t> named_bytes;
  bool changed = false;

 private:
  Status versions() const;
  Status extensions(std::vector<std::string>& warnings) const;
  void collect(const Json& value, std::vector<std::string>& names) const;
  template <class Check>
  Status each(const char* list, const char* noun, std::span<const Member> members, Check check);
  template <class Check>
  Status items(Json& list, const std::string& where, const char* noun,
               std::span<const Member> members, Check check);
  Status object(Json& object, const std::string& where, std::span<const Member> members);
  bool is_kind(Json& value, Kind kind);
  Status accessor(Json& accessor, const std::string& where);
  Status buffer(Json& buffer, std::size_t id, const std::string& where);
  Status primitive(Json& primitive, std::size_t mesh, std::size_t id, const std::string& where);
  Status draco(Json& primitive, std::size_t mesh, std::size_t id, const std::string& where);
  Status camera(Json& camera, const std::string& where);
  Status animation(Json& animation, const std::string& where);
  Status lights();
  Status image(Json& image, const std::string& where);
  Status view(Json& view, std::size_t id, const std::string& where);
  Status meshopt(Json& extension, std::size_t id, std::int64_t view_bytes,
                 const std::string& where);
  Status names(const Json& object, const char* member, const char* list, const char* noun,
               const std::string& where) const;
  bool has_view(const Json& id) const;

  Json& root_;
  std::optional<std::size_t> binary_bytes_;
};

// A whole number may be written 3.0, which the parser does not read.
bool Checker::is_kind(Json& value, Kind kind) {
  switch (kind) {
    case Kind::kWhole:
      if (value.is_number_integer()) return true;
      if (!value.is_number_float()) return false;
      if (const double number = value.get<double>();
          std::abs(number) < 9e15 && number == std::floor(number)) {
        value = static_cast<std::int64_t>(number);
        changed = true;
        return true;
      }
      return false;
    case Kind::kNumber:
      return value.is_number();
    case Kind::kText:
      return value.is_string();
    case Kind::kObject:
      return value.is_object();
    case Kind::kList:
      return value.is_array();
    case Kind::kWholes:
      if (!value.is_array()) return false;
      return std::all_of(value.begin(), value.end(),
                         [&](Json& item) { return is_kind(item, Kind::kWhole); });
  }
  return false;
}

Status Checker::object(Json& object, const std::string& where, std::span<const Member> members) {
  if (!object.is_object()) return fail(where, "is not an object");
  for (const Member& member : members) {
    const auto found = object.find(member.name);
    if (found == object.end()) {
      if (member.required)
        return fail(where, std::string("has no ") + member.name + ", which glTF requires");
      continue;
    }
    if (!is_kind(*found, member.kind))
      return fail(where, std::string(member.name) + " is not " + words_of(member.kind));
  }
  return {};
}

template <class Check>
Status Checker::items(Json& list, const std::string& where, const char* noun,
                      std::span<const Member> members, Check check) {
  for (std::size_t id = 0; id < list.size(); ++id) {
    Json& item = list[id];
    const std::string place =
        (where.empty() ? "" : where + ", ") +
        gltf_part(noun, id, item.is_object() && where.empty() ? text(item, "name") : "");
    Status status = object(item, place, members);
    if (status.ok()) status = check(item, id, place);
    if (!status.ok()) return status;
  }
  return {};
}

template <class Check>
Status Checker::each(const char* list, const char* noun, std::span<const Member> members,
                     Check check) {
  const auto found = root_.find(list);
  if (found == root_.end()) return {};
  if (!found->is_array()) return fail("", std::string(list) + " is not a list");
  return items(*found, "", noun, members, check);
}

Status Checker::versions() const {
  const Json* asset = find(root_, "asset");
  if (!asset || !asset->is_object())
    return fail("", "has no asset, which glTF requires: is it a glTF file?");
  const std::string version = text(*asset, "version");
  if (version.empty()) return fail("", "has no asset.version, which glTF requires");
  if (std::strtol(version.c_str(), nullptr, 10) != 2)
    return fail("", "is glTF " + version + ", 2.0 is supported: export it as glTF 2.0");
  const std::string least = text(*asset, "minVersion");
  if (std::strtod(least.c_str(), nullptr) > 2.0)
    return fail("", "needs glTF " + least + " (asset.minVersion), 2.0 is supported");
  return {};
}

// Names of extensions that stand anywhere in the file, whether it declares them or not.
void Checker::collect(const Json& value, std::vector<std::string>& names) const {
  if (value.is_array()) {
    for (const Json& item : value)
      if (item.is_structured()) collect(item, names);
  }
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_structured()) continue;
    if (key == "extensions" && member.is_object()) {
      for (const auto& [name, unused] : member.items()) names.push_back(name);
    }
    collect(member, names);
  }
}

Status Checker::extensions(std::vector<std::string>& warnings) const {
  const auto names_in = [&](const char* list, std::vector<std::string>& names) -> Status {
    const Json* found = find(root_, list);
    if (!found) return {};
    if (!found->is_array()) return fail("", std::string(list) + " is not a list");
    for (const Json& name : *found) {
      if (!name.is_string()) return fail("", std::string(list) + " is not a list of texts");
      names.push_back(name.get<std::string>());
    }
    return {};
  };
  std::vector<std::string> required, used;
  Status status = names_in("extensionsRequired", required);
  if (status.ok()) status = names_in("extensionsUsed", used);
  if (status.ok()) status = check_required_extensions(required);
  if (!status.ok()) return status;
  collect(root_, used);
  warn_of_extensions(used, warnings);
  return {};
}

Status Checker::accessor(Json& accessor, const std::string& where) {
  static constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  const std::string type = text(accessor, "type");
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end())
    return fail(where, "type is \"" + type +
                           "\", SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4 are allowed");
  const auto component = accessor["componentType"].get<std::int64_t>();
  if ((component < 5120 || component > 5126) && component != 5130)
    return fail(where, "componentType is " + std::to_string(component) +
                           ", 5120 to 5123, 5125 and 5126 are allowed");
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return {};
  Status status = object(*sparse, where + ", sparse", kSparse);
  if (status.ok())
    status = object((*sparse)["indices"], where + ", sparse, indices", kSparseIndices);
  if (status.ok()) status = object((*sparse)["values"], where + ", sparse, values", kSparseValues);
  return status;
}

// Bytes of a base64 text.
std::size_t decoded_size(std::string_view base64) {
  std::size_t padding = 0;
  while (padding < 2 && padding < base64.size() && base64[base64.size() - 1 - padding] == '=')
    ++padding;
  return (base64.size() - padding) * 3 / 4;
}

// The first `bytes` bytes of a base64 text, which has at least as many.
std::string first_bytes(std::string_view base64, std::size_t bytes) {
  std::string out(base64.substr(0, (bytes + 2) / 3 * 4));
  out.resize((bytes + 2) / 3 * 4, '=');  // a text may lack its padding
  const std::size_t rest = bytes % 3;
  if (rest != 0) out.back() = '=';
  if (rest == 1) out[out.size() - 2] = '=';
  return out;
}

// tinygltf knows some media types only, and reads no buffer that is longer than it says.
constexpr std::string_view kBufferPrefix = "data:application/octet-stream;base64,";
constexpr std::string_view kImagePrefix = "data:image/png;base64,";

Status Checker::buffer(Json& buffer, std::size_t id, const std::string& where) {
  const Json* uri = find(buffer, "uri");
  const auto wanted = buffer["byteLength"].get<std::int64_t>();
  if (wanted < 0) return fail(where, "byteLength is negative");
  const auto has_too_few = [&](std::size_t bytes) {
    return fail(where, "byteLength is " + std::to_string(wanted) + ", its data has " +
                           std::to_string(bytes) + " bytes");
  };
  if (can_read_meshopt() && is_fallback(buffer)) {
    // The parser wants bytes of every buffer.
    buffer["uri"] = std::string(kBufferPrefix) + "AA==";
    buffer["byteLength"] = 1;
    changed = true;
    return {};
  }
  if (!uri) {
    for (const char* name : {kMeshoptName, "KHR_meshopt_compression"})
      if (extension_of(buffer, name))
        return fail(where, std::string("is compressed by ") + name + ", which is not supported" +
                               gltf_remedy(name) +
                               ", and has no uncompressed copy: export the file without it");
    if (id != 0 || !binary_bytes_)
      return fail(where, "has no uri, and is not the binary chunk of a .glb");
    if (static_cast<std::size_t>(wanted) > *binary_bytes_) return has_too_few(*binary_bytes_);
    return {};
  }
  const auto& address = uri->get_ref<const std::string&>();
  if (!address.starts_with("data:")) {
    named_bytes.push_back(static_cast<std::size_t>(wanted));
    return {};
  }
  const std::size_t comma = address.find(";base64,");
  if (comma == std::string::npos)
    return fail(where, "its data URI is not base64, which is the only kind that is read");
  const std::string_view base64 = std::string_view(address).substr(comma + 8);
  const std::size_t bytes = decoded_size(base64);
  if (static_cast<std::size_t>(wanted) > bytes) return has_too_few(bytes);
  if (static_cast<std::size_t>(wanted) == bytes && address.starts_with(kBufferPrefix)) return {};
  buffer["uri"] =
      std::string(kBufferPrefix) + first_bytes(base64, static_cast<std::size_t>(wanted));
  changed = true;
  return {};
}

// Checks that a member, if it is there, names one of a list of the file.
Status Checker::names(const Json& object, const char* member, const char* list, const char* noun,
                      const std::string& where) const {
  const Json* id = find(object, member);
  if (!id) return {};
  const Json* all = find(root_, list);
  const std::size_t count = all && all->is_array() ? all->size() : 0;
  const auto place = id->get<std::int64_t>();
  if (place >= 0 && static_cast<std::size_t>(place) < count) return {};
  return fail(where, std::string("names ") + noun + " " + std::to_string(place) + " of " +
                         std::to_string(count));
}

// Checks what a bufferView says of its stream, and keeps it for the decoder.
Status Checker::meshopt(Json& from, std::size_t id, std::int64_t view_bytes,
                        const std::string& where) {
  Status status = object(from, where, kMeshopt);
  if (status.ok()) status = names(from, "buffer", "buffers", "buffer", where);
  if (!status.ok()) return status;
  Result<MeshoptView> out = read_meshopt_view(from, id, view_bytes, where);
  if (!out.ok()) return out.error();
  meshopt_views.push_back(std::move(out.value()));
  return {};
}

Status Checker::view(Json& view, std::size_t id, const std::string& where) {
  if (const Json* stride = find(view, "byteStride")) {
    const auto bytes = stride->get<std::int64_t>();
    if (bytes < 0 || bytes > 252 || bytes % 4 != 0)
      return fail(where, "byteStride is " + std::to_string(bytes) +
                             ", multiples of 4 from 4 to 252 are allowed");
  }
  const Status status = names(view, "buffer", "buffers", "buffer", where);
  if (!status.ok() || !can_read_meshopt()) return status;
  if (Json* extension = extension_of(view, kMeshoptName))
    return meshopt(*extension, id, view["byteLength"].get<std::int64_t>(),
                   where + ", " + kMeshoptName);
  const auto buffer = view["buffer"].get<std::size_t>();
  if (is_fallback(root_["buffers"][buffer]))
    return fail(where, std::string("has no ") + kMeshoptName + ", and buffer " +
                           std::to_string(buffer) + " only stands in for compressed ones");
  return {};
}

// Any media type will do: the first bytes of a picture say what it is.
Status Checker::image(Json& image, const std::string& where) {
  if (!find(image, "uri") && !find(image, "bufferView"))
    return fail(where, "has neither uri nor bufferView, one is required");
  if (const Status status = names(image, "bufferView", "bufferViews", "bufferView", where);
      !status.ok())
    return status;
  const std::string address = text(image, "uri");
  if (!address.starts_with("data:")) return {};
  const std::size_t comma = address.find(";base64,");
  if (comma == std::string::npos)
    return fail(where, "its data URI is not base64, which is the only kind that is read");
  if (decoded_size(std::string_view(address).substr(comma + 8)) == 0)
    return fail(where, "its data URI holds no base64");
  if (address.starts_with(kImagePrefix) || address.starts_with("data:image/jpeg;base64,"))
    return {};
  image["uri"] = std::string(kImagePrefix) + address.substr(comma + 8);
  changed = true;
  return {};
}

bool Checker::has_view(const Json& id) const {
  const Json* accessors = find(root_, "accessors");
  if (!accessors || !id.is_number_integer()) return true;
  const auto place = id.get<std::int64_t>();
  if (place < 0 || static_cast<std::size_t>(place) >= accessors->size()) return true;
  const Json* view = find((*accessors)[static_cast<std::size_t>(place)], "bufferView");
  return view && view->get<std::int64_t>() >= 0;
}

// Checks what a primitive says of its stream, and keeps it for the decoder.
Status Checker::draco(Json& primitive, std::size_t mesh, std::size_t id, const std::string& where) {
  const std::string name = "KHR_draco_mesh_compression";
  Json* found = extension_of(primitive, name.c_str());
  if (!found) return {};
  if (!can_read_draco()) {
    const Json* position = find(primitive["attributes"], "POSITION");
    return !position || has_view(*position)
               ? Status()
               : fail(where, "is compressed by " + name + ", which is not supported" +
                                 gltf_remedy(name) +
                                 ", and has no uncompressed copy: export the file without it");
  }
  const std::string place = where + ", " + name;
  Status status = object(*found, place, kDraco);
  if (status.ok()) status = names(*found, "bufferView", "bufferViews", "bufferView", place);
  if (!status.ok()) return status;
  for (auto& [attribute, in_stream] : (*found)["attributes"].items())
    if (!is_kind(in_stream, Kind::kWhole))
      return fail(place, "attribute " + attribute + " is not a whole number");
  Result<DracoPrimitive> out = read_draco_primitive(primitive, *found, place);
  if (!out.ok()) return out.error();
  out.value().mesh = mesh;
  out.value().primitive = id;
  draco_primitives.push_back(std::move(out.value()));
  return {};
}

Status Checker::primitive(Json& primitive, std::size_t mesh, std::size_t id,
                          const std::string& where) {
  for (auto& [name, accessor] : primitive["attributes"].items())
    if (!is_kind(accessor, Kind::kWhole))
      return fail(where, "attribute " + name + " is not a whole number");
  if (Status status = draco(primitive, mesh, id, where); !status.ok()) return status;
  if (const auto targets = primitive.find("targets"); targets != primitive.end()) {
    for (std::size_t t = 0; t < targets->size(); ++t) {
      const std::string place = where + ", morph target " + std::to_string(t);
      if (!(*targets)[t].is_object()) return fail(place, "is not an object");
      for (auto& [name, accessor] : (*targets)[t].items())
        if (!is_kind(accessor, Kind::kWhole)) return fail(place, name + " is not a whole number");
    }
  }
  // tinygltf refuses indices whose accessor has no bufferView, which glTF allows.
  const auto indices = primitive.find("indices");
  if (indices == primitive.end()) return {};
  const auto accessor = indices->get<std::int64_t>();
  const Json* accessors = find(root_, "accessors");
  const std::size_t count = accessors && accessors->is_array() ? accessors->size() : 0;
  if (accessor >= 0 && static_cast<std::size_t>(accessor) >= count)
    return fail(where, "indices: names accessor " + std::to_string(accessor) + " of " +
                           std::to_string(count));
  if (accessor < 0 || has_view(*indices)) return {};
  hidden.push_back({mesh, id, static_cast<int>(accessor)});
  primitive.erase(indices);
  changed = true;
  return {};
}

Status Checker::camera(Json& camera, const std::string& where) {
  const std::string type = text(camera, "type");
  if (type != "perspective" && type != "orthographic")
    return fail(where, "type is \"" + type + "\", perspective and orthographic are allowed");
  const auto found = camera.find(type);
  if (found == camera.end()) return fail(where, "has no " + type + ", which its type requires");
  if (type == "perspective") return object(*found, where + ", perspective", kPerspective);
  return object(*found, where + ", orthographic", kOrthographic);
}

Status Checker::animation(Json& animation, const std::string& where) {
  const Status status = items(animation["samplers"], where, "sampler", kSampler,
                              [](Json&, std::size_t, const std::string&) { return Status(); });
  if (!status.ok()) return status;
  return items(animation["channels"], where, "channel", kChannel,
               [&](Json& channel, std::size_t, const std::string& place) {
                 return object(channel["target"], place + ", target", kTarget);
               });
}

Status Checker::lights() {
  const auto all = root_.find("extensions");
  if (all == root_.end() || !all->is_object()) return {};
  const auto extension = all->find("KHR_lights_punctual");
  if (extension == all->end()) return {};
  const std::string name = "KHR_lights_punctual";
  if (!extension->is_object() || !find(*extension, "lights") || !(*extension)["lights"].is_array())
    return fail(name, "has no list of lights");
  return items((*extension)["lights"], name, "light", kLight,
               [](Json& light, std::size_t, const std::string& place) {
                 return text(light, "type") == "spot" && !find(light, "spot")
                            ? fail(place, "is a spot and has no spot, which the extension requires")
                            : Status();
               });
}

Status Checker::run(std::vector<std::string>& warnings) {
  const auto nothing = [](Json&, std::size_t, const std::string&) { return Status(); };
  if (!root_.is_object()) return fail("", "its JSON is not an object");
  Status status = versions();
  if (status.ok()) status = extensions(warnings);
  if (status.ok())
    status = each("buffers", "buffer", kBuffer,
                  [&](Json& item, std::size_t id, const std::string& where) {
                    return buffer(item, id, where);
                  });
  if (status.ok())
    status = each("bufferViews", "bufferView", kBufferView,
                  [&](Json& item, std::size_t id, const std::string& where) {
                    return view(item, id, where);
                  });
  if (status.ok())
    status = each(
        "accessors", "accessor", kAccessor,
        [&](Json& item, std::size_t, const std::string& where) { return accessor(item, where); });
  if (status.ok())
    status = each("meshes", "mesh", kMesh, [&](Json& mesh, std::size_t id, const std::string& at) {
      return items(mesh["primitives"], at, "primitive", kPrimitive,
                   [&](Json& item, std::size_t number, const std::string& where) {
                     return primitive(item, id, number, where);
                   });
    });
  if (status.ok()) status = each("nodes", "node", kNode, nothing);
  if (status.ok()) status = each("scenes", "scene", kScene, nothing);
  if (status.ok())
    status = each("skins", "skin", kSkin, [](Json& skin, std::size_t, const std::string& where) {
      return skin["joints"].empty() ? fail(where, "has no joints, at least one is required")
                                    : Status();
    });
  if (status.ok())
    status =
        each("images", "image", kImage,
             [&](Json& item, std::size_t, const std::string& where) { return image(item, where); });
  if (status.ok()) status = each("textures", "texture", kTexture, nothing);
  if (status.ok()) status = each("samplers", "sampler", kTextureSampler, nothing);
  if (status.ok()) status = each("materials", "material", kMaterial, nothing);
  if (status.ok())
    status = each(
        "cameras", "camera", kCamera,
        [&](Json& item, std::size_t, const std::string& where) { return camera(item, where); });
  if (status.ok())
    status = each(
        "animations", "animation", kAnimation,
        [&](Json& item, std::size_t, const std::string& where) { return animation(item, where); });
  if (status.ok()) status = lights();
  return status;
}

// Line and column of a byte, counted from 1.
std::string place_in(std::string_view json, std::size_t byte) {
  const std::string_view before = json.substr(0, std::min(byte, json.size()));
  const std::size_t line_start = before.rfind('\n');
  const std::size_t column =
      line_start == std::string_view::npos ? before.size() : before.size() - line_start - 1;
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

}  // namespace

Result<GltfDocument> check_gltf_document(std::string_view json,
                                         std::optional<std::size_t> binary_bytes,
                                         std::vector<std::string>& warnings) {
  Json root;
  try {
    root = Json::parse(json.begin(), json.end());
  } catch (const Json::parse_error& error) {
    return make_error(ErrorId::kGltf, "its JSON has a mistake at " + place_in(json, error.byte));
  } catch (const Json::exception&) {
    return make_error(ErrorId::kGltf, "its JSON has a number that is too large");
  }
  Checker checker(root, binary_bytes);
  const Status status = checker.run(warnings);
  if (!status.ok()) return status.error();
  GltfDocument out;
  out.hidden = std::move(checker.hidden);
  out.meshopt = std::move(checker.meshopt_views);
  out.draco = std::move(checker.draco_primitives);
  out.named_bytes = std::move(checker.named_bytes);
  if (checker.changed) out.json = root.dump();
  return out;
}

}  // namespace kaamos::effects
