// SPDX-License-Identifier: MIT
#include "runtime/embree/testing/harness.h"
#include "runtime/embree/device.h"
#include "runtime/embree/testing/rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace kaamos::embree::testing {
namespace {

using Flags = rtapi::RaytracingAccelerationStructureBuildFlags;
using Type = rtapi::RaytracingAccelerationStructureType;

uint32_t record_constant(const shader::Invocation& invocation) {
  uint32_t value;
  std::memcpy(&value, invocation.local_arguments, sizeof(value));
  return value;
}

void end_ray(shader::Invocation& invocation, Payload& payload, End end) {
  payload.end = end;
  ++payload.calls;
  payload.record = record_constant(invocation);
  if (end == End::kMiss) {
    payload.values = {};
    payload.values.ray = invocation.ray->ray;
    payload.values.t_current = invocation.ray->t_current;
    payload.values.ray_flags = invocation.ray->ray_flags;
  } else {
    payload.values = *invocation.ray;
  }
  payload.depth = invocation.depth;
}

void note_any_hit(shader::Invocation& invocation, void* data) {
  auto& payload = *static_cast<Payload*>(data);
  ++payload.any_hits;
  payload.any_hit_record = record_constant(invocation);
  payload.any_hit_kind = invocation.ray->hit_kind;
  payload.any_hit_t = invocation.ray->t_current;
  payload.smallest_any_hit_t = std::min(payload.smallest_any_hit_t, payload.any_hit_t);
  payload.any_hit_primitives |= 1u << (invocation.ray->primitive_index & 31);
}

struct Job {
  const Ray* rays;
  Payload* payloads;
  uint64_t count;
};

template <typename Function>
shader::AnyFn erase(Function function) {
  return reinterpret_cast<shader::AnyFn>(function);
}

rtapi::TraversalPrecision precision_of_environment() {
  const char* value = std::getenv("KAAMOS_TEST_PRECISION");
  const std::string_view name = value != nullptr ? value : "robust";
  if (name == "fast") return rtapi::TraversalPrecision::kFast;
  return name == "exact" ? rtapi::TraversalPrecision::kExact : rtapi::TraversalPrecision::kRobust;
}

}  // namespace

::testing::AssertionResult is_distance(float t, float expected) {
  return is_distance(t, expected, precision_of_environment());
}

::testing::AssertionResult is_distance(float t, float expected,
                                       rtapi::TraversalPrecision precision) {
  const bool rounds = precision != rtapi::TraversalPrecision::kExact && rounds_distances();
  // An ulp is between epsilon / 2 and epsilon times the number.
  const float error = rounds ? std::numeric_limits<float>::epsilon() * std::abs(expected) : 0.0f;
  if (std::abs(t - expected) <= error) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "t is " << t << ", not " << expected;
}

void closest_hit(shader::Invocation& invocation, void* data, const void* attributes) {
  auto& payload = *static_cast<Payload*>(data);
  end_ray(invocation, payload, End::kClosestHit);
  std::memcpy(payload.object_to_world, invocation.ray->object_to_world, 48);
  std::memcpy(payload.world_to_object, invocation.ray->world_to_object, 48);
  const bool triangle = invocation.ray->hit_kind >= 254;
  std::memcpy(payload.attributes, attributes, triangle ? 8 : 32);
}

void miss(shader::Invocation& invocation, void* payload) {
  end_ray(invocation, *static_cast<Payload*>(payload), End::kMiss);
}

shader::AnyHitResult any_hit_accept(shader::Invocation& invocation, void* payload, const void*) {
  note_any_hit(invocation, payload);
  return shader::AnyHitResult::kAccept;
}
shader::AnyHitResult any_hit_ignore(shader::Invocation& invocation, void* payload, const void*) {
  note_any_hit(invocation, payload);
  return shader::AnyHitResult::kIgnore;
}
shader::AnyHitResult any_hit_end(shader::Invocation& invocation, void* payload, const void*) {
  note_any_hit(invocation, payload);
  return shader::AnyHitResult::kAcceptAndEndSearch;
}

