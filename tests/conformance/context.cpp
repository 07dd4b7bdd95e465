// SPDX-License-Identifier: MIT
#include "tests/conformance/context.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "runtime/embree/testing/rounding.h"

namespace kaamos::conformance {

using namespace rtapi;

std::string Target::name() const {
  if (backend != "embree") return backend;
  const char* names[] = {"fast", "robust", "exact"};
  return backend + "/" + names[static_cast<uint32_t>(precision)];
}

Geometry triangle(float z, float x, RaytracingGeometryFlags flags) {
  Geometry out;
  out.vertices = {x, 3, z, x + 3, -3, z, x - 3, -3, z};
  out.flags = flags;
  return out;
}

Geometry box(float z, float x, RaytracingGeometryFlags flags) {
  Geometry out;
  out.boxes = {{x - 1, -1, z - 1, x + 1, 1, z + 1}};
  out.flags = flags;
  return out;
}

RaytracingInstanceDesc instance(const Buffer& bottom_level, float x, uint32_t contribution,
                                uint32_t flags) {
  RaytracingInstanceDesc out;
  out.Transform[0][3] = x;
  out.InstanceContributionToHitGroupIndex = contribution;
  out.Flags = flags;
  out.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return out;
}

namespace {

// The devices of this process by Target::name(). Never destroyed: at exit a driver may already be
// gone.
using Pool = std::map<std::string, std::vector<std::unique_ptr<SharedDevice>>>;
Pool& pool() {
  static Pool& devices = *new Pool;
  return devices;
}

std::unique_ptr<SharedDevice> new_device(DeviceDesc desc) {
  SharedDevice out;
  if (desc.Checked && !desc.OnMessage) {
    out.messages = std::make_shared<std::vector<Message>>();
    // Messages arrive one at a time, because one context at a time uses a device.
    desc.OnMessage = [to = out.messages](const Message& message) { to->push_back(message); };
  }
  out.device = CreateDevice(desc).value();
  return std::make_unique<SharedDevice>(std::move(out));
}

std::string pool_name(const Target& target) {
  return target.name() + (target.checked ? "/checked" : "") + "/" + GetName(target.tier);
}

std::unique_ptr<SharedDevice> take_device(const Target& target) {
  auto& free = pool()[pool_name(target)];
  if (free.empty()) return new_device(target.device_desc());
  auto out = std::move(free.back());
  free.pop_back();
  return out;
}

}  // namespace

Context::Context(std::unique_ptr<SharedDevice> shared, const Target& target, bool goes_on)
    : target_(target), shared_(std::move(shared)), goes_on_(goes_on), device_(shared_->device) {
  queue_ = device_.CreateCommandQueue().value();
  if (shared_->messages) shared_->messages->clear();
}

Context::Context(const DeviceDesc& desc, const Target& target)
    : Context(new_device(desc), target, false) {}

Context::Context(const Target& target) : Context(take_device(target), target, true) {}

Context::~Context() {
  if (!goes_on_ || !device_.GetDeviceRemovedReason()) return;
  pool()[pool_name(target_)].push_back(std::move(shared_));
}

std::vector<std::string> Context::reports() const {
  std::vector<std::string> out;
  if (!shared_->messages) return out;
  for (const Message& message : *shared_->messages) {
    if (message.Severity == MessageSeverity::kInfo) continue;
    if (message.Id.number >= 400 && message.Id.number < 500) out.push_back(message.Text);
  }
  return out;
}

DeviceDesc Target::device_desc() const {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Precision = precision;
  desc.Checked = checked;
  desc.Tier = tier;
  desc.ShaderModel = kExperimentalShaderModel;
  return desc;
}

bool Context::is_distance(float found, float expected) const {
  const bool rounds = target_.backend == "embree" &&
                      target_.precision != rtapi::TraversalPrecision::kExact &&
                      embree::testing::rounds_distances();
  if (!rounds) return found == expected;
  // One ulp of a number lies between epsilon / 2 and epsilon times that number.
  return std::abs(found - expected) <= std::numeric_limits<float>::epsilon() * std::abs(expected);
}

void Context::distance(const std::string& what, const std::vector<float>& found,
                       const std::vector<float>& expected) {
  const bool same = std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                               [this](float a, float b) { return is_distance(a, b); });
  if (!same) fail(what + ": " + show(found) + ", expected " + show(expected));
}

