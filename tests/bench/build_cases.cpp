// SPDX-License-Identifier: MIT
//
// build/...: building acceleration structures against the same builds by hand on Embree, which
// copies the same buffers.
#include <malloc.h>
#include <rtapi/upload.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "fixtures.h"
#include "tests/common/structures.h"

namespace kaamos::bench {
namespace {

using namespace rtapi;

// A bumpy sphere of 2 * n * n triangles.
struct Rock {
  std::vector<effects::Vertex> vertices;
  MeshData mesh;

  explicit Rock(uint32_t n) {
    for (uint32_t row = 0; row <= n; ++row) {
      for (uint32_t column = 0; column <= n; ++column) vertices.push_back(vertex(n, row, column));
    }
    for (uint32_t row = 0; row < n; ++row) {
      for (uint32_t column = 0; column < n; ++column) {
        const uint32_t a = row * (n + 1) + column;
        const uint32_t c = a + n + 1;
        for (uint32_t index : {a, c, a + 1, a + 1, c, c + 1}) mesh.indices.push_back(index);
      }
    }
    mesh.vertices = &vertices;
    mesh.geometries.push_back({0, static_cast<uint32_t>(vertices.size()), 0, 2 * n * n, 0, false});
  }
  Rock(const Rock&) = delete;
  Rock& operator=(const Rock&) = delete;

 private:
  static effects::Vertex vertex(uint32_t n, uint32_t row, uint32_t column) {
    const float theta = 3.14159265f * static_cast<float>(row) / static_cast<float>(n);
    const float phi = 6.2831853f * static_cast<float>(column % n) / static_cast<float>(n);
    const float radius = 1 + 0.1f * std::sin(9 * theta) * std::cos(7 * phi) +
                         0.01f * std::sin(90 * theta) * std::sin(80 * phi);
    effects::Vertex out;
    out.position = radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                      std::sin(theta) * std::sin(phi));
    return out;
  }
};

// The rock's buffers on a device, and its geometry.
struct DeviceRock {
  Device device;
  CommandQueue queue;
  Buffer vertices;
  Buffer indices;
  RaytracingGeometryDesc geometry;

  DeviceRock(const Rock& rock, uint32_t threads) {
    DeviceDesc desc;
    desc.Threads = threads;
    device = CreateDevice(desc).value();
    queue = device.CreateCommandQueue().value();
    vertices = CreateUploadBuffer(device, rock.vertices, "vertices").value();
    indices = CreateUploadBuffer(device, rock.mesh.indices, "indices").value();
    geometry.Flags = RaytracingGeometryFlags::kOpaque;
    geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
    geometry.Triangles.IndexFormat = Format::kR32Uint;
    geometry.Triangles.IndexCount = static_cast<uint32_t>(rock.mesh.indices.size());
    geometry.Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
    geometry.Triangles.VertexCount = static_cast<uint32_t>(rock.vertices.size());
    geometry.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), effects::kVertexStride};
  }
  void build(Buffer& structure) {
    BuildRaytracingAccelerationStructureInputs inputs;
    inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
    inputs.NumDescs = 1;
    inputs.pGeometryDescs = &geometry;
    structure = test::build_structure(device, queue, inputs);
  }
};

struct EmbreeDevice {
  RTCDevice device = new_embree_device();
  EmbreeDevice() = default;
  ~EmbreeDevice() { rtcReleaseDevice(device); }
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCScene build(const MeshData& mesh) const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = new_triangles(device, mesh, mesh.geometries.front());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
  }
};

uint32_t rock_size(const Fixtures& fixtures) {
  return fixtures.options().quick ? 32 : 360;
}

