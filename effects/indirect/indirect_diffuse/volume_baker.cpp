// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/volume_baker.h"

#include <shaders/volume_bake.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <utility>

namespace kaamos::effects {

namespace {

using Clock = std::chrono::steady_clock;

// Both mirror volume_bake.hlsl.
struct BakeTask {
  std::uint32_t sum, first, last;
};
struct BakeConstants {
  std::uint32_t task_count;
  std::uint32_t done;
  std::uint32_t sample_count;
  std::uint32_t bounces;
  std::uint32_t width;
  std::uint32_t seed;
  std::uint32_t lights;
};

constexpr std::uint32_t kGridWidth = 1024;
constexpr double kStepSeconds = 0.25;

RayPassDesc bake_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "indirect light bake";
  desc.library = library;
  desc.ray_generation = "BakeRayGen";
  desc.miss[kRayTypeSurface] = "PathMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"PathAnyHit", "PathClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 76;
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

}  // namespace

rtapi::Result<VolumeBaker> VolumeBaker::create(const BakeScope& scope, const BakeDesc& desc,
                                               std::vector<CellPlace> cells) {
  VolumeBaker out(scope, desc);
  out.samples_.resize(2 * cells.size());
  out.cells_ = std::move(cells);
  if (const auto s = out.create_buffers(); !s) return s.error();
  if (const auto s = out.create_views(); !s) return s.error();
  const auto pass = RayPass::create(scope.device, scope.frame, scope.gpu, bake_pass(scope.library));
  if (!pass) return pass.error();
  out.pass_ = *pass;
  auto list = scope.device.CreateCommandList();
  if (!list) return list.error();
  out.list_ = *list;
  return out;
}

rtapi::Status VolumeBaker::create_buffers() {
  const auto upload = [this](rtapi::Buffer& buffer, const auto& elements,
                             const char* name) -> rtapi::Status {
    const auto created = rtapi::CreateUploadBuffer(scope_.device, elements, name);
    if (!created) return created.error();
    buffer = *created;
    return {};
  };
  const std::vector<glm::vec4> centers(cells_.size());
  if (const auto s = upload(centers_, centers, "cell centers"); !s) return s;
  const std::vector<BakeTask> tasks(samples_.size());
  if (const auto s = upload(tasks_, tasks, "bake tasks"); !s) return s;
  if (const auto s = upload(lights_, baked_lights(scope_.scene), "baked lights"); !s) return s;
  const auto create = [this](rtapi::Buffer& buffer, std::size_t bytes,
                             const char* name) -> rtapi::Status {
    rtapi::BufferDesc desc;
    desc.SizeInBytes = bytes;
    desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
    desc.Name = name;
    const auto created = scope_.device.CreateBuffer(desc);
    if (!created) return created.error();
    buffer = *created;
    return {};
  };
  const std::size_t sum_bytes = samples_.size() * sizeof(CellSums);
  if (const auto s = create(sums_, sum_bytes, "indirect light sums"); !s) return s;
  return create(seen_, cells_.size() * sizeof(std::uint32_t), "seen cells");
}

rtapi::Status VolumeBaker::create_views() {
  auto views = scope_.frame.create_pass_views(scope_.device);
  if (!views) return views.error();
  views_ = *views;
  const std::array<std::pair<rtapi::Buffer, std::uint32_t>, 3> inputs = {
      std::pair{centers_, std::uint32_t{sizeof(glm::vec4)}},
      std::pair{tasks_, std::uint32_t{sizeof(BakeTask)}}, std::pair{lights_, 4u}};
  for (std::uint32_t i = 0; i < inputs.size(); ++i) {
    const auto s = views_.set_shader_resource(3 + i, inputs[i].first, inputs[i].second);
    if (!s) return s;
  }
  if (const auto s = views_.set_unordered_access(0, sums_, sizeof(CellSums)); !s) return s;
  if (const auto s = views_.set_unordered_access(1, seen_, sizeof(std::uint32_t)); !s) return s;
  return scope_.lighting.bind(views_);
}

void VolumeBaker::see(const glm::dvec3& origin) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto& [middle, size] = cells_[i];
    centers_.data<glm::vec4>()[i] = glm::vec4(glm::vec3(middle - origin), size);
  }
}

