// SPDX-License-Identifier: MIT
//
// The seam between rtapi and what executes. rtapi/src checks descriptions, links state objects, and
// lays out root arguments and records; a backend owns memory, views, acceleration structures and
// execution. Its input has been checked, except for what is in GPU memory.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/descriptor.h>
#include <rtapi/device.h>
#include <rtapi/query.h>
#include <rtapi/raytracing.h>
#include <rtapi/resource.h>
#include <rtapi/result.h>

#include "runtime/backend/address_map.h"
#include "runtime/backend/commands.h"
#include "runtime/backend/heap_memory.h"
#include "runtime/backend/linked_pipeline.h"

namespace kaamos::checks {
class Reporter;  // runtime/checks/report.h
}

namespace kaamos::runtime {

struct AccelerationStructure;
struct LinkedGraphics;   // linked_graphics.h
struct DrawCounts;       // draw_observation.h
struct DrawObservation;  // draw_observation.h

// Linear memory, zero at first; freed with the object.
class BackendBuffer {
 public:
  virtual ~BackendBuffer() = default;
  virtual uint64_t address() const = 0;     // GPU virtual address, a multiple of 64 KiB
  virtual uint64_t size_bytes() const = 0;  // as requested
  // Host pointer; null if the host cannot reach it (default heaps of a discrete GPU). Upload and
  // readback buffers and descriptor heaps always have one.
  virtual uint8_t* host() const = 0;
};

// A texture's memory. Its views end with it: a descriptor left over reads as null and does not
// crash.
class BackendTexture {
 public:
  virtual ~BackendTexture() = default;
};

// A ray tracing, compute or graphics pipeline, as the backend has prepared it.
class BackendPipeline {
 public:
  virtual ~BackendPipeline() = default;
};

// A checked view of a texture. Every member is resolved: none means "the rest".
struct TextureViewDesc {
  rtapi::Format format = rtapi::Format::kUnknown;  // never typeless
  // Unordered access views use the same values; never kBuffer or an acceleration structure.
  rtapi::SrvDimension dimension = rtapi::SrvDimension::kTexture2D;
  bool unordered_access = false;
  uint32_t first_mip = 0;
  uint32_t mip_count = 1;
  uint32_t first_slice = 0;  // array element, cube face, or w of a 3-D unordered access view
  uint32_t slice_count = 1;
  float min_lod = 0;  // ResourceMinLODClamp
  // D3D12_SHADER_COMPONENT_MAPPING per channel: 0..3 channel, 4 zero, 5 one.
  uint8_t swizzle[4] = {0, 1, 2, 3};

  bool operator==(const TextureViewDesc&) const = default;
};

class BackendDevice {
 public:
  virtual ~BackendDevice() = default;

  virtual const rtapi::DeviceInfo& info() const = 0;

  // Resources. Error: out of memory.
  virtual rtapi::Result<std::shared_ptr<BackendBuffer>> create_buffer(
      const rtapi::BufferDesc& desc) = 0;
  // MipLevels must be resolved.
  virtual rtapi::Result<std::shared_ptr<BackendTexture>> create_texture(
      const rtapi::TextureDesc& desc) = 0;
  // The same in the memory of a heap, as what lies there; it has room for the resource. What the
  // backend cannot place has memory of its own: block-compressed textures, of which it may keep
  // the texels, and everything where the device cannot use pages of this process.
  virtual rtapi::Result<std::shared_ptr<BackendBuffer>> create_placed_buffer(
      const HeapPlace& place, const rtapi::BufferDesc& desc) = 0;
  virtual rtapi::Result<std::shared_ptr<BackendTexture>> create_placed_texture(
      const HeapPlace& place, const rtapi::TextureDesc& desc) = 0;
  // The bytes that such a texture needs beyond its texels, each subresource of them rounded up to
  // 64 bytes; in all, or 0.
  virtual uint64_t placed_bytes(const rtapi::TextureDesc& desc) const {
    (void)desc;
    return 0;
  }
  // Creates a view and returns what goes into Descriptor::address. The view lives as long as the
  // texture; views with equal descs may share one.
  virtual rtapi::Result<uint64_t> create_texture_view(BackendTexture& texture,
                                                      const TextureViewDesc& desc) = 0;
  // The same for samplers; they live as long as the device, and equal ones are shared.
  virtual rtapi::Result<uint64_t> create_sampler(const rtapi::SamplerDesc& desc) = 0;
  // Returns whether typed buffers, textures and their views can have this format.
  virtual bool supports_format(rtapi::Format format, bool unordered_access) const = 0;
  // Returns whether draws can write to textures in this format, as colours or as depth, and whether
  // they can blend there.
  virtual bool supports_target(rtapi::Format format, bool blended) const = 0;

