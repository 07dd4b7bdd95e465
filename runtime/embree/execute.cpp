// SPDX-License-Identifier: MIT
//
// Executes each command of a list on the Embree backend.
#include <algorithm>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#include "runtime/backend/executor.h"
#include "runtime/embree/acceleration_structure.h"
#include "runtime/embree/device.h"
#include "runtime/embree/draw.h"
#include "runtime/embree/texture.h"
#include "runtime/embree/timestamps.h"
#include "runtime/raster/resolve.h"

namespace kaamos::embree {
namespace {

class Target final : public runtime::CommandTarget {
 public:
  explicit Target(Device& device)
      : device_(device),
        pass_(device.dispatch_environment(), device.rasterizer(), device.observation()) {}

  runtime::DispatchOutcome dispatch_rays(const runtime::DispatchRaysCommand& command,
                                         const std::string& label) override {
    if (auto s = finish(); !s) return {s};
    if (auto s = complete_structures(device_); !s) return {s};
    return counted(embree::dispatch_rays(device_.dispatch_environment(), command, label));
  }
  runtime::DispatchOutcome dispatch(const runtime::DispatchCommand& command,
                                    const std::string& label) override {
    if (auto s = finish(); !s) return {s};
    if (auto s = complete_structures(device_); !s) return {s};
    return counted(dispatch_compute(device_.dispatch_environment(), command, label));
  }
  rtapi::Status draw(const runtime::DrawCommand& command, const std::string& label) override {
    // Shaders may trace rays.
    if (auto s = complete_structures(device_); !s) return s;
    return reported(pass_.draw(command, label));
  }
  rtapi::Status clear_target(const runtime::ClearTargetCommand& command) override {
    return reported(pass_.clear(command));
  }
  rtapi::Status build(const runtime::BuildCommand& command) override {
    if (auto s = finish(); !s) return s;
    return embree::build(device_, command);
  }
  rtapi::Status emit_postbuild_info(const runtime::EmitPostbuildInfoCommand& command) override {
    if (auto s = finish(); !s) return s;
    return runtime::emit_postbuild_info(device_.structure_environment(), command.desc,
                                        command.sources);
  }
  rtapi::Status copy_structure(const runtime::CopyAccelerationStructureCommand& command) override {
    if (auto s = finish(); !s) return s;
    return copy(device_, command);
  }
  rtapi::Status execute_operations(const runtime::RtasOperationsCommand& command,
                                   const std::string& label) override {
    if (auto s = finish(); !s) return s;
    return embree::execute_operations(device_, command, label);
  }
  rtapi::Status copy_buffer(const runtime::CopyBufferCommand& command,
                            const std::string& label) override;
  rtapi::Status copy_texture(const runtime::CopyTextureCommand& command) override;
  rtapi::Status resolve(const runtime::ResolveCommand& command) override;
  rtapi::Status clear(const runtime::ClearUavCommand& command) override;
  rtapi::Status write_timestamp(const runtime::TimestampCommand& command) override {
    if (auto s = finish(); !s) return s;
    static_cast<Timestamps&>(*command.heap).write(command.index);
    return {};
  }
  rtapi::Status resolve_timestamps(const runtime::ResolveQueriesCommand& command) override {
    return write_buffer(
        command.dest, command.dest_offset,
        static_cast<const Timestamps&>(*command.heap).bytes(command.first, command.count));
  }
  rtapi::Status count_work(const runtime::WorkToCount& what) override {
    if (auto s = finish(); !s) return s;
    pass_.count_work(what.any());
    return {};
  }
  runtime::WorkCounts counted() const override { return pass_.counted(); }
  rtapi::Status write_buffer(const std::shared_ptr<runtime::BackendBuffer>& dest, uint64_t offset,
                             std::span<const uint8_t> bytes) override {
    if (auto s = finish(); !s) return s;
    device_.memory().evict(dest->address() + offset, bytes.size());
    std::memcpy(dest->host() + offset, bytes.data(), bytes.size());
    return {};
  }
  // Only draws wait; nothing overlaps.
  rtapi::Status barrier() override { return finish(); }
  rtapi::Status finish() override { return reported(pass_.flush()); }

 private:
  runtime::DispatchOutcome counted(CountedOutcome result) {
    device_.add_counters(result.counters);
    return result;
  }

  // Warnings of draws go out when they have run, which may be later than their commands.
  rtapi::Status reported(CountedOutcome result) {
    device_.add_counters(result.counters);
    for (const auto& warning : result.warnings) {
      device_.context().message(runtime::make_message(warning.id, warning.text));
    }
    return std::move(result.status);
  }

