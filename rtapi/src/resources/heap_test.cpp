// SPDX-License-Identifier: MIT
#include <rtapi/heap.h>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

using testing::CreateNullDevice;

constexpr uint64_t kKiB = 1024;
constexpr uint64_t kMiB = 1024 * kKiB;

TextureDesc square(uint32_t side, ResourceFlags flags = ResourceFlags::kNone) {
  TextureDesc desc;
  desc.Dimension = ResourceDimension::kTexture2D;
  desc.Width = desc.Height = side;
  desc.Format = Format::kR8G8B8A8Unorm;
  desc.MipLevels = 1;
  desc.Flags = flags;
  desc.Name = "picture";
  return desc;
}

class HeapTest : public ::testing::Test {
 protected:
  ResourceAllocationInfo info(const TextureDesc& desc, uint64_t alignment = 0) {
    return GetResourceAllocationInfo(device_, desc, alignment).value();
  }

  Device device_ = CreateNullDevice();
  Heap heap_ = CreateHeap(device_, {.SizeInBytes = kMiB, .Name = "frame"}).value();
};

TEST_F(HeapTest, SizeAndTypeAreChecked) {
  EXPECT_ERROR(CreateHeap(device_, {.SizeInBytes = 0, .Name = "h"}), "KA0576", "\"h\" has 0 bytes");
  EXPECT_ERROR(CreateHeap(device_, {.SizeInBytes = (uint64_t{1} << 40) + 1}), "KA0576", "2^40");
  EXPECT_ERROR(CreateHeap(device_, {.SizeInBytes = 1, .Type = static_cast<HeapType>(5)}), "KA0576",
               "type 5");
  EXPECT_ERROR(CreateHeap({}, {.SizeInBytes = 1}), "KA0904");
  EXPECT_ERROR(OpenHeap({}, heap_), "KA0904");
  EXPECT_ERROR(OpenHeap(device_, {}), "KA0904");
  EXPECT_EQ(OpenHeap(CreateNullDevice(), heap_)->GetDesc().Name, "frame");
}

TEST_F(HeapTest, BuffersLieInTheHeapAtMultiplesOf64KiB) {
  EXPECT_TRUE(CreatePlacedResource(heap_, kMiB - 64 * kKiB, BufferDesc{.SizeInBytes = 1}).ok());
  EXPECT_ERROR(CreatePlacedResource(heap_, 4 * kKiB, BufferDesc{.SizeInBytes = 1, .Name = "b"}),
               "KA0576", "\"b\" is placed at byte 4096 of heap \"frame\"", "a multiple of 65536");
  EXPECT_ERROR(CreatePlacedResource(heap_, 0, BufferDesc{.SizeInBytes = kMiB + 1}), "KA0576",
               "takes 1114112", "has 1048576");
  EXPECT_ERROR(
      CreatePlacedResource(heap_, 0, BufferDesc{.SizeInBytes = 1, .Heap = HeapType::kUpload}),
      "KA0576", "heap type 2");
  EXPECT_ERROR(CreatePlacedResource(heap_, 0, BufferDesc{.SizeInBytes = 0}), "KA0905");
  EXPECT_ERROR(CreatePlacedResource({}, 0, BufferDesc{.SizeInBytes = 1}), "KA0904");
}

TEST_F(HeapTest, TexturesTakeWhatTheirInfoSays) {
  EXPECT_EQ(info(square(256)).SizeInBytes, 256 * kKiB);
  EXPECT_EQ(info(square(256)).Alignment, 64 * kKiB);
  EXPECT_EQ(info(square(16)).SizeInBytes, 64 * kKiB);
  EXPECT_TRUE(CreatePlacedResource(heap_, 768 * kKiB, square(256)).ok());
  EXPECT_ERROR(CreatePlacedResource(heap_, 832 * kKiB, square(256)), "KA0576", "takes 262144");
  EXPECT_ERROR(CreatePlacedResource(heap_, 0, square(0)), "KA0908");
}

// [D3D12: D3D12_RESOURCE_DESC, Alignment]
TEST_F(HeapTest, SmallTexturesThatAreNoTargetsMayHave4KiB) {
  EXPECT_EQ(info(square(128), 4 * kKiB).Alignment, 4 * kKiB);
  EXPECT_EQ(info(square(33), 4 * kKiB).SizeInBytes, 8 * kKiB);
  EXPECT_ERROR(GetResourceAllocationInfo(device_, square(129), 4 * kKiB), "KA0576",
               "alignment 4096; it is 0 or 65536");
  EXPECT_ERROR(
      GetResourceAllocationInfo(device_, square(16, ResourceFlags::kAllowRenderTarget), 4 * kKiB),
      "KA0576");
  EXPECT_ERROR(GetResourceAllocationInfo(device_, square(16), 8 * kKiB), "KA0576",
               "0 or 65536 or 4096");
}

TEST_F(HeapTest, MultisampledTexturesHave4MiBOr64KiB) {
  TextureDesc desc = square(64, ResourceFlags::kAllowRenderTarget);
  desc.SampleDesc.Count = 4;
  EXPECT_EQ(info(desc).Alignment, 4 * kMiB);
  EXPECT_EQ(info(desc, 64 * kKiB).SizeInBytes, 64 * kKiB);
  desc.Width = desc.Height = 512;
  EXPECT_EQ(info(desc, 64 * kKiB).SizeInBytes, 4 * kMiB) << "64 tiles";
  desc.Width = 513;
  EXPECT_ERROR(GetResourceAllocationInfo(device_, desc, 64 * kKiB), "KA0576", "several samples");
}

TEST_F(HeapTest, AnOpenedFenceHasTheValueOfTheFirst) {
  const Device other = CreateNullDevice();
  const Fence here = device_.CreateFence(1).value();
  const Fence there = OpenFence(other, here).value();
  EXPECT_EQ(there.GetCompletedValue(), 1u);
  EXPECT_OK(other.CreateCommandQueue()->Signal(there, 5));
  EXPECT_EQ(here.GetCompletedValue(), 5u);
  EXPECT_ERROR(other.CreateCommandQueue()->Signal(here, 6), "KA0903");
  int calls = 0;
  EXPECT_OK(there.CallAt(7, [&] { ++calls; }));
  EXPECT_OK(here.Signal(7));
  EXPECT_EQ(calls, 1);
  EXPECT_ERROR(OpenFence(other, {}), "KA0904");
}

}  // namespace
}  // namespace rtapi
