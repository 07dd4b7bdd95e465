// SPDX-License-Identifier: MIT
// Bakes volumes: runs volume_bake.hlsl until every cell is good enough.
#include <shaders/volume_bake.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "effects/engine/ray_pass.h"
#include "effects/indirect/indirect_diffuse/cell_budget.h"
#include "effects/indirect/indirect_diffuse/packed_cell.h"
#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

namespace {

using Clock = std::chrono::steady_clock;

// Mirrors BakeConstants in volume_bake.hlsl.
struct BakeConstants {
  std::uint32_t task_count;
  std::uint32_t first_sample;
  std::uint32_t sample_count;
  std::uint32_t bounces;
  std::uint32_t width;
  std::uint32_t seed;
  std::uint32_t lights;
};

constexpr std::uint32_t kGridWidth = 1024;
constexpr double kStepSeconds = 0.25;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

RayPassDesc bake_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "indirect light bake";
  desc.library = library;
  desc.ray_generation = "BakeRayGen";
  desc.miss[kRayTypeSurface] = "PathMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"PathAnyHit", "PathClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 60;
  return desc;
}

// By local light, in the order of light_constants: whether it is baked.
std::vector<std::uint32_t> baked_lights(const Scene& scene) {
  std::vector<std::uint32_t> baked;
  for (const Light& light : scene.lights) {
    if (light.type != LightType::kDirectional) baked.push_back(light.baked ? 1 : 0);
  }
  if (baked.empty()) baked.push_back(0);  // a view needs an element
  return baked;
}

// Holds the objects that are on the device during a bake.
class Baker {
 public:
  Baker(const rtapi::Device& device, rtapi::CommandQueue& queue, const Frame& frame,
        const BakeDesc& desc, const StepCallback& progress)
      : device_(device), queue_(queue), frame_(frame), desc_(desc), progress_(progress) {}

  // `centers`: of the cells, relative to the camera.
  rtapi::Status create(const GpuScene& gpu, const Scene& scene, const Lighting& lighting,
                       const rtapi::ShaderLibrary& library, const std::vector<glm::vec4>& centers) {
    halves_ = static_cast<std::uint32_t>(2 * centers.size());
    all_paths_ = static_cast<double>(centers.size()) * desc_.samples;
    const auto center_buffer = rtapi::CreateUploadBuffer(device_, centers, "cell centers");
    if (!center_buffer) return center_buffer.error();
    centers_ = *center_buffer;
    const auto light_buffer =
        rtapi::CreateUploadBuffer(device_, baked_lights(scene), "baked lights");
    if (!light_buffer) return light_buffer.error();
    lights_ = *light_buffer;
    const auto tasks = rtapi::CreateUploadBuffer(
        device_, std::vector<glm::uvec2>(halves_, glm::uvec2(0)), "bake tasks");
    if (!tasks) return tasks.error();
    tasks_ = *tasks;
    rtapi::BufferDesc sums;
    sums.SizeInBytes = halves_ * sizeof(CellSums);
    sums.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    sums.InitialState = rtapi::ResourceStates::kUnorderedAccess;
    sums.Name = "indirect light sums";
    const auto sum_buffer = device_.CreateBuffer(sums);
    if (!sum_buffer) return sum_buffer.error();
    sums_ = *sum_buffer;
    auto views = frame_.create_pass_views(device_);
    if (!views) return views.error();
    views_ = *views;
    const std::array<std::pair<rtapi::Buffer, std::uint32_t>, 3> inputs = {
        std::pair{centers_, std::uint32_t{sizeof(glm::vec4)}},
        std::pair{tasks_, std::uint32_t{sizeof(glm::uvec2)}}, std::pair{lights_, 4u}};
    for (std::uint32_t i = 0; i < inputs.size(); ++i) {
      const auto s = views_.set_shader_resource(3 + i, inputs[i].first, inputs[i].second);
      if (!s) return s;
    }
    if (const auto s = views_.set_unordered_access(0, sums_, sizeof(CellSums)); !s) return s;
    if (const auto s = lighting.bind(views_); !s) return s;
    const auto pass = RayPass::create(device_, frame_, gpu, bake_pass(library));
    if (!pass) return pass.error();
    pass_ = *pass;
    auto list = device_.CreateCommandList();
    if (!list) return list.error();
    list_ = *list;
    return {};
  }

