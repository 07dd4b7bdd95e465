// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/library_builder.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi::testing {

using shader::BindingType;
using shader::Stage;

// Has a device and a library with one shader of each stage; the shaders use no resources.
class StateObjectTest : public ::testing::Test {
 protected:
  StateObjectTest() {
    builder_.Export("RayGen", Stage::kRayGeneration);
    builder_.Export("Miss", Stage::kMiss);
    builder_.Export("Hit", Stage::kClosestHit).attribute_bytes = 8;
    builder_.Export("Any", Stage::kAnyHit).attribute_bytes = 8;
    builder_.Export("Intersect", Stage::kIntersection);
    builder_.Export("Call", Stage::kCallable);
    builder_.Export("helper", Stage::kLibrary);
    library_ = builder_.Build();
  }

  // A description with the base library and both configs.
  StateObjectDesc Base(StateObjectType type = StateObjectType::kRaytracingPipeline) {
    StateObjectDesc desc{.Type = type};
    desc.Add(DxilLibraryDesc{library_});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
    return desc;
  }
  StateObjectDesc WithFlags(StateObjectFlags flags,
                            StateObjectType type = StateObjectType::kRaytracingPipeline) {
    StateObjectDesc desc = Base(type);
    desc.Add(StateObjectConfig{flags});
    return desc;
  }
  Result<StateObject> Make(const StateObjectDesc& desc) { return device_.CreateStateObject(desc); }

  RootSignature Local(const std::string& text) {
    return device_
        .CreateRootSignature("RootFlags(LOCAL_ROOT_SIGNATURE)" + (text.empty() ? "" : ", " + text))
        .value();
  }
  RootSignature Global(const std::string& text) {
    return device_.CreateRootSignature(text).value();
  }
  static HitGroupDesc Triangles(std::string name, std::string closest = "Hit",
                                std::string any = "") {
    return {.HitGroupExport = std::move(name),
            .AnyHitShaderImport = std::move(any),
            .ClosestHitShaderImport = std::move(closest)};
  }
  // The record that the backend was given for an export of the last state object.
  static const kaamos::runtime::LinkedRecord* Linked(const std::string& name) {
    for (const auto& r : null_log().last_raytracing->records) {
      if (r->name == name) return r.get();
    }
    return nullptr;
  }

  Device device_ = CreateNullDevice();
  LibraryBuilder builder_;
  ShaderLibrary library_;
};

}  // namespace rtapi::testing
