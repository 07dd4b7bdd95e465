// SPDX-License-Identifier: MIT
//
// The services that replayed shaders call.
#include "kaamos/shader/debugging.h"
#include "runtime/backend/debugger.h"
#include "runtime/explain/guard.h"
#include "runtime/explain/replay_state.h"
#include "runtime/shader/texture/texture_sampling.h"

namespace kaamos::explain {

namespace {

thread_local const Environment* environment = nullptr;

const shader::Services& texture_services() {
  static const shader::Services table = [] {
    shader::Services out = {};
    shader::set_texture_services(out);
    return out;
  }();
  return table;
}

shader::Descriptor host_copy(const shader::Descriptor& descriptor) {
  shader::Descriptor out = descriptor;
  if (descriptor.kind == shader::DescriptorKind::kTexture) {
    out.address = reinterpret_cast<uint64_t>(environment->texture(descriptor));
  } else if (descriptor.kind == shader::DescriptorKind::kSampler) {
    out.address = reinterpret_cast<uint64_t>(environment->sampler(descriptor));
  }
  return out;
}

struct Sampling {
  shader::Descriptor texture;
  shader::Descriptor sampler;
  shader::SampleArguments arguments;
  explicit Sampling(const shader::SampleArguments& from) : arguments(from) {
    if (from.texture != nullptr) {
      texture = host_copy(*from.texture);
      arguments.texture = &texture;
    }
    if (from.sampler != nullptr) {
      sampler = host_copy(*from.sampler);
      arguments.sampler = &sampler;
    }
  }
  Sampling(const Sampling&) = delete;
  Sampling& operator=(const Sampling&) = delete;
};

}  // namespace

void set_environment(const Environment* its) {
  environment = its;
}

struct Services {
  static Replay::Frame& frame_of(shader::Invocation& invocation) {
    return *static_cast<Replay::Frame*>(invocation.backend);
  }
  static shader::RayDesc ray_of(shader::RayLanes origin, shader::RayLanes direction) {
    return {{origin[0], origin[1], origin[2]},
            origin[3],
            {direction[0], direction[1], direction[2]},
            direction[3]};
  }
  static void trace_ray(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
                        void* payload, shader::RayLanes origin, shader::RayLanes direction) {
    Replay::Frame& frame = frame_of(caller);
    frame.replay->trace_ray(frame, arguments, payload, ray_of(origin, direction));
  }
  // Rays of a shader that runs several invocations at once; here only the explained one is active.
  static void trace_rays(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
                         void* payloads, const shader::LaneRays& rays, uint32_t lanes) {
    const uint32_t first = caller.index[0];
    auto* payload = static_cast<std::byte*>(payloads);
    for (int lane = 0; lane < shader::kLanes; ++lane, payload += arguments.payload_bytes) {
      if ((lanes >> lane & 1) == 0) continue;
      caller.index[0] = first + static_cast<uint32_t>(lane);
      trace_ray(caller, arguments, payload, shader::origin_t_min(rays, lane),
                shader::direction_t_max(rays, lane));
    }
    caller.index[0] = first;
  }
  static shader::ReportHitResult report_hit(shader::Invocation& caller, float t, uint32_t hit_kind,
                                            const void* attributes, uint32_t bytes) {
    Replay::Frame& frame = frame_of(caller);
    return frame.replay->report_hit(frame, t, hit_kind, attributes, bytes);
  }
  static void call_shader(shader::Invocation& caller, uint32_t index, void* data, uint32_t bytes) {
    Replay::Frame& frame = frame_of(caller);
    frame.replay->call_shader(frame, index, data, bytes);
  }
  static void trace_hit_object(shader::Invocation& caller,
                               const shader::TraceRayArguments& arguments, void* payload,
                               shader::RayLanes origin, shader::RayLanes direction,
                               shader::HitObject& hit) {
    Replay::Frame& frame = frame_of(caller);
    frame.replay->trace_ray(frame, arguments, payload, ray_of(origin, direction), &hit);
  }
  static void invoke_hit_object(shader::Invocation& caller, const shader::HitObject& hit,
                                void* payload, uint32_t bytes) {
    Replay::Frame& frame = frame_of(caller);
    frame.replay->invoke(frame, hit, payload, bytes);
  }
  static uint32_t record_constant(shader::Invocation& caller, const shader::HitObject& hit,
                                  uint32_t offset) {
    if (offset == shader::kDebuggingEnabled) return runtime::is_debugger_attached() ? 1 : 0;
    return frame_of(caller).replay->record_constant(hit, offset);
  }
  static void begin_query(shader::Invocation& caller, shader::RayQuery& query,
                          const shader::RayQueryArguments& arguments, const shader::RayDesc& ray) {
    Replay::Frame& frame = frame_of(caller);
    frame.replay->begin_query(frame, query, arguments, ray);
  }
  static bool proceed(shader::Invocation& caller, shader::RayQuery& query) {
    return frame_of(caller).replay->proceed(query);
  }
  static void remove(shader::Invocation&, shader::RemovalReason reason) {
    leave(reason == shader::RemovalReason::kStepLimit ? "a shader ran for too long"
                                                      : "a shader removed the device");
  }
};

namespace {

shader::Services make_services() {
  shader::Services table = {};
  table.trace_ray = Services::trace_ray;
  table.trace_rays = Services::trace_rays;
  table.report_hit = Services::report_hit;
  table.call_shader = Services::call_shader;
  table.trace_hit_object = Services::trace_hit_object;
  table.invoke_hit_object = Services::invoke_hit_object;
  table.record_constant = Services::record_constant;
  table.begin_query = Services::begin_query;
  table.proceed = Services::proceed;
  table.remove_device = Services::remove;
  const shader::Services& textures = texture_services();
  table.load_typed = textures.load_typed;
  table.store_typed = textures.store_typed;
  table.typed_address = textures.typed_address;
  table.sample_level = [](const shader::SampleArguments& a) {
    return texture_services().sample_level(Sampling(a).arguments);
  };
  table.sample_gradient = [](const shader::SampleArguments& a) {
    return texture_services().sample_gradient(Sampling(a).arguments);
  };
  table.level_of_detail = [](const shader::SampleArguments& a) {
    return texture_services().level_of_detail(Sampling(a).arguments);
  };
  table.sample_compare_level = [](const shader::SampleArguments& a) {
    return texture_services().sample_compare_level(Sampling(a).arguments);
  };
  table.gather = [](const shader::SampleArguments& a) {
    return texture_services().gather(Sampling(a).arguments);
  };
  table.gather_compare = [](const shader::SampleArguments& a) {
    return texture_services().gather_compare(Sampling(a).arguments);
  };
  table.load_texel = [](const shader::Descriptor& d, const int32_t at[4]) {
    return texture_services().load_texel(host_copy(d), at);
  };
  table.store_texel = [](const shader::Descriptor& d, const int32_t at[4],
                         const shader::Texel& value) {
    texture_services().store_texel(host_copy(d), at, value);
  };
  table.texel_address = [](const shader::Descriptor& d, const int32_t at[4], uint32_t bytes) {
    return texture_services().texel_address(host_copy(d), at, bytes);
  };
  table.texture_dimensions = [](const shader::Descriptor& d, uint32_t mip) {
    return texture_services().texture_dimensions(host_copy(d), mip);
  };
  return table;
}

}  // namespace

const shader::Services& services() {
  static const shader::Services table = make_services();
  return table;
}

}  // namespace kaamos::explain
