// SPDX-License-Identifier: MIT
#include "kaamos/shader/bindings.h"

#include <cstring>
#include <initializer_list>

#include "kaamos/shader/bound.h"
#include "kaamos/shader/memory.h"
#include "kaamos/shader/system_values.h"
#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

struct ShaderBindings : testing::Test {
  Descriptor views[4];
  Descriptor samplers[2];
  alignas(8) uint8_t root[64] = {};
  alignas(8) uint8_t record[64] = {};
  BindingSlot slot;
  DispatchConstants dispatch;
  Invocation invocation;
  BoundResource bound;

  ShaderBindings() {
    for (uint32_t i = 0; i < 4; ++i) {
      views[i].kind = DescriptorKind::kRawBuffer;
      views[i].address = 0x1000 + i;
    }
    samplers[1].kind = DescriptorKind::kSampler;
    samplers[1].access = DescriptorAccess::kOther;
    dispatch.root_arguments = root;
    dispatch.view_heap_begin = views;
    dispatch.view_heap_end = views + 4;
    dispatch.sampler_heap_begin = samplers;
    dispatch.sampler_heap_end = samplers + 2;
    invocation.dispatch = &dispatch;
    invocation.slots = &slot;
    invocation.bound = &bound;
    invocation.local_arguments = record;
  }
  static void put(uint8_t* at, uint64_t value) { std::memcpy(at, &value, 8); }
  void set_table(const Descriptor* first) {
    slot.source = SlotSource::kDescriptorTable;
    slot.kind = DescriptorKind::kRawBuffer;
    slot.argument_offset = 8;
    put(root + 8, reinterpret_cast<uintptr_t>(first));
  }
  void bind_slot() {
    constexpr uint32_t kUsed = 0;
    bound = {};
    bind(invocation, &kUsed, 1, &bound);
  }
  // Looks up an element of the array as every shader does, and checks that ray shaders find the
  // same one bound.
  Descriptor element(uint32_t index) {
    const Descriptor looked_up = resource(invocation, 0, index);
    bind_slot();
    const Descriptor found = bound_array_element(invocation, 0, index);
    EXPECT_EQ(found.kind, looked_up.kind) << index;
    EXPECT_EQ(found.address, looked_up.address) << index;
    EXPECT_EQ(found.size_bytes, looked_up.size_bytes) << index;
    return looked_up;
  }
};

TEST_F(ShaderBindings, TablesCountFromTheirHandle) {
  set_table(views + 1);
  slot.descriptor_index = 1;
  slot.descriptor_count = 2;
  EXPECT_EQ(element(0).address, 0x1002u);
  EXPECT_EQ(element(1).address, 0x1003u);
  EXPECT_EQ(element(2).kind, DescriptorKind::kNull);  // past the range
}

TEST_F(ShaderBindings, UnboundedTablesEndWithTheHeap) {
  set_table(views + 1);
  slot.descriptor_count = kUnbounded;
  EXPECT_EQ(element(2).address, 0x1003u);
  for (const uint32_t index : {3u, 4u, 0x7FFFFFFFu, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
    EXPECT_EQ(element(index).kind, DescriptorKind::kNull) << index;
  }
}

TEST_F(ShaderBindings, WildHandlesAreNull) {
  set_table(views);
  slot.descriptor_count = 1;
  for (const uint64_t handle :
       {uint64_t{0}, uint64_t{1}, ~uint64_t{0}, uint64_t{reinterpret_cast<uintptr_t>(views)} + 8,
        uint64_t{reinterpret_cast<uintptr_t>(views)} - 32}) {
    put(root + 8, handle);
    EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull) << handle;
  }
}

