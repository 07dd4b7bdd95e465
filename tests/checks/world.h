// SPDX-License-Identifier: MIT
//
// A small scene without mistakes on a device in checked mode; each test breaks one thing in it.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <string>
#include <vector>

namespace kaamos::checks::test {

struct TableSet {
  rtapi::DispatchRaysDesc desc;
  std::vector<rtapi::ShaderTable> tables;  // ray generation, miss, hit group, callable
};

class World : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override;
  // Options of the device but for its backend and checked mode.
  virtual rtapi::DeviceDesc device_desc() const { return {}; }

  // Buffers live as long as the test.
  rtapi::Buffer buffer(uint64_t bytes, const std::string& name, bool structure = false);
  template <class T>
  rtapi::Buffer upload(const std::vector<T>& elements, const std::string& name) {
    keep_.push_back(rtapi::CreateUploadBuffer(device_, elements, name).value());
    return keep_.back();
  }

  // `geometries` times the same triangle around (0, 0) at z = 0.
  std::vector<rtapi::RaytracingGeometryDesc> triangles(uint32_t geometries = 1);
  rtapi::RaytracingGeometryDesc box();
  rtapi::BuildRaytracingAccelerationStructureInputs bottom_inputs(
      const std::vector<rtapi::RaytracingGeometryDesc>& geometries,
      rtapi::RaytracingAccelerationStructureBuildFlags flags =
          rtapi::RaytracingAccelerationStructureBuildFlags::kNone);
  rtapi::BuildRaytracingAccelerationStructureInputs top_inputs(
      const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  rtapi::RaytracingInstanceDesc instance(const rtapi::Buffer& bottom, uint32_t contribution = 0);
  // Memory for a build; and a list that contains the build.
  rtapi::Buffer structure_for(const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
                              const std::string& name);
  void record_build(rtapi::CommandList& list, const rtapi::Buffer& dest,
                    const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
                    uint64_t source = 0);
  rtapi::Buffer build(const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
                      const std::string& name);
  // A bottom level "floor" and a top level "scene" with one instance of it.
  void build_scene(uint32_t geometries = 1, uint32_t contribution = 0);

  static rtapi::ShaderLibrary pipeline_library();
  rtapi::StateObject make_pipeline(
      const std::string& global = "SRV(t0), UAV(u0)",
      rtapi::RaytracingPipelineFlags flags = rtapi::RaytracingPipelineFlags::kNone);
  TableSet make_tables(const rtapi::StateObject& pipeline, const std::string& raygen = "RayGen",
                       const std::vector<std::string>& hits = {"Plain"},
                       const std::vector<std::string>& misses = {"Miss"});
  rtapi::LocalArgument data() { return rtapi::LocalArgument::Address(local_); }

  void record_dispatch(rtapi::CommandList& list, const rtapi::DispatchRaysDesc& desc);
  void dispatch(const rtapi::DispatchRaysDesc& desc);
  // Runs a shader of queries.hlsl against `top_`.
  void query(const std::string& shader);
  // Copies 16 bytes with a compute shader, because copy commands into structures are refused.
  void copy_bytes(const rtapi::Buffer& dest, const rtapi::Buffer& source);
  rtapi::CommandList list() { return device_.CreateCommandList().value(); }
  rtapi::Status execute(rtapi::CommandList& commands) { return queue_.ExecuteAndWait(commands); }

  // The messages of checked mode since the last call.
  std::vector<std::string> told();
  // There must be exactly one message, with this id and all parts in this order.
  void expect_one(const std::string& id, const std::vector<std::string>& parts);
  void expect_none();

  std::vector<rtapi::Message> messages_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature global_;
  rtapi::StateObject pipeline_;
  rtapi::Buffer bottom_, top_, results_, local_, vertices_;
  std::vector<rtapi::Buffer> keep_;
};

}  // namespace kaamos::checks::test
