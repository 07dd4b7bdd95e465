// SPDX-License-Identifier: MIT
//
// A scene and shaders for which every pixel's result can be computed in integers: the driver must
// give that result, however often and from however many threads it is asked.
//
// The scene is a grid of kCells x kCells cells with one triangle in each; each layer holds one
// instance of the grid, and behind the layers there is one box per cell. A cell's ray goes through
// the middle of its triangles. Any-hit and intersection shaders reject some of them by a hash; the
// closest-hit shader calls a callable and traces the same ray again, one level deeper.
#pragma once

#include <map>
#include <string>

#include "tests/vulkan/raw_gpu.h"

namespace stress {

constexpr uint32_t kCells = 24;
constexpr uint32_t kLayers = 3;

// The data that the shaders read by address: `block` in the GLSL.
struct Block {
  uint64_t top_level = 0;
  uint64_t output = 0;  // uvec4 for each ray
  uint64_t salts = 0;   // uint for each layer, and one for the boxes
  uint64_t counters = 0;
  uint32_t dimensions[3] = {};
  uint32_t depth = 0;      // nested traces after the first one
  uint32_t callables = 0;  // nested calls
  uint32_t seed = 0;
  uint32_t ray_flags = 0;
  uint32_t hit_groups = 1;  // per layer; the number of a cell chooses one
  uint32_t cells = kCells;
  uint32_t images = 0;
};

enum Kind {
  kRaygen,
  kMiss,
  kClosestHit,
  kAnyHit,
  kIntersection,
  kCallable,
  kGarbageRaygen,
  kCompute
};

// The modules, compiled once per process for each payload size.
constexpr uint32_t kPayloadRest = 12;
const std::map<Kind, std::vector<uint32_t>>& modules(uint32_t payload_rest = kPayloadRest);

// A constant of the ray generation, closest-hit, miss and callable shaders: where the word that
// they mix in comes from. 0: their specialization constant 1; 1: the shader record.
struct Variant {
  uint32_t hit_groups = 1;
  uint32_t callables = 2;
  bool from_record = true;
  uint32_t constant = 11;
  uint32_t recursion = 31;
  uint32_t payload_rest = kPayloadRest;  // words
  // Every null_every-th record of each table, beginning with the second, has an identifier of
  // zeros: hits on it are accepted and nothing runs. 0: none.
  uint32_t null_every = 0;
  bool garbage_rays = false;  // rays of random bits; there is no expected result
};

struct Program {
  raw::Pipeline pipeline;
  raw::Buffer table;
  Variant variant;
  VkStridedDeviceAddressRegionKHR raygen{}, miss{}, hit{}, callable{};
};
Program create_program(raw::Gpu& gpu, const Variant& variant, uint32_t stride = 64);
void free(raw::Gpu& gpu, Program& program);

struct Scene {
  raw::Accel triangles, boxes, top;
  raw::Buffer vertices, indices, box_data, instance_data, block, salts, counters;
  raw::AccelInput triangle_input, box_input, top_input;
};
// `hit_groups` must match the program's.
Scene create_scene(raw::Gpu& gpu, uint32_t seed, uint32_t hit_groups = 1);
void free(raw::Gpu& gpu, Scene& scene);
void build(VkCommandBuffer list, raw::Gpu& gpu, Scene& scene, bool update = false);

void dispatch(VkCommandBuffer list, raw::Gpu& gpu, const Program& program, const raw::Buffer& block,
              uint32_t width, uint32_t height, uint32_t depth);

// The result of ray `index`, computed on the CPU.
uint32_t expected(const Block& block, const Variant& variant, const uint32_t* salts,
                  uint32_t index);

// The image that thread `index` of the compute shader reads.
uint32_t image_slot(uint32_t index, uint32_t seed, uint32_t images);

// Fills a block, runs one dispatch and compares every ray. Returns the first difference; empty if
// there is none.
struct Launch {
  uint32_t width = 64, height = 8, slices = 1;
  uint32_t depth = 0, callables = 0, seed = 12345;
};
std::string run_and_compare(raw::Gpu& gpu, Scene& scene, const Program& program,
                            const Launch& launch);

}  // namespace stress
