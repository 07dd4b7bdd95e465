// SPDX-License-Identifier: MIT
#include "rtapi/testing/null_backend.h"

#include <cstdlib>
#include <cstring>

#include <rtapi/error_ids.h>

#include "rtapi/src/backends.h"

namespace rtapi::testing {

namespace runtime = kaamos::runtime;

namespace {

NullLog g_log;

class NullBuffer : public runtime::BackendBuffer {
 public:
  explicit NullBuffer(uint64_t size) : size_(size) {
    const size_t rounded = (size + 0xFFFF) & ~size_t{0xFFFF};
    bytes_ = static_cast<uint8_t*>(std::aligned_alloc(0x10000, rounded));
    if (bytes_) std::memset(bytes_, 0, size);
  }
  ~NullBuffer() override { std::free(bytes_); }
  uint64_t address() const override { return reinterpret_cast<uint64_t>(bytes_); }
  uint64_t size_bytes() const override { return size_; }
  uint8_t* host() const override { return bytes_; }

 private:
  uint64_t size_;
  uint8_t* bytes_;
};

class NullBackend : public runtime::BackendDevice {
 public:
  NullBackend() { info_ = {"null", "Null device", "Records, runs nothing", 1}; }
  const DeviceInfo& info() const override { return info_; }

  Result<std::shared_ptr<runtime::BackendBuffer>> create_buffer(const BufferDesc& desc) override {
    if (desc.SizeInBytes > (uint64_t{1} << 30)) {
      return Error{error_ids::backend::kOutOfMemory, ErrorCode::kOutOfMemory,
                   "KA0990 out of memory"};
    }
    return std::shared_ptr<runtime::BackendBuffer>(std::make_shared<NullBuffer>(desc.SizeInBytes));
  }
  Result<std::shared_ptr<runtime::BackendTexture>> create_texture(const TextureDesc&) override {
    return std::make_shared<runtime::BackendTexture>();
  }
  Result<std::shared_ptr<runtime::BackendBuffer>> create_placed_buffer(
      const runtime::HeapPlace&, const BufferDesc& desc) override {
    return create_buffer(desc);
  }
  Result<std::shared_ptr<runtime::BackendTexture>> create_placed_texture(
      const runtime::HeapPlace&, const TextureDesc& desc) override {
    return create_texture(desc);
  }
  Result<uint64_t> create_texture_view(runtime::BackendTexture&,
                                       const runtime::TextureViewDesc& desc) override {
    g_log.texture_views.push_back(desc);
    return uint64_t{g_log.texture_views.size()};
  }
  Result<uint64_t> create_sampler(const SamplerDesc& desc) override {
    g_log.samplers.push_back(desc);
    return uint64_t{g_log.samplers.size()};
  }
  bool supports_format(Format format, bool) const override {
    return GetFormatInfo(format).type != FormatClass::kUnsupported;
  }
  // All but R9G9B9E5; SNORM cannot be blended, as on lavapipe.
  bool supports_target(Format format, bool blended) const override {
    const FormatClass type = GetFormatInfo(format).type;
    return type != FormatClass::kUnsupported && format != Format::kR9G9B9E5Sharedexp &&
           (!blended || type != FormatClass::kSnorm);
  }

  // As lavapipe.
  bool supports_samples(Format, uint32_t count) const override { return count == 1 || count == 4; }

  Result<std::shared_ptr<runtime::BackendPipeline>> create_raytracing_pipeline(
      std::shared_ptr<const runtime::LinkedPipeline> linked) override {
    auto pipeline = std::make_shared<NullPipeline>();
    g_log.last_raytracing = linked;
    pipeline->raytracing = std::move(linked);
    return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
  }
  Result<std::shared_ptr<runtime::BackendPipeline>> create_compute_pipeline(
      std::shared_ptr<const runtime::LinkedCompute> linked) override {
    auto pipeline = std::make_shared<NullPipeline>();
    g_log.last_compute = linked;
    pipeline->compute = std::move(linked);
    return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
  }

  Result<std::shared_ptr<runtime::BackendPipeline>> create_graphics_pipeline(
      std::shared_ptr<const runtime::LinkedGraphics> linked) override {
    auto pipeline = std::make_shared<NullPipeline>();
    g_log.last_graphics = linked;
    pipeline->graphics = std::move(linked);
    return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
  }

  Result<std::shared_ptr<runtime::BackendQueryHeap>> create_query_heap(QueryHeapType type,
                                                                       uint32_t count) override {
    if (type != QueryHeapType::kTimestamp) {
      return std::shared_ptr<runtime::BackendQueryHeap>(
          std::make_shared<runtime::CountingQueries>(type, count));
    }
    return std::make_shared<runtime::BackendQueryHeap>(count);
  }
  uint64_t timestamp_frequency() const override { return 1000; }

  RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const runtime::BuildCommand& inputs) const override {
    const bool update =
        HasAny(inputs.flags, RaytracingAccelerationStructureBuildFlags::kAllowUpdate |
                                 RaytracingAccelerationStructureBuildFlags::kPerformUpdate);
    return {512 + 256 * (inputs.geometries.size() + inputs.instance_count), 256,
            update ? 256u : 0u};
  }
  bool has_micromaps() const override { return true; }

  Status execute(std::span<const runtime::Command> commands) override {
    for (const runtime::Command& command : commands) {
      if (const auto* copy = std::get_if<runtime::CopyBufferCommand>(&command)) {
        std::memcpy(copy->dest->host() + copy->dest_offset,
                    copy->source->host() + copy->source_offset, copy->size_bytes);
      }
      g_log.executed.push_back(command);
    }
    Status result = g_log.fail_next_execute;
    g_log.fail_next_execute = Status();
    return result;
  }

 private:
  DeviceInfo info_;
};

std::vector<DeviceInfo> Enumerate() {
  return {NullBackend().info()};
}

Result<std::unique_ptr<runtime::BackendDevice>> Create(const DeviceDesc&, const runtime::Context&) {
  return std::unique_ptr<runtime::BackendDevice>(std::make_unique<NullBackend>());
}

const runtime::BackendFactory kFactory = {"null", Enumerate, Create};

}  // namespace

Device CreateNullDevice(DeviceDesc desc) {
  rtapi::detail::register_backend(&kFactory);
  g_log = NullLog();
  desc.Backend = "null";
  return CreateDevice(desc).value();
}

NullLog& null_log() {
  return g_log;
}

}  // namespace rtapi::testing