  // Returns whether targets in this format can have that many samples, with the standard pattern.
  virtual bool supports_samples(rtapi::Format format, uint32_t count) const = 0;
  // Returns whether ResolveCommand can have this mode.
  virtual bool supports_resolve(rtapi::ResolveMode mode) const {
    return mode == rtapi::ResolveMode::kAverage;
  }

  // Pipelines
  virtual rtapi::Result<std::shared_ptr<BackendPipeline>> create_raytracing_pipeline(
      std::shared_ptr<const LinkedPipeline> pipeline) = 0;
  virtual rtapi::Result<std::shared_ptr<BackendPipeline>> create_compute_pipeline(
      std::shared_ptr<const LinkedCompute> pipeline) = 0;
  virtual rtapi::Result<std::shared_ptr<BackendPipeline>> create_graphics_pipeline(
      std::shared_ptr<const LinkedGraphics> pipeline) = 0;

  // Queries. CountingQueries, if not timestamps; an error says what the device lacks.
  virtual rtapi::Result<std::shared_ptr<BackendQueryHeap>> create_query_heap(
      rtapi::QueryHeapType type, uint32_t count) = 0;
  virtual uint64_t timestamp_frequency() const = 0;  // ticks per second

  // Acceleration structures, from the inputs of a build. GPU memory is not read. Sizes are
  // multiples of 256 and grow with every count.
  virtual rtapi::RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const BuildCommand& inputs) const = 0;
  // Returns whether builds and rays take opacity micromaps.
  virtual bool has_micromaps() const { return false; }

  // Runs the commands in order and returns when all are done. Called by one thread at a time. An
  // error removes the device; harmless faults in the contents of GPU memory go to Context::message
  // instead.
  virtual rtapi::Status execute(std::span<const Command> commands) = 0;

  // The acceleration structure at exactly this address, with what it was built from
  // (structure_map.h); null if there is none. Not to be called while a list executes.
  virtual std::shared_ptr<const AccelerationStructure> find_structure(uint64_t) const {
    return nullptr;
  }

  // From now on draws are noted in `observation`, which must stay until the call with null. False:
  // this backend cannot. Not to be called while a list executes.
  virtual bool observe_draws(DrawObservation* observation) {
    (void)observation;
    return false;
  }

  virtual rtapi::RaytracingStatistics statistics() const { return {}; }
  virtual void reset_statistics() {}
};

// A call in a checked shader whose arguments are not constants.
struct ReachedFrom {
  const LinkedShader* shader = nullptr;
  shader::ReachedCall call;
};

// The tables, by RecordKind, in which a record that a dispatch needed was missing.
struct MissingRecords {
  bool past_the_end[4] = {};
  // The record had no identifier of that kind from this pipeline, and was not NULL.
  bool unknown[4] = {};
};

// Checked mode's layer. The backend notifies it of each command as it executes, since only then is
// GPU memory as the command will read it.
class CommandObserver {
 public:
  virtual ~CommandObserver() = default;
  // `label` says which command of the list it is: "DispatchRays, command 3 in \"shadows\"". If
  // needs_memory(), all earlier work is done.
  virtual void before(const Command& command, const std::string& label) = 0;
  virtual void after(const Command& command, bool succeeded) = 0;
  // Called between the two with what a dispatch reached that was unknown before it ran: each
  // different call once, as far as there was room.
  virtual void reached(const Command& command, std::span<const ReachedFrom> calls) {
    (void)command;
    (void)calls;
  }
  // Called for each DispatchRays that ran, after reached(). A backend that cannot tell the tables
  // apart names all that it could have been.
  virtual void missed(const Command& command, const MissingRecords& records) {
    (void)command;
    (void)records;
  }
  // Called between before() and after() with what became of a draw, if the backend rasterizes by
  // itself and the draw has run by then.
  virtual void drawn(const DrawCommand& command, const DrawCounts& counts) {
    (void)command;
    (void)counts;
  }
  // Returns whether before() or after() reads GPU memory for this command.
  virtual bool needs_memory(const Command& command) const = 0;
  // Returns whether after() reads what the command wrote.
  virtual bool needs_memory_after(const Command& command) const {
    (void)command;
    return false;
  }
};

inline const std::atomic<bool> kNeverStopped = false;

// Everything that a backend gets from rtapi. All of it outlives the backend.
struct Context {
  const AddressMap* addresses = nullptr;
  std::function<void(const rtapi::Message&)> message;  // never empty; may be called from any thread
  // True once the device is removed: work that executes ends as soon as it can.
  const std::atomic<bool>* stopped = &kNeverStopped;
  // Both null unless DeviceDesc::Checked.
  CommandObserver* observer = nullptr;
  checks::Reporter* reporter = nullptr;
};

struct BackendFactory {
  const char* name;  // the value of DeviceDesc::Backend that selects it
  std::vector<rtapi::DeviceInfo> (*enumerate)();
  rtapi::Result<std::unique_ptr<BackendDevice>> (*create)(const rtapi::DeviceDesc&, const Context&);
};

}  // namespace kaamos::runtime
