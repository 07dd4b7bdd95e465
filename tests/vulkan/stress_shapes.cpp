// SPDX-License-Identifier: MIT
#include "tests/vulkan/stress_shapes.h"

#include <volk.h>

#include <chrono>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

#include "tests/vulkan/stress_scene.h"

namespace stress {
namespace {

using Random = std::mt19937;

uint32_t below(Random& random, uint32_t limit) {
  return static_cast<uint32_t>(random() % limit);
}

class Clock {
 public:
  explicit Clock(double seconds) : end_(now() + seconds) {}
  // At least one round, whatever the time.
  bool goes_on() { return first_ ? (first_ = false, true) : now() < end_; }

 private:
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  double end_;
  bool first_ = true;
};

// One scene and one program on a device of their own, with launches chosen by `next`.
std::string launches(uint32_t seed, double seconds, const Variant& variant, uint32_t stride,
                     Launch (*next)(Random&)) {
  raw::Gpu gpu;
  Random random(seed);
  Scene scene = create_scene(gpu, seed, variant.hit_groups);
  Program program = create_program(gpu, variant, stride);
  gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    problem = run_and_compare(gpu, scene, program, next(random));
  }
  free(gpu, program);
  free(gpu, scene);
  return problem;
}

std::string six_stages(uint32_t seed, double seconds) {
  return launches(seed, seconds, {}, 64, [](Random& random) {
    Launch launch;
    launch.depth = below(random, 4);
    launch.callables = below(random, 4);
    launch.seed = static_cast<uint32_t>(random());
    return launch;
  });
}

std::string recursion_to_31(uint32_t seed, double seconds) {
  return launches(seed, seconds, {}, 64, [](Random& random) {
    Launch launch;
    launch.depth = 30 - below(random, 3);
    launch.callables = below(random, 2);
    launch.seed = static_cast<uint32_t>(random());
    return launch;
  });
}

std::string callables_to_31(uint32_t seed, double seconds) {
  return launches(seed, seconds, {}, 64, [](Random& random) {
    Launch launch;
    launch.depth = below(random, 2);
    launch.callables = 31 - below(random, 3);
    launch.seed = static_cast<uint32_t>(random());
    return launch;
  });
}

std::string odd_sizes(uint32_t seed, double seconds) {
  return launches(seed, seconds, {}, 64, [](Random& random) {
    static constexpr uint32_t kSizes[][3] = {{1, 1, 1},    {2, 1, 1}, {7, 3, 1},     {9, 1, 1},
                                             {1, 9, 1},    {1, 1, 9}, {33, 5, 7},    {4097, 3, 1},
                                             {1, 7001, 1}, {0, 4, 1}, {4, 0, 1},     {4, 4, 0},
                                             {3, 1, 65},   {8, 1, 1}, {20001, 1, 1}, {17, 17, 2}};
    const uint32_t* size = kSizes[below(random, 16)];
    Launch launch;
    launch.width = size[0];
    launch.height = size[1];
    launch.slices = size[2];
    launch.depth = below(random, 2);
    return launch;
  });
}

std::string many_hit_groups(uint32_t seed, double seconds) {
  Variant variant;
  variant.hit_groups = 1 + seed % 15;
  variant.callables = 2 + seed % 30;
  const uint32_t strides[] = {48, 64, 96, 4096};
  // 48 is not a multiple of the base alignment, which is fine for regions that do not start inside
  // a table.
  return launches(seed, seconds, variant, strides[1 + seed % 3], [](Random& random) {
    Launch launch;
    launch.depth = below(random, 3);
    launch.callables = below(random, 3);
    return launch;
  });
}

std::string null_records(uint32_t seed, double seconds) {
  Variant variant;
  variant.hit_groups = 2 + seed % 7;
  variant.callables = 2;
  variant.null_every = 2 + seed % 3;
  return launches(seed, seconds, variant, 64, [](Random& random) {
    Launch launch;
    launch.depth = below(random, 4);
    launch.callables = below(random, 4);
    launch.seed = static_cast<uint32_t>(random());
    return launch;
  });
}

// 4 KiB payloads in each of 31 nested traces.
std::string large_payloads(uint32_t seed, double seconds) {
  Variant variant;
  variant.payload_rest = 1000;
  return launches(seed, seconds, variant, 64, [](Random& random) {
    Launch launch;
    launch.height = 2;
    launch.depth = below(random, 31);
    launch.seed = static_cast<uint32_t>(random());
    return launch;
  });
}

std::string garbage_rays(uint32_t seed, double seconds) {
  raw::Gpu gpu;
  Random random(seed);
  Variant variant;
  variant.garbage_rays = true;
  Scene scene = create_scene(gpu, seed);
  Program program = create_program(gpu, variant);
  raw::Buffer output = gpu.buffer(4096 * 16);
  Block block;
  block.output = output.address;
  block.top_level = scene.top.address;
  block.salts = scene.salts.address;
  block.counters = scene.counters.address;
  gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    block.seed = static_cast<uint32_t>(random());
    std::memcpy(scene.block.data, &block, sizeof block);
    gpu.run([&](VkCommandBuffer list) { dispatch(list, gpu, program, scene.block, 64, 64, 1); });
    for (uint32_t i = 0; i < 4096; ++i) {
      if (output.as<uint32_t>()[i * 4 + 3] != i) problem = "ray " + std::to_string(i) + " is lost";
    }
  }
  free(gpu, program);
  free(gpu, scene);
  gpu.free(output);
  return problem;
}