ReportLog& report_log() {
  static ReportLog log;
  return log;
}

void report_all(shader::Invocation& invocation) {
  ReportLog& log = report_log();
  ++log.calls;
  log.primitives.push_back(invocation.ray->primitive_index);
  for (const Report& report : log.reports) {
    const auto result = invocation.dispatch->services->report_hit(
        invocation, report.t, report.hit_kind, report.attributes, sizeof(report.attributes));
    log.results.push_back(result);
    log.t_current.push_back(invocation.ray->t_current);
    if (result == shader::ReportHitResult::kEndSearch) return;
  }
}

void trace_job(shader::Invocation& invocation) {
  Job job;
  std::memcpy(&job, invocation.dispatch->root_arguments, sizeof(job));
  const uint64_t i =
      invocation.index[0] + uint64_t{invocation.dispatch->dimensions[0]} * invocation.index[1];
  if (i >= job.count) return;
  trace_ray(invocation, job.rays[i], &job.payloads[i]);
}

void trace_jobs(shader::Invocation& invocation, uint32_t count) {
  Job job;
  std::memcpy(&job, invocation.dispatch->root_arguments, sizeof(job));
  const uint32_t first_x = invocation.index[0];
  const uint64_t row = uint64_t{invocation.dispatch->dimensions[0]} * invocation.index[1];
  for (uint32_t begin = first_x; begin < first_x + count; begin += shader::kLanes) {
    uint32_t left = 0;  // one bit each
    for (uint32_t lane = 0; lane < shader::kLanes; ++lane) {
      const uint64_t x = uint64_t{begin} + lane;
      if (x < first_x + count && row + x < job.count) left |= 1u << lane;
    }
    const Ray* rays = job.rays + row + begin;
    while (left != 0) {
      const Ray& first = rays[std::countr_zero(left)];
      shader::LaneRays lane_rays;
      // The contents of other lanes must not matter.
      std::memset(&lane_rays, 0xFF, sizeof(lane_rays));
      Payload payloads[shader::kLanes];
      uint32_t alike = 0;
      for (int lane = 0; lane < shader::kLanes; ++lane) {
        const bool takes_part =
            (left >> lane & 1) != 0 &&
            std::memcmp(static_cast<const shader::TraceRayArguments*>(&first),
                        static_cast<const shader::TraceRayArguments*>(&rays[lane]),
                        sizeof(shader::TraceRayArguments)) == 0;
        if (!takes_part) continue;
        alike |= 1u << lane;
        payloads[lane] = job.payloads[row + begin + static_cast<uint32_t>(lane)];
        for (int axis = 0; axis < 3; ++axis) {
          lane_rays.origin[axis][lane] = rays[lane].ray.origin[axis];
          lane_rays.direction[axis][lane] = rays[lane].ray.direction[axis];
        }
        lane_rays.t_min[lane] = rays[lane].ray.t_min;
        lane_rays.t_max[lane] = rays[lane].ray.t_max;
      }
      invocation.index[0] = begin;
      invocation.dispatch->services->trace_rays(invocation, first, payloads, lane_rays, alike);
      for (int lane = 0; lane < shader::kLanes; ++lane) {
        if ((alike >> lane & 1) != 0) {
          job.payloads[row + begin + static_cast<uint32_t>(lane)] = payloads[lane];
        }
      }
      left &= ~alike;
    }
  }
}

PipelineBuilder::PipelineBuilder(uint32_t max_recursion_depth)
    : pipeline_(std::make_shared<runtime::LinkedPipeline>()) {
  pipeline_->max_recursion_depth = max_recursion_depth;
  pipeline_->max_payload_bytes = sizeof(Payload);
  pipeline_->max_attribute_bytes = 32;
}