  Device& device_;
  DrawPass pass_;
};

rtapi::Status Target::copy_buffer(const runtime::CopyBufferCommand& command, const std::string&) {
  if (auto s = finish(); !s) return s;
  device_.memory().evict(command.dest->address() + command.dest_offset, command.size_bytes);
  std::memmove(command.dest->host() + command.dest_offset,
               command.source->host() + command.source_offset, command.size_bytes);
  return {};
}

// One side of a texture copy, in memory.
struct Elements {
  uint8_t* first = nullptr;
  uint32_t stride = 0;  // bytes from element to element
  uint32_t bytes = 0;   // of an element that are copied
  uint64_t row_pitch = 0;
  uint64_t slice_pitch = 0;
};

uint32_t element_bytes_of(const runtime::TextureCopyPlace& place) {
  if (place.texture == nullptr) return 0;
  const rtapi::Format format = static_cast<const Texture&>(*place.texture).format();
  return rtapi::GetFormatInfo(runtime::plane_format(format, place.plane)).bytes;
}

Elements elements_of(const runtime::TextureCopyPlace& place, uint32_t element_bytes,
                     uint32_t sample) {
  if (place.texture != nullptr) {
    const auto& texture = static_cast<const Texture&>(*place.texture);
    const auto s = texture.stored().subresource(place.mip + sample, place.array_element);
    const uint32_t stride = texture.stored().element_bytes();
    const runtime::PlaneBytes plane = runtime::plane_bytes(texture.format(), place.plane);
    return {s.at(place.origin, stride) + plane.offset, stride, plane.count, s.row_pitch,
            s.slice_pitch};
  }
  uint8_t* first = place.buffer->host() + place.offset + place.origin[2] * place.slice_pitch +
                   uint64_t{place.origin[1]} * place.row_pitch +
                   uint64_t{place.origin[0]} * element_bytes;
  return {first, element_bytes, element_bytes, place.row_pitch, place.slice_pitch};
}

void copy_row(const Elements& dest, uint8_t* to, const Elements& source, const uint8_t* from,
              uint32_t count) {
  if (dest.stride == dest.bytes && source.stride == source.bytes && dest.bytes == source.bytes) {
    std::memmove(to, from, uint64_t{count} * dest.bytes);
    return;
  }
  const uint32_t bytes = std::min(dest.bytes, source.bytes);
  for (uint32_t i = 0; i < count; ++i, to += dest.stride, from += source.stride) {
    std::memcpy(to, from, bytes);
    std::memset(to + bytes, 0, dest.bytes - bytes);
  }
}

rtapi::Status Target::copy_texture(const runtime::CopyTextureCommand& command) {
  if (auto s = finish(); !s) return s;
  const uint32_t element_bytes =
      std::max(element_bytes_of(command.dest), element_bytes_of(command.source));
  auto* texture = static_cast<Texture*>(command.dest.texture.get());
  std::unique_lock<std::mutex> lock;
  if (texture != nullptr) lock = texture->lock();
  // Both sides have as many samples.
  const uint32_t samples = texture != nullptr ? texture->stored().samples() : 1;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    const Elements dest = elements_of(command.dest, element_bytes, sample);
    const Elements source = elements_of(command.source, element_bytes, sample);
    for (uint32_t z = 0; z < command.extent[2]; ++z) {
      for (uint32_t y = 0; y < command.extent[1]; ++y) {
        copy_row(dest, dest.first + z * dest.slice_pitch + y * dest.row_pitch, source,
                 source.first + z * source.slice_pitch + y * source.row_pitch, command.extent[0]);
      }
    }
  }
  if (texture != nullptr) {
    texture->written(command.dest.mip, command.dest.array_element, command.dest.origin,
                     command.extent, device_.arena());
  }
  return {};
}

// One element of a texture, from the place's origin on.
raster::Surface surface_at(const runtime::TextureCopyPlace& place,
                           const runtime::ResolveCommand& command) {
  runtime::TargetView view;
  view.texture = place.texture;
  view.mip = place.mip;
  view.first_slice = place.array_element;
  view.format = command.format;
  view.width = command.extent[0];
  view.height = command.extent[1];
  raster::Surface surface = surface_of(view);
  surface.texels += uint64_t{place.origin[1]} * surface.row_pitch +
                    uint64_t{place.origin[0]} *
                        static_cast<const Texture&>(*place.texture).stored().element_bytes();
  return surface;
}

rtapi::Status Target::resolve(const runtime::ResolveCommand& command) {
  if (auto s = finish(); !s) return s;
  raster::resolve(surface_at(command.dest, command), surface_at(command.source, command),
                  command.mode);
  return {};
}

rtapi::Status Target::clear(const runtime::ClearUavCommand& command) {
  if (auto s = finish(); !s) return s;
  if (command.view.kind != shader::DescriptorKind::kTexture) {
    device_.memory().evict(command.view.address, command.view.size_bytes);
  }
  clear_view(command);
  return {};
}

}  // namespace

rtapi::Status Device::execute(std::span<const runtime::Command> commands) {
  Target target(*this);
  auto status = runtime::execute(commands, target, context_);
  return status ? target.finish() : status;
}

}  // namespace kaamos::embree