// A module with different constants each time, so that no cache has any of it.
std::string specialization(uint32_t seed, double seconds) {
  raw::Gpu gpu;
  Random random(seed);
  Scene scene = create_scene(gpu, seed);
  gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
  std::vector<Program> alive;
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    Variant variant;
    variant.from_record = false;
    variant.constant = static_cast<uint32_t>(random());
    alive.push_back(create_program(gpu, variant));
    Launch launch;
    launch.callables = 2;
    for (Program& program : alive) {
      if (problem.empty()) problem = run_and_compare(gpu, scene, program, launch);
    }
    while (alive.size() > below(random, 5)) {
      free(gpu, alive.back());
      alive.pop_back();
    }
  }
  for (Program& program : alive) free(gpu, program);
  free(gpu, scene);
  return problem;
}

// Builds, updates, rebuilds and traces in one command buffer.
std::string rebuilds(uint32_t seed, double seconds) {
  raw::Gpu gpu;
  Random random(seed);
  Scene scene = create_scene(gpu, seed);
  Program program = create_program(gpu, {});
  gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    const uint32_t builds = 1 + below(random, 4);
    const uint32_t kinds = static_cast<uint32_t>(random());
    gpu.run([&](VkCommandBuffer list) {
      for (uint32_t i = 0; i < builds; ++i) build(list, gpu, scene, (kinds >> i & 1) != 0);
    });
    Launch launch;
    launch.depth = 1;
    problem = run_and_compare(gpu, scene, program, launch);
  }
  free(gpu, program);
  free(gpu, scene);
  return problem;
}

std::string once(raw::Gpu& gpu, Random& random) {
  Scene scene = create_scene(gpu, static_cast<uint32_t>(random()));
  Program program = create_program(gpu, {});
  gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
  Launch launch;
  launch.depth = below(random, 3);
  launch.callables = below(random, 3);
  launch.seed = static_cast<uint32_t>(random());
  const std::string problem = run_and_compare(gpu, scene, program, launch);
  free(gpu, program);
  free(gpu, scene);
  return problem;
}

std::string create_and_destroy(uint32_t seed, double seconds) {
  raw::Gpu gpu;
  Random random(seed);
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) problem = once(gpu, random);
  return problem;
}

std::string devices_in_turn(uint32_t seed, double seconds) {
  Random random(seed);
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    raw::Gpu gpu;
    problem = once(gpu, random);
  }
  return problem;
}

// Runs `work` on four threads and returns the first problem.
std::string on_threads(uint32_t seed, const std::function<std::string(Random&)>& work) {
  std::mutex mutex;
  std::string problem;
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      Random random(seed + i * 1000003);
      std::string mine;
      try {
        mine = work(random);
      } catch (const std::exception& error) {
        mine = error.what();
      }
      std::lock_guard lock(mutex);
      if (problem.empty()) problem = mine;
    });
  }
  for (std::thread& thread : threads) thread.join();
  return problem;
}