const runtime::LinkedShader* PipelineBuilder::add_shader(shader::Stage stage, shader::AnyFn entry,
                                                         uint64_t stack_bytes,
                                                         shader::RayGenerationRowFn row) {
  if (entry == nullptr) return nullptr;
  auto code = std::make_shared<shader::ExportDesc>();
  *code = {};
  code->name = code->mangled_name = "hand-written";
  code->stage = stage;
  code->entry = entry;
  code->row = row;
  code->flags = shader::kExportReadsHitKind;
  auto linked = std::make_unique<runtime::LinkedShader>();
  linked->name = "shader" + std::to_string(pipeline_->shaders.size());
  linked->stage = stage;
  linked->code = code.get();
  linked->stack_bytes = stack_bytes;
  pipeline_->keep_alive.push_back(code);
  pipeline_->shaders.push_back(std::move(linked));
  return pipeline_->shaders.back().get();
}

rtapi::ShaderIdentifier PipelineBuilder::add_record(runtime::LinkedRecord record) {
  static std::atomic<uint32_t> next{1};
  const uint32_t index = next++;
  std::memcpy(record.identifier.data(), &index, sizeof(index));
  std::memset(record.identifier.data() + 4, 0x5A, 28);
  auto owned = std::make_unique<runtime::LinkedRecord>(std::move(record));
  pipeline_->identifiers.insert(owned.get());
  const rtapi::ShaderIdentifier identifier = owned->identifier;
  pipeline_->records.push_back(std::move(owned));
  return identifier;
}

rtapi::ShaderIdentifier PipelineBuilder::ray_generation(shader::RayGenerationFn entry) {
  runtime::LinkedRecord record;
  record.kind = runtime::RecordKind::kRayGeneration;
  const shader::RayGenerationRowFn row =
      entry == trace_job && std::getenv("KAAMOS_TEST_ROWS") != nullptr ? trace_jobs : nullptr;
  record.shader = add_shader(shader::Stage::kRayGeneration, erase(entry), 0, row);
  return add_record(std::move(record));
}

rtapi::ShaderIdentifier PipelineBuilder::miss(shader::MissFn entry) {
  runtime::LinkedRecord record;
  record.kind = runtime::RecordKind::kMiss;
  record.shader = add_shader(shader::Stage::kMiss, erase(entry));
  return add_record(std::move(record));
}

rtapi::ShaderIdentifier PipelineBuilder::callable(shader::CallableFn entry, uint64_t stack_bytes) {
  runtime::LinkedRecord record;
  record.kind = runtime::RecordKind::kCallable;
  record.shader = add_shader(shader::Stage::kCallable, erase(entry), stack_bytes);
  return add_record(std::move(record));
}

rtapi::ShaderIdentifier PipelineBuilder::hit_group(shader::ClosestHitFn closest,
                                                   shader::AnyHitFn any,
                                                   shader::IntersectionFn intersection) {
  runtime::LinkedRecord record;
  record.kind = runtime::RecordKind::kHitGroup;
  record.hit_group_type = intersection != nullptr ? rtapi::HitGroupType::kProceduralPrimitive
                                                  : rtapi::HitGroupType::kTriangles;
  record.closest_hit = add_shader(shader::Stage::kClosestHit, erase(closest));
  record.any_hit = add_shader(shader::Stage::kAnyHit, erase(any));
  record.intersection = add_shader(shader::Stage::kIntersection, erase(intersection));
  return add_record(std::move(record));
}

GeometryInput triangle_at(float z, rtapi::RaytracingGeometryFlags flags) {
  GeometryInput input;
  // Seen along +z with y up, x points left in a left-handed space, so this order is clockwise.
  input.vertices = {{0, 2, z}, {2, -2, z}, {-2, -2, z}};
  input.flags = flags;
  return input;
}

GeometryInput box_at(float z, rtapi::RaytracingGeometryFlags flags) {
  GeometryInput input;
  input.boxes = {{-1, -1, z, 1, 1, z + 1}};
  input.flags = flags;
  return input;
}

rtapi::RaytracingInstanceDesc instance_of(uint64_t bottom_level) {
  rtapi::RaytracingInstanceDesc desc;
  desc.AccelerationStructure = bottom_level;
  return desc;
}