Line blas_time(Fixtures& fixtures, const Measure& measure) {
  const Rock rock(rock_size(fixtures));
  DeviceRock ours(rock, fixtures.threads());
  const EmbreeDevice embree;
  const Pairs times = time_pairs(
      measure,
      [&] {
        Buffer structure;
        ours.build(structure);
      },
      [&] { fixtures.arena().execute([&] { rtcReleaseScene(embree.build(rock.mesh)); }); });
  return {"build/blas-time", times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

// Resident bytes of the whole process, after returning free memory to the system.
double resident_bytes() {
  malloc_trim(0);
  uint64_t total = 0;
  uint64_t resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Memory that stays resident while a structure exists. Measured with four at once, so that the
// allocators' own pages matter less.
Line blas_memory(Fixtures& fixtures, const Measure& measure) {
  constexpr int kStructures = 4;
  const Rock rock(rock_size(fixtures));
  DeviceRock device(rock, fixtures.threads());
  const EmbreeDevice embree;
  const auto ours = [&] {
    const double before = resident_bytes();
    Buffer structures[kStructures];
    for (Buffer& structure : structures) device.build(structure);
    return std::max(resident_bytes() - before, 1.0);
  };
  const auto baseline = [&] {
    const double before = resident_bytes();
    RTCScene scenes[kStructures];
    for (RTCScene& scene : scenes) {
      fixtures.arena().execute([&] { scene = embree.build(rock.mesh); });
    }
    const double bytes = resident_bytes() - before;
    for (RTCScene scene : scenes) rtcReleaseScene(scene);
    return std::max(bytes, 1.0);
  };
  ours();
  baseline();
  const Pairs bytes = run_pairs(measure, ours, baseline);
  constexpr double kUnit = 1e6 * kStructures;
  return {"build/blas-memory",    bytes.ratio, bytes.ours / kUnit,
          bytes.baseline / kUnit, "MB",        false};
}

// Instances of one small mesh on a grid, each with another rotation.
std::vector<std::array<float, 12>> instance_transforms(uint32_t count) {
  std::vector<std::array<float, 12>> out;
  const uint32_t edge = static_cast<uint32_t>(std::ceil(std::cbrt(count)));
  for (uint32_t i = 0; i < count; ++i) {
    const float c = std::cos(static_cast<float>(i));
    const float s = std::sin(static_cast<float>(i));
    const float x = static_cast<float>(i % edge);
    const float y = static_cast<float>(i / edge % edge);
    const float z = static_cast<float>(i / edge / edge);
    out.push_back({c, 0, s, 3 * x, 0, 1, 0, 3 * y, -s, 0, c, 3 * z});
  }
  return out;
}

RTCScene build_instances(RTCDevice device, RTCScene mesh,
                         const std::vector<std::array<float, 12>>& transforms) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (size_t i = 0; i < transforms.size(); ++i) {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, mesh);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, transforms[i].data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(scene, instance, static_cast<uint32_t>(i));
    rtcReleaseGeometry(instance);
  }
  rtcCommitScene(scene);
  return scene;
}

Line tlas(const std::string& name, uint32_t count, Fixtures& fixtures, const Measure& measure) {
  const Rock rock(24);
  DeviceRock ours(rock, fixtures.threads());
  const EmbreeDevice embree;
  const auto transforms = instance_transforms(count);
  Buffer mesh;
  ours.build(mesh);
  std::vector<RaytracingInstanceDesc> descs(count);
  for (uint32_t i = 0; i < count; ++i) {
    std::memcpy(descs[i].Transform, transforms[i].data(), sizeof(descs[i].Transform));
    descs[i].AccelerationStructure = mesh.GetGPUVirtualAddress();
  }
  const Buffer instances = CreateUploadBuffer(ours.device, descs, "instances").value();
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = count;
  inputs.InstanceDescs = instances.GetGPUVirtualAddress();
  RTCScene embree_mesh = embree.build(rock.mesh);
  // Some milliseconds of work for each run.
  const int repeats = fixtures.options().quick ? 1 : static_cast<int>(1 + 10000 / count);
  const Pairs times = time_pairs(
      measure,
      [&] {
        for (int i = 0; i < repeats; ++i) {
          const Buffer structure = test::build_structure(ours.device, ours.queue, inputs);
        }
      },
      [&] {
        for (int i = 0; i < repeats; ++i) {
          fixtures.arena().execute(
              [&] { rtcReleaseScene(build_instances(embree.device, embree_mesh, transforms)); });
        }
      });
  rtcReleaseScene(embree_mesh);
  const double unit = 1e3 / repeats;
  return {name, times.ratio, unit * times.ours, unit * times.baseline, "ms", false};
}

Case tlas_case(const char* name, uint32_t count) {
  return {name, [=](Fixtures& fixtures, const Measure& measure) {
            return tlas(name, count, fixtures, measure);
          }};
}

}  // namespace

std::vector<Case> build_cases() {
  return {{"build/blas-time", blas_time},
          {"build/blas-memory", blas_memory},
          tlas_case("build/tlas-100", 100),
          tlas_case("build/tlas-1k", 1000),
          tlas_case("build/tlas-10k", 10000)};
}

}  // namespace kaamos::bench
