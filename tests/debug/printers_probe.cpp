// SPDX-License-Identifier: MIT
// Values for printers_test.sh to print; the debugger stops in Stop.
#include <kaamos/shader/prelude.h>

#include "runtime/backend/linked_pipeline.h"
#include "runtime/embree/shader_record.h"

namespace ks = kaamos::shader;

// Shaders' structs are in namespaces with such names.
namespace unit_probe::u {
struct Payload {
  ks::vec<float, 3> color;
  uint32_t leaves;
};
struct RayDesc {
  ks::vec<float, 3> Origin;
  float TMin;
  ks::vec<float, 3> Direction;
  float TMax;
};
}  // namespace unit_probe::u

[[gnu::noinline]] static void Stop(const void* address) {
  asm volatile("" : : "r"(address) : "memory");
}

int main() {
  const ks::vec<float, 3> color = {{1, 2.5f, -3}};
  const ks::vec<uint32_t, 2> pixel = {{812, 440}};
  const ks::mat<float, 2, 3> matrix = {{{{1, 2, 3}}, {{4, 5, 6}}}};
  const ks::array<ks::vec<int32_t, 2>, 2> list = {{{{1, 2}}, {{3, 4}}}};
  const unit_probe::u::Payload payload = {color, 2};
  const unit_probe::u::RayDesc hlsl_ray = {{{0, 1, 2}}, 0, {{0, 0, 1}}, 100};
  const ks::RayDesc ray = {{0, 1, 2}, 0.5f, {0, 0, 1}, 100};
  ks::Descriptor view;
  view.kind = ks::DescriptorKind::kStructuredBuffer;
  view.stride_bytes = 16;
  view.address = 0x1000;
  view.size_bytes = 416;
  const ks::Descriptor none;

  kaamos::embree::RecordTarget target;
  target.kind = kaamos::embree::RecordKind::kHitGroup;
  target.any_hit.name = "AlphaTest";
  target.any_hit.entry = [] {};
  alignas(32) const uint8_t bytes[64] = {};
  const kaamos::embree::ShaderRecord record = {&target, bytes};

  kaamos::runtime::LinkedShader miss_shader;
  miss_shader.name = "Sky";
  kaamos::runtime::LinkedRecord linked;
  linked.name = "Sky";
  linked.shader = &miss_shader;
  linked.local_argument_bytes = 8;

  Stop(&color);
  for (const void* each : {static_cast<const void*>(&pixel), static_cast<const void*>(&matrix),
                           static_cast<const void*>(&list), static_cast<const void*>(&payload),
                           static_cast<const void*>(&hlsl_ray), static_cast<const void*>(&ray),
                           static_cast<const void*>(&view), static_cast<const void*>(&none),
                           static_cast<const void*>(&record), static_cast<const void*>(&linked)}) {
    Stop(each);
  }
  return 0;
}