TEST_F(ShaderBindings, WildHandlesOfArraysAreNull) {
  set_table(views);
  slot.descriptor_count = kUnbounded;
  for (const uint64_t handle :
       {uint64_t{0}, ~uint64_t{0}, uint64_t{reinterpret_cast<uintptr_t>(views)} + 8,
        uint64_t{reinterpret_cast<uintptr_t>(views + 4)}}) {
    put(root + 8, handle);
    for (const uint32_t index : {0u, 1u, 4u}) {
      EXPECT_EQ(element(index).kind, DescriptorKind::kNull) << handle;
    }
  }
  // A table that starts before the heap: its elements keep their places.
  put(root + 8, reinterpret_cast<uintptr_t>(views) - sizeof(Descriptor));
  EXPECT_EQ(element(0).kind, DescriptorKind::kNull);
  EXPECT_EQ(element(2).address, 0x1001u);
}

TEST_F(ShaderBindings, ElementsOfAnotherKindAreNull) {
  set_table(views);
  slot.descriptor_count = kUnbounded;
  views[1].kind = DescriptorKind::kTexture;
  views[2].access = DescriptorAccess::kUnorderedAccess;
  EXPECT_EQ(element(0).address, 0x1000u);
  EXPECT_EQ(element(1).kind, DescriptorKind::kNull);
  EXPECT_EQ(element(2).kind, DescriptorKind::kNull);
  EXPECT_EQ(element(3).address, 0x1003u);
  slot.local = true;  // in the shader record
  put(record + 8, reinterpret_cast<uintptr_t>(views + 3));
  EXPECT_EQ(element(0).address, 0x1003u);
}

// Without this, the tests above would say nothing about what is bound.
TEST_F(ShaderBindings, BoundElementsAreThoseOfTheHeap) {
  set_table(views + 1);
  slot.descriptor_count = kUnbounded;
  bind_slot();
  EXPECT_EQ(&bound_array_element(invocation, 0, 2), views + 3);
  set_table(samplers);
  slot.kind = DescriptorKind::kSampler;
  slot.access = DescriptorAccess::kOther;
  slot.descriptor_count = 2;
  bind_slot();
  EXPECT_EQ(&bound_array_element(invocation, 0, 1), samplers + 1);
}

TEST_F(ShaderBindings, WrongKindOrAccessIsNull) {
  set_table(views);
  slot.descriptor_count = 1;
  EXPECT_EQ(resource(invocation, 0).address, 0x1000u);
  slot.access = DescriptorAccess::kUnorderedAccess;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
  slot.access = DescriptorAccess::kShaderResource;
  slot.kind = DescriptorKind::kTexture;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
}

TEST_F(ShaderBindings, SamplersComeFromTheirHeapOrTheSlot) {
  set_table(samplers + 1);
  slot.kind = DescriptorKind::kSampler;
  slot.descriptor_count = 1;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kSampler);
  put(root + 8, reinterpret_cast<uintptr_t>(views));
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
  slot.source = SlotSource::kStaticSampler;
  slot.static_sampler = samplers + 1;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kSampler);
  slot.static_sampler = nullptr;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
}

TEST_F(ShaderBindings, RootConstantsAreAConstantBuffer) {
  slot.source = SlotSource::kRootConstants;
  slot.local = true;
  slot.argument_offset = 4;
  slot.size_bytes = 8;
  const uint32_t values[] = {1, 2, 3};
  std::memcpy(record + 4, values, sizeof(values));
  expect_components(load<uint4, Layout::kConstantBuffer>(resource(invocation, 0), 0), {1, 2, 0, 0});
  invocation.local_arguments = nullptr;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
}

TEST_F(ShaderBindings, RootDescriptorsHaveNoBounds) {
  slot.source = SlotSource::kRootDescriptor;
  slot.kind = DescriptorKind::kStructuredBuffer;
  slot.stride_bytes = 12;
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);  // address 0
  const uint32_t data[] = {1, 2, 3, 4, 5, 6};
  put(root, reinterpret_cast<uintptr_t>(data));
  const Descriptor d = resource(invocation, 0);
  EXPECT_EQ(d.size_bytes, ~uint64_t{0});
  expect_components(load_element<uint3>(d, 1, 0), {4, 5, 6});
  EXPECT_EQ(resource(invocation, 0, 1).kind, DescriptorKind::kNull);
}

