// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/reflect.h"

#include <nlohmann/json.hpp>

namespace kaamos::hlsl {

using namespace ir;

namespace {

const char* stage_name(uint32_t stage) {
  switch (stage) {
    case kStageRayGeneration:
      return "raygeneration";
    case kStageIntersection:
      return "intersection";
    case kStageAnyHit:
      return "anyhit";
    case kStageClosestHit:
      return "closesthit";
    case kStageMiss:
      return "miss";
    case kStageCallable:
      return "callable";
    case kStageCompute:
      return "compute";
    case kStageVertex:
      return "vertex";
    case kStageGeometry:
      return "geometry";
    case kStagePixel:
      return "pixel";
    default:
      return "library";
  }
}

const char* resource_name(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::kConstantBuffer:
      return "ConstantBuffer";
    case ResourceKind::kTextureBuffer:
      return "TextureBuffer";
    case ResourceKind::kByteAddressBuffer:
      return "ByteAddressBuffer";
    case ResourceKind::kRWByteAddressBuffer:
      return "RWByteAddressBuffer";
    case ResourceKind::kStructuredBuffer:
      return "StructuredBuffer";
    case ResourceKind::kRWStructuredBuffer:
      return "RWStructuredBuffer";
    case ResourceKind::kBuffer:
      return "Buffer";
    case ResourceKind::kRWBuffer:
      return "RWBuffer";
    case ResourceKind::kTexture1D:
      return "Texture1D";
    case ResourceKind::kTexture1DArray:
      return "Texture1DArray";
    case ResourceKind::kTexture2D:
      return "Texture2D";
    case ResourceKind::kTexture2DArray:
      return "Texture2DArray";
    case ResourceKind::kTexture3D:
      return "Texture3D";
    case ResourceKind::kTextureCube:
      return "TextureCube";
    case ResourceKind::kTextureCubeArray:
      return "TextureCubeArray";
    case ResourceKind::kRWTexture1D:
      return "RWTexture1D";
    case ResourceKind::kRWTexture1DArray:
      return "RWTexture1DArray";
    case ResourceKind::kRWTexture2D:
      return "RWTexture2D";
    case ResourceKind::kRWTexture2DArray:
      return "RWTexture2DArray";
    case ResourceKind::kRWTexture3D:
      return "RWTexture3D";
    case ResourceKind::kSampler:
      return "SamplerState";
    case ResourceKind::kSamplerComparison:
      return "SamplerComparisonState";
    case ResourceKind::kAccelerationStructure:
      return "RaytracingAccelerationStructure";
    case ResourceKind::kRayQuery:
      return "RayQuery";
    case ResourceKind::kAppendStructuredBuffer:
      return "AppendStructuredBuffer";
    case ResourceKind::kConsumeStructuredBuffer:
      return "ConsumeStructuredBuffer";
    case ResourceKind::kTexture2DMS:
      return "Texture2DMS";
    case ResourceKind::kTexture2DMSArray:
      return "Texture2DMSArray";
    case ResourceKind::kRWTexture2DMS:
      return "RWTexture2DMS";
    case ResourceKind::kRWTexture2DMSArray:
      return "RWTexture2DMSArray";
  }
  return "";
}

nlohmann::ordered_json binding_json(const Binding& binding) {
  nlohmann::ordered_json json;
  json["name"] = binding.name;
  json["type"] = resource_name(binding.type->resource);
  json["register"] =
      std::string(1, "tubs"[binding.register_class & 3]) + std::to_string(binding.register_index);
  json["space"] = binding.space;
  if (binding.count == 0xFFFFFFFFu) {
    json["count"] = "unbounded";
  } else {
    json["count"] = binding.count;
  }
  if (binding.size_bytes != 0) json["size_bytes"] = binding.size_bytes;
  json["automatic"] = binding.automatic;
  return json;
}

nlohmann::ordered_json signature_json(const std::vector<SignatureElement>& elements) {
  constexpr const char* kTypes[] = {"float", "int", "uint"};
  // In the order of shader::Interpolation.
  constexpr const char* kInterpolations[] = {
      "linear",         "noperspective",        "centroid",        "noperspective centroid",
      "sample",         "noperspective sample", "nointerpolation", "nointerpolation",
      "nointerpolation"};
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SignatureElement& element : elements) {
    json.push_back(
        {{"semantic", element.semantic},
         {"index", element.semantic_index},
         {"type", kTypes[static_cast<size_t>(element.type)]},
         {"components", element.components},
         {"interpolation", kInterpolations[static_cast<size_t>(element.interpolation)]}});
  }
  return json;
}

void add_imports(nlohmann::ordered_json& json, const Module& module,
                 const std::vector<uint32_t>& imports) {
  for (const uint32_t index : imports) json["imports"].push_back(module.imports[index].signature);
}

nlohmann::ordered_json export_json(const Module& module, const EntryPoint& entry) {
  nlohmann::ordered_json json;
  json["name"] = entry.name;
  json["mangled"] = entry.function->mangled;
  json["stage"] = stage_name(entry.stage);
  if (entry.stage == kStageCompute) {
    json["thread_group"] = entry.thread_group;
  }
  if (entry.is_graphics()) {
    json["inputs"] = signature_json(entry.inputs);
    json["outputs"] = signature_json(entry.outputs);
  }
  if (entry.stage == kStageGeometry) {
    json["input_corners"] = entry.geometry.corners;
    json["output_corners"] = entry.geometry.output_corners;
    json["max_vertex_count"] = entry.geometry.most_vertices;
    json["instances"] = entry.geometry.instances;
  }
  if (entry.payload != nullptr) json["payload_bytes"] = entry.payload_bytes;
  if (entry.attributes != nullptr) json["attribute_bytes"] = entry.attribute_bytes;
  json["traces_rays"] = entry.function->may_trace;
  json["calls_shaders"] = entry.function->may_call;
  json["bindings"] = nlohmann::ordered_json::array();
  for (const uint32_t index : entry.bindings) {
    json["bindings"].push_back(module.bindings[index].name);
  }
  add_imports(json, module, entry.imports);
  return json;
}

}  // namespace

std::string reflect_json(const Module& module) {
  nlohmann::ordered_json json;
  json["name"] = module.name;
  json["target"] = module.target;
  json["exports"] = nlohmann::ordered_json::array();
  for (const EntryPoint& entry : module.entry_points) {
    json["exports"].push_back(export_json(module, entry));
  }
  for (const EntryPoint& entry : module.unlinked_entry_points) {
    json["exports"].push_back(export_json(module, entry));
  }
  for (const LibraryFunction& function : module.library_functions) {
    nlohmann::ordered_json& one = json["exports"].emplace_back(nlohmann::ordered_json{
        {"name", function.name}, {"mangled", function.mangled}, {"stage", "library"}});
    add_imports(one, module, function.imports);
  }
  json["bindings"] = nlohmann::ordered_json::array();
  for (const Binding& binding : module.bindings) {
    json["bindings"].push_back(binding_json(binding));
  }
  json["subobjects"] = nlohmann::ordered_json::array();
  for (const Subobject& subobject : module.subobjects) {
    json["subobjects"].push_back({{"name", subobject.name}, {"type", subobject.type}});
  }
  // Names may contain bytes that are not UTF-8: they are replaced instead of throwing an exception.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace kaamos::hlsl