rtapi::Result<Outcome> VolumeBaker::trace(const std::vector<std::uint32_t>& wanted,
                                          const StepCallback& progress) {
  std::vector<BakeTask> tasks;
  double all = 0;
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    if (wanted[i] <= samples_[i]) continue;
    tasks.push_back({i, samples_[i], wanted[i]});
    all += wanted[i] - samples_[i];
  }
  const auto more = [](const BakeTask& task) { return task.last - task.first; };
  // Those with the most samples first: whoever still needs some is then at the front.
  std::stable_sort(tasks.begin(), tasks.end(),
                   [&](const BakeTask& a, const BakeTask& b) { return more(a) > more(b); });
  std::copy(tasks.begin(), tasks.end(), tasks_.data<BakeTask>().begin());
  double paths = 0;
  // A step takes more samples as long as steps are short.
  for (std::uint32_t done = 0, step = 1;;) {
    while (!tasks.empty() && more(tasks.back()) <= done) tasks.pop_back();
    if (tasks.empty()) break;
    const auto start = Clock::now();
    const auto count = static_cast<std::uint32_t>(tasks.size());
    if (const auto s = run(pass_, count, done, step); !s) return s.error();
    for (const BakeTask& task : tasks) paths += std::min(step, more(task) - done);
    if (progress && !progress(paths / all)) return Outcome::kStopped;
    done += step;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double next = step * kStepSeconds / std::max(seconds, 1e-4);
    step = static_cast<std::uint32_t>(std::clamp(next, 1.0, 2.0 * step));
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i] = std::max(samples_[i], wanted[i]);
  return Outcome::kDone;
}

rtapi::Result<std::vector<CellSums>> VolumeBaker::sums() const {
  const auto bytes = rtapi::ReadbackBuffer(scope_.device, scope_.queue, sums_);
  if (!bytes) return bytes.error();
  std::vector<CellSums> sums(samples_.size());
  std::memcpy(sums.data(), bytes->data(), bytes->size());
  return sums;
}

rtapi::Status VolumeBaker::see_around(const std::vector<std::uint32_t>& cells) {
  if (cells.empty()) return {};
  if (!see_pass_) {
    RayPassDesc desc = bake_pass(scope_.library);
    desc.ray_generation = "SeeRayGen";
    const auto pass = RayPass::create(scope_.device, scope_.frame, scope_.gpu, desc);
    if (!pass) return pass.error();
    see_pass_ = *pass;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) tasks_.data<BakeTask>()[i] = {2 * cells[i], 0, 0};
  return run(*see_pass_, static_cast<std::uint32_t>(cells.size()), 0, 0);
}

rtapi::Result<std::vector<std::uint32_t>> VolumeBaker::seen() const {
  const auto bytes = rtapi::ReadbackBuffer(scope_.device, scope_.queue, seen_);
  if (!bytes) return bytes.error();
  std::vector<std::uint32_t> seen(cells_.size());
  std::memcpy(seen.data(), bytes->data(), bytes->size());
  return seen;
}

rtapi::Status VolumeBaker::run(const RayPass& pass, std::uint32_t count, std::uint32_t done,
                               std::uint32_t samples) {
  const BakeConstants constants = {count,      done,       samples,     desc_.bounces,
                                   kGridWidth, desc_.seed, desc_.lights};
  if (const auto reset = list_.Reset(); !reset) return reset;
  pass.dispatch_grid(list_, scope_.frame, {}, kGridWidth, (count + kGridWidth - 1) / kGridWidth,
                     PassArguments(views_, constants));
  return scope_.queue.ExecuteAndWait(list_);
}

std::vector<CellPlace> places_of(const IndirectVolume& volume,
                                 const std::vector<std::uint32_t>& cells) {
  const std::vector<CellPlace> all = volume.cell_places();
  std::vector<CellPlace> places;
  places.reserve(cells.size());
  for (const std::uint32_t cell : cells) places.push_back(all[cell]);
  return places;
}

VolumeCell cell_of(const CellSums* sums, const std::uint32_t* samples, bool by_samples) {
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

rtapi::Result<rtapi::ShaderLibrary> volume_bake_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_volume_bake());
}

}  // namespace kaamos::effects