// The HLSL declaration and the view may disagree: the view's stride counts.
TEST_F(ShaderBindings, BoundElementsStandAtTheStrideOfTheirView) {
  const uint32_t data[] = {1, 2, 3, 4, 5, 6, 7, 8};
  views[0].kind = DescriptorKind::kStructuredBuffer;
  views[0].address = reinterpret_cast<uintptr_t>(data);
  set_table(views);
  slot.kind = DescriptorKind::kStructuredBuffer;
  slot.descriptor_count = 1;
  slot.stride_bytes = 8;
  const auto expect_element = [&](uint32_t index, double first, double second) {
    for (const MemoryView& view :
         {bound_element_view<8>(invocation, 0, index), element_view<8>(bound, index)}) {
      expect_components(read<uint2, Layout::kStructured, false>(view, 0), {first, second});
    }
  };
  for (const uint32_t stride : {8u, 12u, 4u}) {
    const double at = 1 + stride / 4;  // word i contains i + 1
    views[0].stride_bytes = stride;
    views[0].size_bytes = 24;
    bind_slot();
    expect_element(1, at, stride < 8 ? 0 : at + 1);
    expect_element(24 / stride, 0, 0);
    views[0].size_bytes = stride + 4;  // the second element is cut off
    bind_slot();
    expect_element(1, at, 0);
  }
}

TEST_F(ShaderBindings, UnboundIsNullAndHeapsAreBounded) {
  EXPECT_EQ(resource(invocation, 0).kind, DescriptorKind::kNull);
  EXPECT_EQ(heap_resource(invocation, 3, false).address, 0x1003u);
  EXPECT_EQ(heap_resource(invocation, 4, false).kind, DescriptorKind::kNull);
  EXPECT_EQ(heap_resource(invocation, 1, true).kind, DescriptorKind::kSampler);
  EXPECT_EQ(heap_resource(invocation, 0xFFFFFFFFu, true).kind, DescriptorKind::kNull);
}

TEST(ShaderSystemValues, ObjectSpaceFollowsTheTransform) {
  // Object to world: scales by 2, then moves by (10, 20, 30).
  const float to_world[12] = {2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30};
  const float to_object[12] = {0.5f, 0, 0, -5, 0, 0.5f, 0, -10, 0, 0, 0.5f, -15};
  RaySystemValues ray = {};
  ray.ray = {{12, 20, 30}, 0, {0, 4, 0}, 100};
  ray.object_to_world = to_world;
  ray.world_to_object = to_object;
  Invocation invocation;
  invocation.ray = &ray;
  expect_components(object_ray_origin(invocation), {1, 0, 0});
  expect_components(object_ray_direction(invocation), {0, 2, 0});
  expect_components(object_to_world_4x3(invocation), {2, 0, 0, 0, 2, 0, 0, 0, 2, 10, 20, 30});
  expect_components(world_to_object_3x4(invocation),
                    {0.5, 0, 0, -5, 0, 0.5, 0, -10, 0, 0, 0.5, -15});
}

TEST(ShaderSystemValues, ThreadIdsCombineGroupAndThread) {
  ComputeGroup group;
  group.group_id[0] = 2;
  group.group_id[1] = 3;
  const uint32_t size[3] = {8, 4, 1}, thread[3] = {5, 1, 0};
  expect_components(dispatch_thread_id<uint3>(group, size, thread), {21, 13, 0});
  expect_components(dispatch_thread_id<int2>(group, size, thread), {21, 13});
  EXPECT_EQ(dispatch_thread_id<uint32_t>(group, size, thread), 21u);
  expect_components(group_value<uint3>(group.group_id), {2, 3, 0});
}

}  // namespace
}  // namespace kaamos::shader