Ray ray_along_z(uint64_t top_level, float x, float y) {
  Ray ray = {};
  ray.acceleration_structure = top_level;
  ray.instance_inclusion_mask = 0xFF;
  ray.payload_bytes = sizeof(Payload);
  ray.ray = {{x, y, 0}, 0, {0, 0, 1}, 100};
  return ray;
}

void trace_ray(shader::Invocation& invocation, const Ray& ray, void* payload) {
  invocation.dispatch->services->trace_ray(invocation, ray, payload, origin_t_min(ray.ray),
                                           direction_t_max(ray.ray));
}

Harness::Harness(uint32_t threads) : Harness(threads, precision_of_environment()) {}

Harness::Harness(uint32_t threads, rtapi::TraversalPrecision precision) {
  context_.addresses = &addresses_;
  context_.message = [this](const rtapi::Message& message) { messages.push_back(message); };
  rtapi::DeviceDesc desc;
  desc.Threads = threads;
  desc.Precision = precision;
  auto device = backend_factory().create(desc, context_);
  if (device) {
    device_ = std::move(*device);
  } else {
    ADD_FAILURE() << device.error().message;
  }
}

Harness::~Harness() = default;

std::shared_ptr<runtime::BackendBuffer> Harness::buffer(uint64_t bytes) {
  rtapi::BufferDesc desc;
  desc.SizeInBytes = bytes;
  auto created = device_->create_buffer(desc);
  if (!created) {
    ADD_FAILURE() << created.error().message;
    return nullptr;
  }
  runtime::Allocation allocation;
  allocation.address = (*created)->address();
  allocation.size_bytes = bytes;
  addresses_.insert(std::move(allocation));
  buffers_.push_back(*created);
  return *created;
}

void Harness::free(std::shared_ptr<runtime::BackendBuffer>& buffer) {
  addresses_.erase(buffer->address());
  std::erase(buffers_, buffer);
  buffer.reset();
}

rtapi::RaytracingGeometryDesc Harness::geometry(const GeometryInput& input) {
  rtapi::RaytracingGeometryDesc desc;
  desc.Flags = input.flags;
  if (!input.boxes.empty()) {
    desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
    desc.AABBs = {};
    desc.AABBs.AABBCount = input.boxes.size();
    desc.AABBs.AABBs = {upload(input.boxes), sizeof(rtapi::RaytracingAabb)};
    return desc;
  }
  desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  desc.Triangles.VertexCount = static_cast<uint32_t>(input.vertices.size());
  desc.Triangles.VertexBuffer = {upload(input.vertices), sizeof(Vertex)};
  if (!input.indices.empty()) {
    desc.Triangles.IndexFormat = rtapi::Format::kR32Uint;
    desc.Triangles.IndexCount = static_cast<uint32_t>(input.indices.size());
    desc.Triangles.IndexBuffer = upload(input.indices);
  }
  if (!input.transform.empty()) desc.Triangles.Transform3x4 = upload(input.transform);
  return desc;
}

runtime::BuildCommand Harness::bottom_level_command(const std::vector<GeometryInput>& geometries,
                                                    Flags flags) {
  runtime::BuildCommand command;
  command.type = Type::kBottomLevel;
  command.flags = flags;
  for (const GeometryInput& input : geometries) command.geometries.push_back(geometry(input));
  const auto info = device_->prebuild_info(command);
  command.dest = buffer(info.ResultDataMaxSizeInBytes)->address();
  command.scratch = buffer(info.ScratchDataSizeInBytes)->address();
  return command;
}

runtime::BuildCommand Harness::top_level_command(
    const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  runtime::BuildCommand command;
  command.type = Type::kTopLevel;
  command.instance_count = static_cast<uint32_t>(instances.size());
  command.instance_descs = upload(instances);
  const auto info = device_->prebuild_info(command);
  command.dest = buffer(info.ResultDataMaxSizeInBytes)->address();
  return command;
}

uint64_t Harness::bottom_level(const std::vector<GeometryInput>& geometries, Flags flags) {
  const auto command = bottom_level_command(geometries, flags);
  const auto status = execute(command);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return status.ok() ? command.dest : 0;
}

