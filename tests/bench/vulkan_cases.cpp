// SPDX-License-Identifier: MIT
//
// vulkan/...: the Vulkan backend against a minimal hand-written program, the gain from sorting
// triangles, and the cost of the first dispatch. backends/...: Embree against Vulkan.
#include <rtapi/upload.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "effects/assets/gltf/gltf_load.h"
#include "fixtures.h"
#include "hand_vulkan.h"

namespace kaamos::bench {
namespace {

namespace fs = std::filesystem;

constexpr RaySet kVulkanRaySets[] = {RaySet::kPrimary, RaySet::kSun, RaySet::kAmbientOcclusion,
                                     RaySet::kDiffuse};

bool is_hit(uint32_t visible) {
  return visible == 0;
}
bool is_hit(const ClosestResult& result) {
  return result.t >= 0;
}

bool is_hit(const ShadedResult& result) {
  return result.t >= 0;
}

// Hits may differ for 1 of 10,000 rays.
template <typename T>
void check_same_hits(const std::vector<T>& a, const std::vector<T>& b) {
  size_t different = a.size() == b.size() ? 0 : a.size();
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    different += is_hit(a[i]) != is_hit(b[i]);
  if (different > std::max<size_t>(a.size() / 10000, 1)) {
    throw std::runtime_error("results differ in " + std::to_string(different) + " of " +
                             std::to_string(a.size()) + " rays");
  }
}

// Compares the rates of two runs over the same rays.
Line rates(const std::string& name, const Measure& measure, const RayGrid& grid,
           const std::function<void()>& ours, const std::function<void()>& baseline) {
  const Pairs times = time_pairs(measure, ours, baseline);
  const double mrays = 1e-6 * static_cast<double>(grid.rays.size());
  return {name, 1 / times.ratio, mrays / times.ours, mrays / times.baseline, "Mrays/s", true};
}

// HitObject::TraceRay and Invoke against TraceRay.
template <typename T>
Case hit_object_case(const char* name, Program usual, Program program) {
  return {name, [=](Fixtures& f, const Measure& measure) {
            const RayGrid& grid = f.rays(RaySet::kPrimary);
            DxrDispatch by_trace(f.vulkan_scene(), usual, grid);
            DxrDispatch by_object(f.vulkan_scene(), program, grid);
            by_trace.run();
            by_object.run();
            check_same_hits(by_object.results<T>(), by_trace.results<T>());
            return rates(
                name, measure, grid, [&] { by_object.run(); }, [&] { by_trace.run(); });
          }};
}

Case hand_case(RaySet set) {
  const std::string name = std::string("vulkan/hand/") + name_of(set);
  return {name, [=](Fixtures& f, const Measure& measure) {
            const RayGrid& grid = f.rays(set);
            HandVulkan& hand = f.hand_vulkan();
            hand.set_rays(grid);
            if (is_visibility(set)) {
              DxrDispatch dispatch(f.vulkan_scene(), Program::kVisible, grid);
              const Line line = rates(
                  name, measure, grid, [&] { dispatch.run(); }, [&] { hand.visible(); });
              check_same_hits(dispatch.results<uint32_t>(), hand.visible_results());
              return line;
            }
            DxrDispatch dispatch(f.vulkan_scene(), Program::kClosest, grid);
            const Line line = rates(
                name, measure, grid, [&] { dispatch.run(); }, [&] { hand.closest(); });
            check_same_hits(dispatch.results<ClosestResult>(), hand.closest_results());
            return line;
          }};
}

Case backends_case(RaySet set) {
  const std::string name = std::string("backends/") + name_of(set);
  return {name, [=](Fixtures& f, const Measure& measure) {
            const RayGrid& grid = f.rays(set);
            const Program program = is_visibility(set) ? Program::kVisible : Program::kClosest;
            DxrDispatch embree(f.dxr_scene(false), program, grid);
            DxrDispatch vulkan(f.vulkan_scene(), program, grid);
            const Line line = rates(
                name, measure, grid, [&] { embree.run(); }, [&] { vulkan.run(); });
            if (is_visibility(set)) {
              check_same_hits(embree.results<uint32_t>(), vulkan.results<uint32_t>());
            } else {
              check_same_hits(embree.results<ClosestResult>(), vulkan.results<ClosestResult>());
            }
            return line;
          }};
}

// Sets an environment variable for the lifetime of the object.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (old_) {
      setenv(name_, old_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

// A scene with one instance of one mesh.
struct MeshScene {
  std::vector<effects::Vertex> vertices;
  SceneData data;

  MeshScene(std::vector<effects::Vertex> all, std::vector<uint32_t> indices)
      : vertices(std::move(all)) {
    MeshData& mesh = data.meshes.emplace_back();
    mesh.vertices = &vertices;
    const auto triangles = static_cast<uint32_t>(indices.size() / 3);
    mesh.geometries.push_back({0, static_cast<uint32_t>(vertices.size()), 0, triangles, 0, false});
    mesh.indices = std::move(indices);
    data.instances.push_back({0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}});
    data.record_count = 1;
    data.scene.materials.emplace_back();
  }
  MeshScene(const MeshScene&) = delete;
  MeshScene& operator=(const MeshScene&) = delete;
};

// The scanned dragon from the scenes beside the checkout; without them, a coiled, wavy body with
// triangles in row order.
std::unique_ptr<MeshScene> make_dragon(bool quick) {
  auto loaded =
      effects::load_gltf(std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/chinesedragon.gltf");
  if (loaded.ok() && !quick) {
    const effects::Mesh& mesh = loaded.value().scene.meshes.front();
    const effects::Geometry& geometry = mesh.geometries.front();
    std::vector<uint32_t> indices(geometry.index_count);
    for (uint32_t i = 0; i < geometry.index_count; ++i) indices[i] = mesh.index(geometry, i);
    return std::make_unique<MeshScene>(mesh.vertices, std::move(indices));
  }
  const uint32_t rows = quick ? 60 : 800;
  constexpr uint32_t kColumns = 62;
  std::vector<effects::Vertex> vertices;
  std::vector<uint32_t> indices;
  for (uint32_t row = 0; row <= rows; ++row) {
    for (uint32_t column = 0; column <= kColumns; ++column) {
      const float along = 18.8f * static_cast<float>(row) / static_cast<float>(rows);
      const float around = 6.2831853f * static_cast<float>(column) / kColumns;
      const float thick = 0.3f + 0.05f * std::sin(9 * along) * std::cos(5 * around);
      effects::Vertex& vertex = vertices.emplace_back();
      const glm::vec3 outwards(std::cos(along), 0, std::sin(along));
      vertex.position = outwards + glm::vec3(0, 0.15f * along, 0) +
                        thick * (std::cos(around) * outwards + glm::vec3(0, std::sin(around), 0));
    }
  }
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < kColumns; ++column) {
      const uint32_t a = row * (kColumns + 1) + column;
      const uint32_t c = a + kColumns + 1;
      indices.insert(indices.end(), {a, c, a + 1, a + 1, c, c + 1});
    }
  }
  return std::make_unique<MeshScene>(std::move(vertices), std::move(indices));
}

void shuffle_triangles(MeshScene& scene) {
  std::vector<uint32_t>& indices = scene.data.meshes.front().indices;
  std::mt19937 random(1);
  for (size_t i = indices.size() / 3; i > 1; --i) {
    const size_t other = random() % i;
    for (size_t k = 0; k < 3; ++k) std::swap(indices[(i - 1) * 3 + k], indices[other * 3 + k]);
  }
}

// Rays from around the mesh to points in it.
RayGrid rays_at(const MeshScene& scene, uint32_t count) {
  glm::vec3 low(INFINITY);
  glm::vec3 high(-INFINITY);
  for (const effects::Vertex& vertex : scene.vertices) {
    low = glm::min(low, vertex.position);
    high = glm::max(high, vertex.position);
  }
  const glm::vec3 middle = 0.5f * (low + high);
  const float radius = glm::length(high - low);
  RayGrid grid;
  grid.width = 32;
  grid.height = count / 32;
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  for (uint32_t i = 0; i < grid.width * grid.height; ++i) {
    const glm::vec3 from(normal(random), normal(random), normal(random));
    const glm::vec3 origin = middle + radius * glm::normalize(from);
    const glm::vec3 at(normal(random), normal(random), normal(random));
    const glm::vec3 direction = glm::normalize(middle + 0.15f * radius * at - origin);
    Ray& ray = grid.rays.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = origin[axis];
      ray.direction[axis] = direction[axis];
    }
    ray.t_min = 0;
    ray.t_max = 1e30f;
  }
  return grid;
}

