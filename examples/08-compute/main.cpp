// SPDX-License-Identifier: MIT
// Compute pipelines, groupshared memory and barriers.
#include <shaders/blur.h>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup, 2);
  const example::Image blurred = example::CreateImage(setup);
  device.CreateUnorderedAccessView(blurred.texture, image.heap.GetCPUDescriptorHandle(1)).value();

  const RootSignature root_signature = device
                                           .CreateRootSignature(
                                               "DescriptorTable(UAV(u0, numDescriptors = 2)), "
                                               "RootConstants(num32BitConstants = 3, b0)")
                                           .value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_blur()).value();
  const PipelineState draw =
      device.CreateComputePipelineState({root_signature, library, "Draw", "draw"}).value();
  const PipelineState blur =
      device.CreateComputePipelineState({root_signature, library, "BlurRows", "blur rows"}).value();

  struct Constants {
    uint32_t size[2];
    int32_t radius;
  };
  const Constants constants = {{setup.width, setup.height}, 32};

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootDescriptorTable(0, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetComputeRoot32BitConstants(1, constants);
  list.SetPipelineState(draw);
  list.Dispatch((setup.width + 7) / 8, (setup.height + 7) / 8, 1);
  list.ResourceBarrier(ResourceBarrier::Uav(image.texture));
  list.SetPipelineState(blur);
  list.Dispatch((setup.width + 63) / 64, setup.height, 1);
  setup.queue.ExecuteAndWait(list).value();
  return blurred.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "08-compute", Render);
}
