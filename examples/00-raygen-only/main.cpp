// SPDX-License-Identifier: MIT
// The smallest DXR program: a root signature, a state object, a shader table with one record,
// DispatchRays.
#include <shaders/raygen.h>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const example::Image image = example::CreateImage(setup);

  // One parameter: a descriptor table with the image in register u0.
  const RootSignature root_signature =
      setup.device
          .CreateRootSignature(
              RootSignatureDesc{{RootParameter::Table({{.RangeType = DescriptorRangeType::kUav}})}})
          .value();

  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_raygen()).value(), {}});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 0});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = setup.device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline, "ray generation table");
  raygen_table.AddRecord("RayGen").value();
  raygen_table.Build(setup.device).value();

  CommandList list = setup.device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootDescriptorTable(0, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = raygen_table.GetRecord(0);
  dispatch.Width = setup.width;
  dispatch.Height = setup.height;
  list.DispatchRays(dispatch);
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "00-raygen-only", Render);
}
