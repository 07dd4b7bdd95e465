// SPDX-License-Identifier: MIT
#include "listening_library.h"

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/backend/ray_flags.h"

namespace kaamos::bench {
namespace {

using RayList = std::vector<FrameRay>;

std::mutex lists_mutex;
std::vector<std::unique_ptr<RayList>> lists;  // one per thread
std::atomic<uint32_t> recording = 0;          // numbers the recordings; 0: none exists
uint32_t last_recording = 0;

// This thread's list of the current recording.
RayList* list_of_thread(uint32_t current) {
  thread_local RayList* list = nullptr;
  thread_local uint32_t list_of = 0;
  if (list_of != current) {
    const std::lock_guard lock(lists_mutex);
    list = lists.emplace_back(std::make_unique<RayList>()).get();
    list_of = current;
  }
  return list;
}

// The dispatch that shaders get while a recording exists.
struct HeardDispatch : shader::DispatchConstants {
  HeardDispatch(const shader::DispatchConstants& dispatch, RayList* rays);

  RayList* rays;
  const shader::Services* backend_services;
  shader::Services heard_services;
};

void heard_trace_ray(shader::Invocation& invocation, const shader::TraceRayArguments& arguments,
                     void* payload, shader::RayLanes origin, shader::RayLanes direction) {
  const auto& heard = static_cast<const HeardDispatch&>(*invocation.dispatch);
  constexpr uint32_t kVisibility =
      runtime::kRaySkipClosestHitShader | runtime::kRayAcceptFirstHitAndEndSearch;
  const Ray ray = {{origin[0], origin[1], origin[2]},
                   origin[3],
                   {direction[0], direction[1], direction[2]},
                   direction[3]};
  heard.rays->push_back({ray, (arguments.ray_flags & kVisibility) == kVisibility});
  heard.backend_services->trace_ray(invocation, arguments, payload, origin, direction);
}

// Traces one ray after another, so that what their shaders trace is noted in the right order.
void heard_trace_rays(shader::Invocation& invocation, const shader::TraceRayArguments& arguments,
                      void* payloads, const shader::LaneRays& rays, uint32_t lanes) {
  const uint32_t first_x = invocation.index[0];
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    invocation.index[0] = first_x + static_cast<uint32_t>(lane);
    auto* payload =
        static_cast<uint8_t*>(payloads) + static_cast<size_t>(lane) * arguments.payload_bytes;
    heard_trace_ray(invocation, arguments, payload, shader::origin_t_min(rays, lane),
                    shader::direction_t_max(rays, lane));
  }
}

HeardDispatch::HeardDispatch(const shader::DispatchConstants& dispatch, RayList* thread_rays)
    : DispatchConstants(dispatch),
      rays(thread_rays),
      backend_services(dispatch.services),
      heard_services(*dispatch.services) {
  heard_services.trace_ray = heard_trace_ray;
  heard_services.trace_rays = heard_trace_rays;
  services = &heard_services;
}

template <typename Shader>
void run(shader::Invocation& invocation, Shader original) {
  const uint32_t current = recording.load(std::memory_order_relaxed);
  if (current == 0) return original();
  const HeardDispatch heard(*invocation.dispatch, list_of_thread(current));
  const shader::DispatchConstants* dispatch = std::exchange(invocation.dispatch, &heard);
  original();
  invocation.dispatch = dispatch;
}

// A shader's functions have no room for a pointer to what they replace, so there is a pair of them
// for each shader that is replaced.
struct Functions {
  shader::RayGenerationFn entry = nullptr;
  shader::RayGenerationRowFn row = nullptr;

  bool operator==(const Functions&) const = default;
};
constexpr size_t kMostShaders = 32;
std::array<Functions, kMostShaders> originals;

template <size_t i>
void run_entry(shader::Invocation& invocation) {
  run(invocation, [&] { originals[i].entry(invocation); });
}
template <size_t i>
void run_row(shader::Invocation& invocation, uint32_t count) {
  run(invocation, [&] { originals[i].row(invocation, count); });
}
template <size_t... i>
constexpr std::array<Functions, kMostShaders> make_listeners(std::index_sequence<i...>) {
  return {Functions{run_entry<i>, run_row<i>}...};
}
constexpr auto kListeners = make_listeners(std::make_index_sequence<kMostShaders>());

Functions listener_of(const Functions& original) {
  for (size_t i = 0; i < kMostShaders; ++i) {
    if (originals[i].entry == nullptr) originals[i] = original;
    if (originals[i] != original) continue;
    return {kListeners[i].entry, original.row == nullptr ? nullptr : kListeners[i].row};
  }
  throw std::runtime_error("more than " + std::to_string(kMostShaders) +
                           " ray generation shaders; raise kMostShaders");
}

struct Tables {
  rtapi::ShaderLibrary original;  // keeps its code loaded
  std::vector<shader::ExportDesc> exports;
  shader::LibraryDesc library;
};

}  // namespace

rtapi::ShaderLibrary listening_library(const rtapi::ShaderLibrary& library) {
  const shader::LibraryDesc& desc = *library.impl()->desc;
  auto tables = std::make_shared<Tables>(
      Tables{library, {desc.exports, desc.exports + desc.export_count}, desc});
  for (shader::ExportDesc& code : tables->exports) {
    if (code.stage != shader::Stage::kRayGeneration) continue;
    const Functions listener =
        listener_of({reinterpret_cast<shader::RayGenerationFn>(code.entry), code.row});
    code.entry = reinterpret_cast<shader::AnyFn>(listener.entry);
    code.row = listener.row;
  }
  tables->library.exports = tables->exports.data();
  const shader::LibraryDesc* out = &tables->library;
  return rtapi::LoadShaderLibrary(out, std::move(tables)).value();
}

RayRecording::RayRecording() {
  recording = ++last_recording;
}

RayRecording::~RayRecording() {
  recording = 0;
  lists.clear();
}

std::vector<FrameRay> RayRecording::rays() const {
  std::vector<FrameRay> out;
  for (const auto& list : lists) out.insert(out.end(), list->begin(), list->end());
  return out;
}

}  // namespace kaamos::bench