std::string threads_of_one_device(uint32_t seed, double seconds) {
  modules();
  raw::Gpu gpu;
  return on_threads(seed, [&](Random& random) {
    std::string problem;
    for (Clock clock(seconds); clock.goes_on() && problem.empty();) problem = once(gpu, random);
    return problem;
  });
}

std::string threads_with_devices(uint32_t seed, double seconds) {
  modules();
  { raw::Gpu loads_the_functions; }
  return on_threads(seed, [&](Random& random) {
    raw::Gpu gpu;
    std::string problem;
    for (Clock clock(seconds); clock.goes_on() && problem.empty();) problem = once(gpu, random);
    return problem;
  });
}

// Four threads use pipelines that no cache knows: the driver compiles them at their first dispatch.
std::string first_dispatch_on_threads(uint32_t seed, double seconds) {
  modules();
  raw::Gpu gpu;
  return on_threads(seed, [&](Random& random) {
    std::string problem;
    Scene scene = create_scene(gpu, static_cast<uint32_t>(random()));
    gpu.run([&](VkCommandBuffer list) { build(list, gpu, scene); });
    for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
      Variant variant;
      variant.from_record = false;
      variant.constant = static_cast<uint32_t>(random());
      Program program = create_program(gpu, variant);
      problem = run_and_compare(gpu, scene, program, {});
      free(gpu, program);
    }
    free(gpu, scene);
    return problem;
  });
}

// Images of three kinds in the unbounded arrays. One thread writes descriptors that no running
// dispatch uses while others dispatch.
struct ImageSet {
  uint32_t count = 24;
  std::vector<raw::Image> images;  // count of R8, count of R32_UINT, count of R8 to store into
  std::vector<VkSampler> samplers;
};

void write_image(raw::Gpu& gpu, uint32_t slot, const raw::Image& image) {
  const VkDescriptorImageInfo info{VK_NULL_HANDLE, image.view, VK_IMAGE_LAYOUT_GENERAL};
  VkWriteDescriptorSet writes[2];
  for (uint32_t i = 0; i < 2; ++i) {
    writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[i].dstSet = gpu.descriptors();
    writes[i].dstBinding = i;
    writes[i].dstArrayElement = slot;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType =
        i == 0 ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    writes[i].pImageInfo = &info;
  }
  vkUpdateDescriptorSets(gpu.device(), 2, writes, 0, nullptr);
}

uint32_t texel_value(uint32_t slot, uint32_t count) {
  return slot < count ? (slot * 7 + 1) & 0xFF : slot * 1000;
}

