// SPDX-License-Identifier: MIT
#include "graphics_runner.h"

#include <gtest/gtest.h>
#include <kaamos/shader/bound.h>
#include <kaamos/shader/wave_results.h>
#include <ucontext.h>

#include <algorithm>
#include <cstring>

#include "runtime/shader/texture/texture_sampling.h"

namespace kaamos::test {
namespace {

using namespace shader;

constexpr uint32_t kSentinel = 0xABCDABCD;
constexpr uint32_t kQuadLanes = 4;

// Four lanes of a quad, each on a stack of its own. They meet at wave operations.
struct Quad {
  ucontext_t main;
  ucontext_t lanes[kQuadLanes];
  std::vector<char> stacks[kQuadLanes];
  const WaveCall* waiting[kQuadLanes] = {};
  bool started[kQuadLanes] = {};
  bool ended[kQuadLanes] = {};
  uint32_t current = 0;
  PixelThreadFn function = nullptr;
  Invocation* invocation = nullptr;
  PixelLanes* pixels = nullptr;
  ComputeGroup group;
  uint32_t first = 0;
};

thread_local Quad* running = nullptr;

void run_lane() {
  Quad& quad = *running;
  const uint32_t lane = quad.current;
  Invocation own = *quad.invocation;
  quad.function(own, *quad.pixels, quad.group, quad.first + lane);
  quad.ended[lane] = true;
  swapcontext(&quad.lanes[lane], &quad.main);
}

void wait_for_quad(ComputeGroup&, const WaveCall& call) {
  Quad& quad = *running;
  if (call.op == WaveOp::kLaneCount || call.op == WaveOp::kLaneIndex) {
    *static_cast<uint32_t*>(call.result) =
        call.op == WaveOp::kLaneCount ? kQuadLanes : quad.current;
    return;
  }
  quad.waiting[quad.current] = &call;
  swapcontext(&quad.lanes[quad.current], &quad.main);
}

template <class T>
void give_results(Quad& quad, const std::vector<uint32_t>& together) {
  const WaveCall& call = *quad.waiting[together[0]];
  T values[4 * kQuadLanes] = {};
  uint32_t second[4 * kQuadLanes] = {};
  alignas(8) unsigned char results[4 * kQuadLanes * 8] = {};
  uint32_t active = 0;
  for (const uint32_t lane : together) {
    active |= 1u << lane;
    for (uint32_t c = 0; c < call.components; ++c) {
      values[c * kQuadLanes + lane] = static_cast<const T*>(quad.waiting[lane]->value)[c];
    }
    const uint32_t words = has_lane_operand(call.op) ? 1 : has_mask_operand(call.op) ? 4 : 0;
    for (uint32_t c = 0; c < words; ++c) {
      second[c * kQuadLanes + lane] = quad.waiting[lane]->second[c];
    }
  }
  wave_results<T>(call.op, {active, kQuadLanes, call.components, values, second, results});
  const bool number = gives_number(call.op) || gives_mask(call.op);
  const size_t bytes = gives_bool(call.op) ? 1 : number ? 4 : sizeof(T);
  const bool one = gives_number(call.op) || (gives_bool(call.op) && call.op != WaveOp::kAllEqual);
  const uint32_t components = gives_mask(call.op) ? 4 : one ? 1 : call.components;
  for (const uint32_t lane : together) {
    for (uint32_t c = 0; c < components; ++c) {
      std::memcpy(static_cast<char*>(quad.waiting[lane]->result) + c * bytes,
                  results + (c * kQuadLanes + lane) * bytes, bytes);
    }
    quad.waiting[lane] = nullptr;
  }
}

void meet(Quad& quad) {
  std::vector<uint32_t> together;
  const auto compare = [&](uint32_t a, uint32_t b) {
    const WaveCall &x = *quad.waiting[a], &y = *quad.waiting[b];
    return std::lexicographical_compare(x.path, x.path + x.path_length, y.path,
                                        y.path + y.path_length);
  };
  for (uint32_t lane = 0; lane < kQuadLanes; ++lane) {
    if (quad.waiting[lane] == nullptr) continue;
    if (!together.empty() && compare(together[0], lane)) continue;
    if (!together.empty() && compare(lane, together[0])) together.clear();
    together.push_back(lane);
  }
  switch (quad.waiting[together[0]]->scalar) {
    case WaveScalar::kBool:
      return give_results<bool>(quad, together);
    case WaveScalar::kInt32:
      return give_results<int32_t>(quad, together);
    case WaveScalar::kUint32:
      return give_results<uint32_t>(quad, together);
    case WaveScalar::kFloat16:
      return give_results<half>(quad, together);
    default:
      return give_results<float>(quad, together);
  }
}

[[gnu::noinline]] void prepare_lane(Quad& quad, uint32_t lane) {
  quad.started[lane] = true;
  quad.stacks[lane].resize(256 * 1024);
  getcontext(&quad.lanes[lane]);
  quad.lanes[lane].uc_stack.ss_sp = quad.stacks[lane].data();
  quad.lanes[lane].uc_stack.ss_size = quad.stacks[lane].size();
  quad.lanes[lane].uc_link = &quad.main;
  makecontext(&quad.lanes[lane], run_lane, 0);
}

void run_quad(Quad& quad, uint32_t active) {
  running = &quad;
  quad.group.wave_lanes = kQuadLanes;
  quad.group.backend = &quad;
  for (;;) {
    bool waits = false;
    for (uint32_t lane = 0; lane < kQuadLanes; ++lane) {
      if ((active >> lane & 1u) == 0 || quad.ended[lane]) continue;
      quad.current = lane;
      if (!quad.started[lane]) {
        prepare_lane(quad, lane);
        swapcontext(&quad.main, &quad.lanes[lane]);
      } else if (quad.waiting[lane] == nullptr) {
        swapcontext(&quad.main, &quad.lanes[lane]);
      }
      waits = waits || quad.waiting[lane] != nullptr;
    }
    if (!waits) return;
    meet(quad);
  }
}

DescriptorKind kind_of(BindingType type) {
  switch (type) {
    case BindingType::kConstantBuffer:
      return DescriptorKind::kConstantBuffer;
    case BindingType::kRawBuffer:
      return DescriptorKind::kRawBuffer;
    case BindingType::kStructuredBuffer:
      return DescriptorKind::kStructuredBuffer;
    case BindingType::kTexture:
      return DescriptorKind::kTexture;
    case BindingType::kSampler:
    case BindingType::kComparisonSampler:
      return DescriptorKind::kSampler;
    default:
      return DescriptorKind::kNull;
  }
}

}  // namespace

GraphicsRunner::GraphicsRunner(const LibraryDesc& library, const std::string& name)
    : library_(library) {
  for (uint32_t i = 0; i < library.export_count; ++i) {
    if (name == library.exports[i].name) desc_ = &library.exports[i];
  }
  if (desc_ == nullptr || desc_->graphics == nullptr) {
    ADD_FAILURE() << "no vertex or pixel shader '" << name << "'";
    std::abort();
  }
  inputs.resize(graphics().input_columns);
  outputs.resize(graphics().output_columns);
  for (Lanes& lanes : outputs) lanes.fill(kSentinel);
}

const SignatureElement* GraphicsRunner::find(bool output, const std::string& semantic,
                                             uint32_t number) const {
  const SignatureElement* elements = output ? graphics().outputs : graphics().inputs;
  const uint32_t count = output ? graphics().output_count : graphics().input_count;
  for (uint32_t i = 0; i < count; ++i) {
    if (semantic == elements[i].semantic && number == elements[i].semantic_index) {
      return &elements[i];
    }
  }
  ADD_FAILURE() << "no element " << semantic << number;
  std::abort();
}

GraphicsRunner::Lanes& GraphicsRunner::in(const std::string& semantic, uint32_t number,
                                          uint32_t component) {
  return inputs.at(find(false, semantic, number)->first_column + component);
}

const GraphicsRunner::Lanes& GraphicsRunner::out(const std::string& semantic, uint32_t number,
                                                 uint32_t component) const {
  return outputs.at(find(true, semantic, number)->first_column + component);
}

void GraphicsRunner::set(const std::string& semantic, uint32_t number, uint32_t component,
                         const std::array<float, kGraphicsLanes>& values) {
  in(semantic, number, component) = std::bit_cast<Lanes>(values);
}

void GraphicsRunner::set_position() {
  set("SV_Position", 0, 0, {10.5f, 11.5f, 10.5f, 11.5f, 12.5f, 13.5f, 12.5f, 13.5f});
  set("SV_Position", 0, 1, {20.5f, 20.5f, 21.5f, 21.5f, 20.5f, 20.5f, 21.5f, 21.5f});
}

std::array<float, kGraphicsLanes> GraphicsRunner::floats(const std::string& semantic,
                                                         uint32_t number,
                                                         uint32_t component) const {
  return std::bit_cast<std::array<float, kGraphicsLanes>>(out(semantic, number, component));
}

void GraphicsRunner::run() {
  std::vector<Descriptor> views(library_.binding_count), samplers(library_.binding_count);
  std::vector<BindingSlot> slots(library_.binding_count);
  for (uint32_t i = 0; i < library_.binding_count; ++i) {
    const BindingDesc& binding = library_.bindings[i];
    Descriptor d;
    d.kind = kind_of(binding.type);
    const bool is_sampler = d.kind == DescriptorKind::kSampler;
    const bool writes = binding.register_class == RegisterClass::kUnorderedAccess;
    d.access = is_sampler ? DescriptorAccess::kOther
               : writes   ? DescriptorAccess::kUnorderedAccess
                          : DescriptorAccess::kShaderResource;
    d.stride_bytes = d.kind == DescriptorKind::kConstantBuffer ? 0 : binding.size_bytes;
    d.address = reinterpret_cast<uintptr_t>(memory.data());
    d.size_bytes = memory.size() * sizeof(uint32_t);
    if (d.kind == DescriptorKind::kTexture) d.address = reinterpret_cast<uintptr_t>(&texture);
    if (is_sampler) d.address = reinterpret_cast<uintptr_t>(&sampler);
    (is_sampler ? samplers : views)[i] = d;
    BindingSlot& slot = slots[i];
    slot.source = SlotSource::kDescriptorTable;
    slot.kind = d.kind;
    slot.access = d.access;
    slot.argument_offset = is_sampler ? 8 : 0;
    slot.descriptor_index = i;
    slot.descriptor_count = 1;
    slot.stride_bytes = d.stride_bytes;
  }
  const uint64_t arguments[2] = {reinterpret_cast<uintptr_t>(views.data()),
                                 reinterpret_cast<uintptr_t>(samplers.data())};
  Services services = {};
  set_texture_services(services);
  services.wave = wait_for_quad;
  DispatchConstants dispatch;
  dispatch.services = &services;
  dispatch.root_arguments = reinterpret_cast<const uint8_t*>(arguments);
  dispatch.view_heap_begin = views.data();
  dispatch.view_heap_end = views.data() + views.size();
  dispatch.sampler_heap_begin = samplers.data();
  dispatch.sampler_heap_end = samplers.data() + samplers.size();
  Invocation invocation;
  invocation.dispatch = &dispatch;
  invocation.slots = slots.data();
  std::vector<BoundResource> bound(library_.binding_count + 1);
  if (desc().flags & kExportReadsBound) {
    bind(invocation, desc().bindings, desc().binding_count, bound.data());
    invocation.bound = bound.data();
  }
  const auto* in_columns = reinterpret_cast<const Column*>(inputs.data());
  auto* out_columns = reinterpret_cast<Column*>(outputs.data());
  if (graphics().vertex != nullptr) {
    graphics().vertex(invocation, {in_columns, out_columns, active});
    return;
  }
  PixelLanes pixels = {in_columns, out_columns, active, live};
  if (graphics().pixel != nullptr) {
    graphics().pixel(invocation, pixels);
  } else {
    for (const uint32_t first : {0u, kQuadLanes}) {
      Quad quad;
      quad.function = graphics().pixel_thread;
      quad.invocation = &invocation;
      quad.pixels = &pixels;
      quad.first = first;
      run_quad(quad, active >> first);
    }
  }
  live = pixels.live;
}

}  // namespace kaamos::test