  // Brings each half to as many samples as `wanted` says, all of which have `first` already. A step
  // takes more samples as long as steps are short.
  rtapi::Result<Outcome> trace(std::uint32_t first, const std::vector<std::uint32_t>& wanted) {
    // Those with the most samples first: whoever still needs some is then at the front.
    std::vector<std::uint32_t> order(halves_);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return wanted[a] > wanted[b]; });
    for (std::uint32_t i = 0; i < halves_; ++i) {
      tasks_.data<glm::uvec2>()[i] = {order[i], wanted[order[i]]};
    }
    const double left = std::accumulate(wanted.begin(), wanted.end(), -1.0 * halves_ * first);
    const double all = std::max(is_pilot_ ? all_paths_ : paths_ + left, 1.0);
    is_pilot_ = false;
    std::uint32_t count = halves_, step = 1;
    while (true) {
      while (count > 0 && wanted[order[count - 1]] <= first) --count;
      if (count == 0) return Outcome::kDone;
      const auto seconds = run(count, first, step);
      if (!seconds) return seconds.error();
      for (std::uint32_t i = 0; i < count; ++i) {
        paths_ += std::min(step, wanted[order[i]] - first);
      }
      if (progress_ && !progress_(std::min(paths_ / all, 1.0))) return Outcome::kStopped;
      first += step;
      const double next = step * kStepSeconds / std::max(*seconds, 1e-4);
      step = static_cast<std::uint32_t>(std::clamp(next, 1.0, 2.0 * step));
    }
  }

  rtapi::Result<std::vector<CellSums>> sums() {
    const auto bytes = rtapi::ReadbackBuffer(device_, queue_, sums_);
    if (!bytes) return bytes.error();
    std::vector<CellSums> sums(halves_);
    std::memcpy(sums.data(), bytes->data(), bytes->size());
    return sums;
  }

 private:
  // The first `count` tasks; returns the seconds it took.
  rtapi::Result<double> run(std::uint32_t count, std::uint32_t first, std::uint32_t samples) {
    const BakeConstants constants = {count,      first,      samples,     desc_.bounces,
                                     kGridWidth, desc_.seed, desc_.lights};
    if (const auto reset = list_.Reset(); !reset) return reset.error();
    pass_.dispatch_grid(list_, frame_, {}, kGridWidth, (count + kGridWidth - 1) / kGridWidth,
                        PassArguments(views_, constants));
    const auto start = Clock::now();
    if (const auto done = queue_.ExecuteAndWait(list_); !done) return done.error();
    return seconds_since(start);
  }

  const rtapi::Device& device_;
  rtapi::CommandQueue& queue_;
  const Frame& frame_;
  const BakeDesc& desc_;
  const StepCallback& progress_;
  rtapi::Buffer centers_, lights_, tasks_, sums_;
  PassViews views_;
  RayPass pass_;
  rtapi::CommandList list_;
  std::uint32_t halves_ = 0;
  double all_paths_ = 0, paths_ = 0;
  bool is_pilot_ = true;
};

// The mean of a cell's halves, two each of `sums` and `samples`.
VolumeCell mean_of(const CellSums* sums, const std::uint32_t* samples, bool by_samples) {
  VolumeCell cell;
  float back_faces = 0;
  const float all = static_cast<float>(samples[0] + samples[1]);
  for (int half = 0; half < 2; ++half) {
    if (samples[half] == 0) continue;
    // Halves of different size count alike: a half that the other one found to need more samples
    // would count too much by its size.
    const float scale = by_samples ? 1.0f / all : 0.5f / static_cast<float>(samples[half]);
    cell.mean += scale * sums[half].mean;
    cell.slope_x += scale * sums[half].slope_x;
    cell.slope_y += scale * sums[half].slope_y;
    cell.slope_z += scale * sums[half].slope_z;
    back_faces += sums[half].back_faces;
  }
  cell.validity = back_faces > kMaxBackFaces * all ? 0.0f : 1.0f;
  return cell;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> volume_bake_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_volume_bake());
}

rtapi::Result<Outcome> bake_volume(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                   const Frame& frame, const GpuScene& gpu, const Scene& scene,
                                   const Lighting& lighting, const glm::dvec3& origin,
                                   const rtapi::ShaderLibrary& library, const BakeDesc& desc,
                                   IndirectVolume& volume, BakeStatistics* statistics,
                                   const StepCallback& progress) {
  const auto start = Clock::now();
  const std::vector<std::uint32_t> cells = volume.cells_in_use();
  if (cells.empty()) return Outcome::kDone;
  const std::vector<glm::dvec3> all_centers = volume.cell_centers();
  std::vector<glm::vec4> centers;
  for (const std::uint32_t cell : cells) {
    centers.emplace_back(glm::vec3(all_centers[cell] - origin), 0.0f);
  }
  Baker baker(device, queue, frame, desc, progress);
  if (const auto s = baker.create(gpu, scene, lighting, library, centers); !s) return s.error();

  const bool adapts = desc.error > 0 && desc.samples > 4 * kPilotSamples;
  std::vector<std::uint32_t> wanted(2 * cells.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = adapts ? kPilotSamples : (desc.samples + (i % 2 == 0 ? 1 : 0)) / 2;
  }
  if (const auto s = baker.trace(0, wanted); !is_done(s)) return s;
  auto sums = baker.sums();
  if (!sums) return sums.error();
  if (adapts) {
    wanted = samples_of_halves(cells, *sums, desc);
    if (const auto s = baker.trace(kPilotSamples, wanted); !is_done(s)) return s;
    sums = baker.sums();
    if (!sums) return sums.error();
  }
  std::fill(volume.cells.begin(), volume.cells.end(), VolumeCell{});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    volume.cells[cells[i]] = mean_of(&(*sums)[2 * i], &wanted[2 * i], !adapts);
  }
  if (statistics != nullptr) {
    *statistics = bake_statistics(*sums, wanted, desc);
    statistics->bytes = volume.cells.size() * sizeof(PackedCell) + volume.brick_starts.size() * 4;
    statistics->seconds = seconds_since(start);
  }
  fill_solids(volume);
  return Outcome::kDone;
}

}  // namespace kaamos::effects