uint64_t Harness::top_level(const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  const auto command = top_level_command(instances);
  const auto status = execute(command);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return status.ok() ? command.dest : 0;
}

uint64_t Harness::scene(const std::vector<GeometryInput>& geometries, uint32_t instance_flags) {
  auto instance = instance_of(bottom_level(geometries));
  instance.Flags = instance_flags;
  return top_level({instance});
}

void Harness::set_pipeline(const PipelineBuilder& builder, rtapi::ShaderIdentifier ray_generation) {
  auto created = device_->create_raytracing_pipeline(builder.linked());
  ASSERT_TRUE(created.ok());
  pipeline_ = *created;
  desc_.RayGenerationShaderRecord = {table({{ray_generation, 0}}, 64).StartAddress, 64};
}

rtapi::GpuVirtualAddressRangeAndStride Harness::table(const std::vector<Record>& records,
                                                      uint64_t stride_bytes) {
  if (records.empty()) return {};
  const uint64_t step = std::max<uint64_t>(stride_bytes, 64);
  std::vector<uint8_t> bytes(records.size() * step);
  for (size_t i = 0; i < records.size(); ++i) {
    std::memcpy(&bytes[i * step], records[i].identifier.data(), 32);
    std::memcpy(&bytes[i * step + 32], &records[i].constant, 4);
  }
  return {upload(bytes), bytes.size(), stride_bytes};
}

void Harness::set_hit_table(const std::vector<Record>& records, uint64_t stride_bytes) {
  desc_.HitGroupTable = table(records, stride_bytes);
}
void Harness::set_miss_table(const std::vector<Record>& records, uint64_t stride_bytes) {
  desc_.MissShaderTable = table(records, stride_bytes);
}
void Harness::set_callable_table(const std::vector<Record>& records, uint64_t stride_bytes) {
  desc_.CallableShaderTable = table(records, stride_bytes);
}

rtapi::Status Harness::dispatch(uint32_t width, uint32_t height, uint32_t depth, const void* root,
                                size_t root_bytes) {
  runtime::DispatchRaysCommand command;
  command.pipeline = pipeline_;
  auto arguments = std::make_shared<runtime::RootArguments>();
  std::memcpy(arguments->bytes.data(), root, std::min(root_bytes, arguments->bytes.size()));
  command.state.root_arguments = arguments;
  command.desc = desc_;
  command.desc.Width = width;
  command.desc.Height = height;
  command.desc.Depth = depth;
  command.pipeline_stack_bytes = pipeline_stack_bytes_;
  return execute(std::move(command));
}

void Harness::use_standard_pipeline(shader::AnyHitFn any, shader::IntersectionFn intersection,
                                    uint32_t max_recursion_depth) {
  PipelineBuilder builder(max_recursion_depth);
  const auto ray_generation = builder.ray_generation(trace_job);
  const auto hits = builder.hit_group(closest_hit, any, intersection);
  const auto misses = builder.miss(miss);
  set_pipeline(builder, ray_generation);
  std::vector<Record> hit_records;
  for (uint32_t i = 0; i < 64; ++i) hit_records.push_back({hits, i});
  std::vector<Record> miss_records;
  for (uint32_t i = 0; i < 8; ++i) miss_records.push_back({misses, 1000 + i});
  set_hit_table(hit_records);
  set_miss_table(miss_records);
}

std::vector<Payload> Harness::trace(const std::vector<Ray>& rays) {
  std::vector<Payload> payloads(rays.size());
  const Job job = {rays.data(), payloads.data(), rays.size()};
  const uint32_t width = static_cast<uint32_t>(std::min<size_t>(rays.size(), 256));
  const uint32_t height = static_cast<uint32_t>((rays.size() + width - 1) / width);
  const auto status = dispatch(width, height, 1, &job, sizeof(job));
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return payloads;
}

rtapi::Status Harness::execute(runtime::Command command) {
  return device_->execute(std::span<const runtime::Command>(&command, 1));
}

}  // namespace kaamos::embree::testing