Case sorting_case(bool shuffled) {
  const std::string name = std::string("vulkan/sorting/") + (shuffled ? "shuffled" : "dragon");
  return {name, [=](Fixtures& f, const Measure& measure) {
            const bool quick = f.options().quick;
            const auto scene = make_dragon(quick);
            if (shuffled) shuffle_triangles(*scene);
            const RayGrid grid = rays_at(*scene, shuffled || quick ? 512 : 16384);
            DxrScene sorted(scene->data, f.threads(), false, "vulkan");
            DxrDispatch ours(sorted, Program::kClosest, grid);
            const Environment without("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", "SORT");
            DxrScene unsorted(scene->data, f.threads(), false, "vulkan");
            DxrDispatch baseline(unsorted, Program::kClosest, grid);
            Measure fewer = measure;
            fewer.pairs = std::min(fewer.pairs, 3);
            const Line line = rates(
                name, fewer, grid, [&] { ours.run(); }, [&] { baseline.run(); });
            check_same_hits(ours.results<ClosestResult>(), baseline.results<ClosestResult>());
            return line;
          }};
}

// State object, tables and the first dispatch, in milliseconds; the baseline is the second
// dispatch.
Case first_dispatch_case(bool cached) {
  const std::string name = std::string("vulkan/first-dispatch/") + (cached ? "cached" : "cold");
  return {name, [=](Fixtures& f, const Measure& measure) {
            if (f.has_vulkan_scene()) {
              throw std::runtime_error("the driver has started with its own cache already");
            }
            const auto scene = make_dragon(true);
            const RayGrid grid = rays_at(*scene, 32);
            std::string folder = (fs::temp_directory_path() / "kaamos-bench-XXXXXX").string();
            if (mkdtemp(folder.data()) == nullptr)
              throw std::runtime_error("no folder for a cache");
            // The driver reads this when an instance is created; an instance lives as long as its
            // last device.
            const Environment cache("MESA_SHADER_CACHE_DIR", folder);
            Measure wall = measure;  // the driver compiles on threads of its own
            wall.clock = Clock::kWall;
            std::vector<double> first;
            std::vector<double> second;
            const int rounds = std::min(measure.pairs, 3);
            for (int round = cached ? -1 : 0; round < rounds; ++round) {
              if (!cached) fs::remove_all(folder);
              DxrScene device(scene->data, f.threads(), false, "vulkan");
              std::unique_ptr<DxrDispatch> dispatch;
              const double ms =
                  1e3 * seconds(measure, [&] {
                    dispatch = std::make_unique<DxrDispatch>(device, Program::kClosest, grid);
                    dispatch->run();
                  });
              if (round < 0) continue;
              first.push_back(ms);
              second.push_back(1e3 * seconds(wall, [&] { dispatch->run(); }));
            }
            fs::remove_all(folder);
            return Line{name, median(first), median(first), median(second), "ms", false};
          }};
}

}  // namespace

bool has_vulkan() {
  for (const rtapi::DeviceInfo& info : rtapi::EnumerateDevices()) {
    if (info.Backend == "vulkan") return true;
  }
  return false;
}

std::vector<Case> vulkan_cases() {
  std::vector<Case> cases;
  if (!has_vulkan()) return cases;
  // First, before another case has started the driver.
  for (const bool cached : {false, true}) cases.push_back(first_dispatch_case(cached));
  for (const RaySet set : kVulkanRaySets) cases.push_back(hand_case(set));
  cases.push_back(hit_object_case<ClosestResult>("hit-object/vulkan/primary", Program::kClosest,
                                                 Program::kHitObject));
  cases.push_back(hit_object_case<ShadedResult>("hit-object/vulkan/shaded", Program::kShaded,
                                                Program::kShadedHitObject));
  for (const bool shuffled : {false, true}) cases.push_back(sorting_case(shuffled));
  for (const RaySet set : kVulkanRaySets) cases.push_back(backends_case(set));
  return cases;
}

}  // namespace kaamos::bench
