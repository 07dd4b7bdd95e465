// SPDX-License-Identifier: MIT
#include "tests/vulkan/stress_scene.h"

#include <volk.h>

#include <cstring>
#include <mutex>

#include "tests/vulkan/stress_shaders.h"

namespace stress {
namespace {

constexpr uint32_t kRaygenWord = 1000;
constexpr uint32_t kMissWord = 2000;
constexpr uint32_t kHitWord = 3000;
constexpr uint32_t kCallableWord = 4000;

uint32_t mixed(uint32_t a, uint32_t b) {
  uint32_t h = (a ^ (b * 0x9E3779B9u)) * 0x85EBCA6Bu;
  h ^= h >> 13;
  h *= 0xC2B2AE35u;
  return h ^ (h >> 16);
}

uint32_t word(const Variant& variant, uint32_t record_word) {
  return variant.from_record ? record_word : variant.constant;
}

bool is_null(const Variant& variant, uint32_t record) {
  return variant.null_every != 0 && record % variant.null_every == 1;
}

uint32_t call(const Block& block, const Variant& variant, uint32_t depth, uint32_t value) {
  const uint32_t record = (value & 1) % variant.callables;
  if (is_null(variant, record)) return value;
  value = mixed(value * 5, word(variant, kCallableWord + record));
  if (depth < block.callables) value = mixed(call(block, variant, depth + 1, value), depth);
  return value;
}

uint32_t trace(const Block& block, const Variant& variant, const uint32_t* salts, uint32_t cell,
               uint32_t depth, uint32_t value) {
  const auto group_of = [&](uint32_t layer) {
    return layer * block.hit_groups + cell % block.hit_groups;
  };
  uint32_t layer = 0;
  while (layer < kLayers && !is_null(variant, group_of(layer)) &&
         (mixed(cell, salts[layer]) & 1) != 0) {
    ++layer;
  }
  const uint32_t group = group_of(layer);
  uint32_t kind = 0;
  if (layer < kLayers) {
    if (is_null(variant, group)) return value;
  } else {
    if (is_null(variant, group) || (mixed(cell, salts[layer]) & 2) == 0) {
      return mixed(value * 17, word(variant, kMissWord));
    }
    kind = 5;
  }
  value = mixed(value * 31 + layer * 7 + cell, word(variant, kHitWord + group)) + kind;
  if (block.callables > 0) value = call(block, variant, 1, value);
  if (depth < block.depth) {
    value = mixed(trace(block, variant, salts, cell, depth + 1, value), depth);
  }
  return value;
}

template <class T>
raw::Buffer upload(raw::Gpu& gpu, const std::vector<T>& values) {
  raw::Buffer result = gpu.buffer(std::max<size_t>(values.size() * sizeof(T), 16));
  std::memcpy(result.data, values.data(), values.size() * sizeof(T));
  return result;
}

}  // namespace

const std::map<Kind, std::vector<uint32_t>>& modules(uint32_t payload_rest) {
  static std::mutex mutex;
  static std::map<uint32_t, std::map<Kind, std::vector<uint32_t>>> for_payloads;
  const std::lock_guard lock(mutex);
  std::map<Kind, std::vector<uint32_t>>& all = for_payloads[payload_rest];
  if (all.empty()) {
    const std::string common =
        "#version 460\n#define REST " + std::to_string(payload_rest) + kCommon;
    const std::string record = common + kRecord;
    all[kRaygen] = raw::compile(VK_SHADER_STAGE_RAYGEN_BIT_KHR, record + kRaygenText);
    all[kMiss] = raw::compile(VK_SHADER_STAGE_MISS_BIT_KHR, record + kMissText);
    all[kClosestHit] = raw::compile(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, record + kClosestHitText);
    all[kAnyHit] = raw::compile(VK_SHADER_STAGE_ANY_HIT_BIT_KHR, record + kAnyHitText);
    all[kIntersection] =
        raw::compile(VK_SHADER_STAGE_INTERSECTION_BIT_KHR, record + kIntersectionText);
    all[kCallable] = raw::compile(VK_SHADER_STAGE_CALLABLE_BIT_KHR, record + kCallableText);
    all[kGarbageRaygen] = raw::compile(VK_SHADER_STAGE_RAYGEN_BIT_KHR, record + kGarbageRaygenText);
    all[kCompute] = raw::compile(VK_SHADER_STAGE_COMPUTE_BIT, common + kComputeText);
  }
  return all;
}

Program create_program(raw::Gpu& gpu, const Variant& variant, uint32_t stride) {
  const auto& spirv = modules(variant.payload_rest);
  const std::vector<std::pair<uint32_t, uint32_t>> constants = {{0, variant.from_record ? 1u : 0u},
                                                                {1, variant.constant}};
  std::vector<raw::Stage> stages = {
      {VK_SHADER_STAGE_RAYGEN_BIT_KHR, &spirv.at(variant.garbage_rays ? kGarbageRaygen : kRaygen),
       constants},
      {VK_SHADER_STAGE_MISS_BIT_KHR, &spirv.at(kMiss), constants},
      {VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, &spirv.at(kClosestHit), constants},
      {VK_SHADER_STAGE_ANY_HIT_BIT_KHR, &spirv.at(kAnyHit), constants}};
  std::vector<raw::Group> groups;
  const auto push = [](int general, int closest, int any, int intersection) {
    raw::Group group;
    group.general = general;
    group.closest_hit = closest;
    group.any_hit = any;
    group.intersection = intersection;
    return group;
  };
  groups.push_back(push(0, -1, -1, -1));
  groups.push_back(push(1, -1, -1, -1));
  const uint32_t triangle_groups = kLayers * variant.hit_groups;
  for (uint32_t i = 0; i < triangle_groups; ++i) groups.push_back(push(-1, 2, 3, -1));
  // B2: each group gets an intersection stage of its own.
  for (uint32_t i = 0; i < variant.hit_groups; ++i) {
    groups.push_back(push(-1, 2, -1, static_cast<int>(stages.size())));
    stages.push_back({VK_SHADER_STAGE_INTERSECTION_BIT_KHR, &spirv.at(kIntersection), constants});
  }
  for (uint32_t i = 0; i < variant.callables; ++i) {
    groups.push_back(push(static_cast<int>(stages.size()), -1, -1, -1));
    stages.push_back({VK_SHADER_STAGE_CALLABLE_BIT_KHR, &spirv.at(kCallable), constants});
  }

  Program program;
  program.variant = variant;
  program.pipeline = gpu.pipeline(stages, groups, variant.recursion);
  const uint32_t hit_count = (kLayers + 1) * variant.hit_groups;
  const uint32_t records = 2 + hit_count + variant.callables;
  // Records, followed by the words that they point to.
  const uint64_t words = static_cast<uint64_t>(records) * stride + 4 * stride;
  program.table = gpu.buffer(words + records * 4);
  uint64_t place = 0;
  uint32_t group = 0;
  const auto region = [&](uint32_t count, uint32_t word) {
    const VkStridedDeviceAddressRegionKHR result{program.table.address + place, stride,
                                                 static_cast<VkDeviceSize>(count) * stride};
    for (uint32_t i = 0; i < count; ++i, ++group, place += stride) {
      uint8_t* record = program.table.data + place;
      if (!is_null(variant, i) || group < 2)
        std::memcpy(record, program.pipeline.handles.data() + group * gpu.handle_size(),
                    gpu.handle_size());
      const uint64_t argument = program.table.address + words + group * 4;
      std::memcpy(record + gpu.handle_size(), &argument, 8);
      const uint32_t value = word + i;
      std::memcpy(program.table.data + words + group * 4, &value, 4);
    }
    place = (place + 63) / 64 * 64;
    return result;
  };
  program.raygen = region(1, kRaygenWord);
  program.miss = region(1, kMissWord);
  program.hit = region(hit_count, kHitWord);
  program.callable = region(variant.callables, kCallableWord);
  return program;
}

void free(raw::Gpu& gpu, Program& program) {
  gpu.free(program.pipeline.pipeline);
  gpu.free(program.table);
}

Scene create_scene(raw::Gpu& gpu, uint32_t seed, uint32_t hit_groups) {
  Scene scene;
  std::vector<float> positions;
  std::vector<uint32_t> corners;
  std::vector<float> boxes;
  for (uint32_t cell = 0; cell < kCells * kCells; ++cell) {
    const float x = static_cast<float>(cell % kCells);
    const float y = static_cast<float>(cell / kCells);
    const float corner[3][2] = {{0.1f, 0.1f}, {0.9f, 0.1f}, {0.5f, 0.9f}};
    for (uint32_t i = 0; i < 3; ++i) {
      corners.push_back(static_cast<uint32_t>(positions.size() / 3));
      positions.insert(positions.end(), {x + corner[i][0], y + corner[i][1], 0});
    }
    boxes.insert(boxes.end(), {x + 0.1f, y + 0.1f, 99, x + 0.9f, y + 0.9f, 101});
  }
  scene.vertices = upload(gpu, positions);
  scene.indices = upload(gpu, corners);
  scene.box_data = upload(gpu, boxes);
  scene.block = gpu.buffer(sizeof(Block));
  scene.counters = gpu.buffer(64);
  std::vector<uint32_t> salts;
  for (uint32_t i = 0; i <= kLayers; ++i) salts.push_back(mixed(seed, i + 1));
  scene.salts = upload(gpu, salts);

  scene.triangle_input.flags = VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
  scene.triangle_input.geometries = {
      raw::triangles(scene.vertices.address, static_cast<uint32_t>(positions.size() / 3),
                     scene.indices.address, VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR)};
  scene.triangle_input.counts = {kCells * kCells};
  scene.triangles = gpu.accel(scene.triangle_input);
  scene.box_input.geometries = {raw::boxes(scene.box_data.address, 0)};
  scene.box_input.counts = {kCells * kCells};
  scene.boxes = gpu.accel(scene.box_input);

  std::vector<VkAccelerationStructureInstanceKHR> instances(kLayers + 1);
  for (uint32_t i = 0; i <= kLayers; ++i) {
    VkAccelerationStructureInstanceKHR& instance = instances[i];
    for (int row = 0; row < 3; ++row) instance.transform.matrix[row][row] = 1;
    instance.transform.matrix[2][3] = i == kLayers ? 0.0f : static_cast<float>(2 * i + 1);
    instance.instanceCustomIndex = i;
    instance.mask = 0xFF;
    instance.instanceShaderBindingTableRecordOffset = i * hit_groups;
    instance.accelerationStructureReference =
        i == kLayers ? scene.boxes.address : scene.triangles.address;
  }
  scene.instance_data = upload(gpu, instances);
  scene.top_input.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  scene.top_input.flags = VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
  scene.top_input.geometries = {raw::instances(scene.instance_data.address)};
  scene.top_input.counts = {kLayers + 1};
  scene.top = gpu.accel(scene.top_input);
  return scene;
}

void build(VkCommandBuffer list, raw::Gpu& gpu, Scene& scene, bool update) {
  gpu.build(list, scene.triangles, scene.triangle_input, update);
  if (!update) gpu.build(list, scene.boxes, scene.box_input);
  gpu.build(list, scene.top, scene.top_input, update);
}

void free(raw::Gpu& gpu, Scene& scene) {
  for (raw::Accel* accel : {&scene.triangles, &scene.boxes, &scene.top}) gpu.free(*accel);
  for (raw::Buffer* buffer : {&scene.vertices, &scene.indices, &scene.box_data,
                              &scene.instance_data, &scene.block, &scene.salts, &scene.counters}) {
    gpu.free(*buffer);
  }
}

void dispatch(VkCommandBuffer list, raw::Gpu& gpu, const Program& program, const raw::Buffer& block,
              uint32_t width, uint32_t height, uint32_t depth) {
  const VkDescriptorSet set = gpu.descriptors();
  vkCmdBindPipeline(list, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline.pipeline);
  vkCmdBindDescriptorSets(list, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, gpu.layout(), 0, 1, &set, 0,
                          nullptr);
  vkCmdPushConstants(list, gpu.layout(), VK_SHADER_STAGE_ALL, 0, 8, &block.address);
  vkCmdTraceRaysKHR(list, &program.raygen, &program.miss, &program.hit, &program.callable, width,
                    height, depth);
}

uint32_t expected(const Block& block, const Variant& variant, const uint32_t* salts,
                  uint32_t index) {
  return trace(block, variant, salts, index % (kCells * kCells), 0, block.seed);
}

uint32_t image_slot(uint32_t index, uint32_t seed, uint32_t images) {
  return mixed(index, seed) % images;
}

std::string run_and_compare(raw::Gpu& gpu, Scene& scene, const Program& program,
                            const Launch& launch) {
  const uint64_t rays = static_cast<uint64_t>(launch.width) * launch.height * launch.slices;
  raw::Buffer output = gpu.buffer(std::max<uint64_t>(rays * 16, 16));
  std::memset(output.data, 0xCD, output.size_bytes);
  Block block;
  block.top_level = scene.top.address;
  block.output = output.address;
  block.salts = scene.salts.address;
  block.counters = scene.counters.address;
  block.depth = launch.depth;
  block.callables = launch.callables;
  block.seed = launch.seed;
  block.hit_groups = program.variant.hit_groups;
  std::memcpy(scene.block.data, &block, sizeof block);
  gpu.run([&](VkCommandBuffer list) {
    dispatch(list, gpu, program, scene.block, launch.width, launch.height, launch.slices);
  });
  std::string difference;
  for (uint64_t i = 0; i < rays && difference.empty(); ++i) {
    const uint32_t* got = output.as<uint32_t>() + i * 4;
    const uint32_t index = static_cast<uint32_t>(i);
    const uint32_t value = expected(block, program.variant, scene.salts.as<uint32_t>(), index);
    const uint32_t generated = mixed(index, word(program.variant, kRaygenWord));
    if (got[0] != value || got[1] != generated || got[2] != 1 || got[3] != index) {
      difference = "ray " + std::to_string(i) + " of " + std::to_string(launch.width) + "x" +
                   std::to_string(launch.height) + "x" + std::to_string(launch.slices) + ": " +
                   std::to_string(got[0]) + " " + std::to_string(got[1]) + " " +
                   std::to_string(got[2]) + " " + std::to_string(got[3]) + ", expected " +
                   std::to_string(value) + " " + std::to_string(generated) + " 1 " +
                   std::to_string(index);
    }
  }
  gpu.free(output);
  return difference;
}

}  // namespace stress