ImageSet create_images(raw::Gpu& gpu) {
  ImageSet set;
  for (uint32_t slot = 0; slot < 3 * set.count; ++slot) {
    const bool wide = slot / set.count == 1;
    raw::Image image = gpu.image(wide ? VK_FORMAT_R32_UINT : VK_FORMAT_R8_UNORM, 4, 4);
    VkClearColorValue color{};
    if (wide) {
      color.uint32[0] = texel_value(slot, set.count);
    } else {
      color.float32[0] = static_cast<float>(texel_value(slot, set.count)) / 255.0f;
    }
    gpu.run([&](VkCommandBuffer list) {
      const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
      vkCmdClearColorImage(list, image.image, VK_IMAGE_LAYOUT_GENERAL, &color, 1, &range);
    });
    write_image(gpu, slot, image);
    set.images.push_back(image);
  }
  for (uint32_t slot = 0; slot < 4; ++slot) {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = (slot & 1) ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    VkSampler sampler = VK_NULL_HANDLE;
    vkCreateSampler(gpu.device(), &info, nullptr, &sampler);
    set.samplers.push_back(sampler);
    const VkDescriptorImageInfo image{sampler, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = gpu.descriptors();
    write.dstBinding = 2;
    write.dstArrayElement = slot;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(gpu.device(), 1, &write, 0, nullptr);
  }
  return set;
}

std::string compare_images(const raw::Buffer& output, uint32_t groups, uint32_t count,
                           const std::vector<uint32_t>& sums) {
  for (uint32_t i = 0; i < groups * 32; ++i) {
    const uint32_t* got = output.as<uint32_t>() + i * 4;
    const uint32_t other = i / 32 * 32 + 31 - i % 32;
    if (got[0] != sums[i] || got[1] != sums[other]) {
      return "thread " + std::to_string(i) + " of " + std::to_string(count) +
             " images: " + std::to_string(got[0]) + " " + std::to_string(got[1]) + ", expected " +
             std::to_string(sums[i]) + " " + std::to_string(sums[other]);
    }
  }
  return {};
}

std::string bindless_images(uint32_t seed, double seconds) {
  raw::Gpu gpu;
  Random random(seed);
  ImageSet set = create_images(gpu);
  const VkPipeline pipeline =
      gpu.compute({VK_SHADER_STAGE_COMPUTE_BIT, &modules().at(kCompute), {}});
  constexpr uint32_t kGroups = 64;
  raw::Buffer output = gpu.buffer(kGroups * 32 * 16);
  raw::Buffer block_memory = gpu.buffer(sizeof(Block));
  bool stop = false;
  std::mutex mutex;
  std::thread writer([&] {
    Random slots(seed + 1);
    for (;;) {
      {
        std::lock_guard lock(mutex);
        if (stop) return;
      }
      const uint32_t slot = 3 * set.count + below(slots, raw::Gpu::kDescriptors - 3 * set.count);
      write_image(gpu, slot, set.images[below(slots, set.count)]);
    }
  });
  std::string problem;
  for (Clock clock(seconds); clock.goes_on() && problem.empty();) {
    Block block;
    block.output = output.address;
    block.seed = static_cast<uint32_t>(random());
    block.images = set.count;
    std::memcpy(block_memory.data, &block, sizeof block);
    gpu.run([&](VkCommandBuffer list) {
      const VkDescriptorSet descriptors = gpu.descriptors();
      vkCmdBindPipeline(list, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
      vkCmdBindDescriptorSets(list, VK_PIPELINE_BIND_POINT_COMPUTE, gpu.layout(), 0, 1,
                              &descriptors, 0, nullptr);
      vkCmdPushConstants(list, gpu.layout(), VK_SHADER_STAGE_ALL, 0, 8, &block_memory.address);
      vkCmdDispatch(list, kGroups, 1, 1);
    });
    std::vector<uint32_t> sums;
    for (uint32_t i = 0; i < kGroups * 32; ++i) {
      const uint32_t slot = image_slot(i, block.seed, set.count);
      sums.push_back(2 * texel_value(slot, set.count) +
                     2 * texel_value(set.count + slot, set.count));
    }
    problem = compare_images(output, kGroups, set.count, sums);
  }
  {
    std::lock_guard lock(mutex);
    stop = true;
  }
  writer.join();
  for (raw::Image& image : set.images) gpu.free(image);
  for (const VkSampler sampler : set.samplers) vkDestroySampler(gpu.device(), sampler, nullptr);
  gpu.free(pipeline);
  gpu.free(output);
  gpu.free(block_memory);
  return problem;
}

}  // namespace

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {{"six_stages", six_stages},
                                         {"recursion_to_31", recursion_to_31},
                                         {"callables_to_31", callables_to_31},
                                         {"odd_sizes", odd_sizes},
                                         {"many_hit_groups", many_hit_groups},
                                         {"null_records", null_records},
                                         {"large_payloads", large_payloads},
                                         {"garbage_rays", garbage_rays},
                                         {"specialization", specialization},
                                         {"rebuilds", rebuilds},
                                         {"create_and_destroy", create_and_destroy},
                                         {"devices_in_turn", devices_in_turn},
                                         {"threads_of_one_device", threads_of_one_device},
                                         {"threads_with_devices", threads_with_devices},
                                         {"first_dispatch_on_threads", first_dispatch_on_threads},
                                         {"bindless_images", bindless_images}};
  return all;
}

}  // namespace stress