void Context::close(const std::string& what, float found, float expected, float tolerance) {
  if (std::abs(found - expected) <= tolerance) return;
  fail(what + ": " + show(found) + ", expected " + show(expected) + " +- " + show(tolerance));
}

void Context::refused(const std::string& what, const Status& status, const char* id) {
  if (status) {
    fail(what + ": accepted, expected an error");
  } else if (id != nullptr && status.error().id.text() != id) {
    fail(what + ": expected " + id + ", found " + status.error().message);
  }
}

std::string Context::show_float(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

Buffer Context::keep(Buffer buffer) {
  keep_.push_back(buffer);
  return buffer;
}

Buffer Context::zeros(uint64_t bytes) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  return keep(device_.CreateBuffer(desc).value());
}

Buffer Context::structure_memory(uint64_t bytes) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kRaytracingAccelerationStructure;
  return keep(device_.CreateBuffer(desc).value());
}

std::vector<uint32_t> Context::read(const Buffer& buffer) {
  const auto bytes = ReadbackBuffer(device_, queue_, buffer).value();
  std::vector<uint32_t> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), out.size() * 4);
  return out;
}

Buffer Context::build(const BuildRaytracingAccelerationStructureInputs& inputs) {
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  const Buffer result = structure_memory(sizes.ResultDataMaxSizeInBytes);
  BuildRaytracingAccelerationStructureDesc build;
  build.Inputs = inputs;
  build.DestAccelerationStructureData = result.GetGPUVirtualAddress();
  build.ScratchAccelerationStructureData =
      zeros(std::max<uint64_t>(sizes.ScratchDataSizeInBytes, 256)).GetGPUVirtualAddress();
  CommandList list = device_.CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(build);
  queue_.ExecuteAndWait(list).value();
  return result;
}

std::vector<RaytracingGeometryDesc> Context::describe(const std::vector<Geometry>& geometries) {
  std::vector<RaytracingGeometryDesc> descs;
  for (const Geometry& geometry : geometries) {
    RaytracingGeometryDesc desc;
    desc.Flags = geometry.flags;
    if (geometry.boxes.empty()) {
      desc.Triangles.VertexFormat = Format::kR32G32B32Float;
      desc.Triangles.VertexCount = static_cast<uint32_t>(geometry.vertices.size() / 3);
      desc.Triangles.VertexBuffer = {upload(geometry.vertices).GetGPUVirtualAddress(), 12};
      if (!geometry.transform.empty()) {
        desc.Triangles.Transform3x4 = upload(geometry.transform).GetGPUVirtualAddress();
      }
    } else {
      desc.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
      desc.AABBs.AABBCount = geometry.boxes.size();
      desc.AABBs.AABBs = {upload(geometry.boxes).GetGPUVirtualAddress(), 24};
    }
    descs.push_back(desc);
  }
  return descs;
}

Buffer Context::bottom_level(const std::vector<Geometry>& geometries) {
  const auto descs = describe(geometries);
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = static_cast<uint32_t>(descs.size());
  inputs.pGeometryDescs = descs.data();
  return build(inputs);
}

Buffer Context::top_level(const std::vector<RaytracingInstanceDesc>& instances) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = static_cast<uint32_t>(instances.size());
  if (!instances.empty()) inputs.InstanceDescs = upload(instances).GetGPUVirtualAddress();
  return build(inputs);
}

Buffer Context::scene(const std::vector<Geometry>& geometries, uint32_t contribution,
                      uint32_t flags) {
  return top_level({instance(bottom_level(geometries), 0, contribution, flags)});
}

}  // namespace kaamos::conformance
