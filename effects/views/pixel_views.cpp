// SPDX-License-Identifier: MIT
#include <rtapi/upload.h>
#include <shaders/pixel_views.h>

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/views/view_passes.h"

namespace kaamos::effects {

namespace {

// A kernel over the frame, what else it reads, and the picture of its numbers.
class PixelView {
 public:
  explicit PixelView(FrameRenderer& renderer) : renderer_(renderer), frame_(renderer.frame()) {}

  rtapi::Status create() {
    const auto library = pixel_views_library();
    if (!library) return library.error();
    library_ = *library;
    const auto picture =
        frame_.create_picture(renderer_.device(), "view", rtapi::Format::kR32G32B32A32Float);
    if (!picture) return picture.error();
    numbers_ = *picture;
    const auto made = frame_.create_pass_views(renderer_.device());
    if (!made) return made.error();
    views = *made;
    return views.set_unordered_access(0, numbers_);
  }

  // One thread for each of width x height.
  rtapi::Status run(const std::string& kernel, std::uint32_t width, std::uint32_t height,
                    std::uint32_t constant = 0) {
    const auto pass = ComputePass::create(renderer_.device(), frame_, library_, kernel);
    if (!pass) return pass.error();
    const auto done = renderer_.runner().execute([&](rtapi::CommandList& list) {
      pass->dispatch(list, frame_, {}, PassArguments(views, constant), width, height);
    });
    if (!done) return done.error();
    return {};
  }

  rtapi::Result<FloatImage> run(const std::string& kernel, std::uint32_t constant = 0) {
    if (const auto s = run(kernel, frame_.width(), frame_.height(), constant); !s) {
      return s.error();
    }
    return read();
  }

  rtapi::Result<FloatImage> read() { return renderer_.read(numbers_); }

  PassViews views;

 private:
  FrameRenderer& renderer_;
  const Frame& frame_;
  rtapi::ShaderLibrary library_;
  rtapi::Texture numbers_;
};

rtapi::Result<FloatImage> run_over(FrameRenderer& renderer, const std::string& kernel,
                                   const std::function<rtapi::Status(PassViews&)>& bind) {
  PixelView view(renderer);
  if (const auto s = view.create(); !s) return s.error();
  if (const auto s = bind(view.views); !s) return s.error();
  return view.run(kernel);
}

// Shows what the denoiser remembers of a signal: runs `of_light` over its moments, or
// `of_visibility`.
rtapi::Result<FloatImage> run_over_memory(FrameRenderer& renderer, const std::string& name,
                                          const std::string& of_light,
                                          const std::string& of_visibility) {
  const SignalFilters& filters = renderer.filters().signals();
  const SignalFilters::Signal& signal = *filters.find(name);
  const SignalFilters::Memory memory = filters.memory(signal);
  const bool is_light = memory.moments != nullptr;
  PixelView view(renderer);
  if (const auto s = view.create(); !s) return s.error();
  const rtapi::Texture& kept = is_light ? *memory.moments : *memory.visibility;
  if (const auto s = view.views.set_unordered_access(1, kept); !s) return s.error();
  return view.run(is_light ? of_light : of_visibility, signal.samples);
}

// Adds the corners of the box about an instance's mesh in its own space: they tell where the
// instance is, and of which shape.
void add_box(const Scene& scene, std::size_t index, const InstanceState& state,
             const glm::dvec3& origin, std::vector<glm::vec4>& corners) {
  const std::uint32_t mesh_index =
      state.mesh == kNoIndex ? scene.instances[index].mesh : static_cast<std::uint32_t>(state.mesh);
  const Mesh& mesh = scene.meshes[mesh_index];
  Bounds box = mesh.bounds();
  if (state.is_deformed()) {
    Mesh posed;
    posed.vertices = deform_vertices(mesh, state);
    box = posed.bounds();
  }
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.max.x : box.min.x,
                            (i & 2) != 0 ? box.max.y : box.min.y,
                            (i & 4) != 0 ? box.max.z : box.min.z);
    const glm::dvec3 world = glm::dvec3(state.transform * glm::dvec4(corner, 1)) - origin;
    corners.emplace_back(glm::vec3(world), 1.0f);
  }
}

// Numbers from 1 on, in the order of the first instance that stands on each.
std::vector<std::uint32_t> number_bottom_levels(const GpuScene& gpu, std::size_t instances) {
  std::vector<std::uint32_t> out;
  std::map<rtapi::GpuVirtualAddress, std::uint32_t> numbers;
  const auto descs = gpu.instances.data<rtapi::RaytracingInstanceDesc>();
  for (std::size_t i = 0; i < instances; ++i) {
    const auto next = static_cast<std::uint32_t>(numbers.size() + 1);
    out.push_back(numbers.try_emplace(descs[i].AccelerationStructure, next).first->second);
  }
  return out;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> pixel_views_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_pixel_views());
}

rtapi::Result<FloatImage> view_bottom_levels(FrameRenderer& renderer) {
  const Scene& scene = renderer.context().scene;
  const FrameMoment& moment = renderer.context().moment;
  const std::vector<InstanceState> states = renderer.scene_stage().states_at(moment);
  std::vector<glm::vec4> corners;
  for (std::size_t i = 0; i < states.size(); ++i) {
    add_box(scene, i, states[i], moment.camera.position(), corners);
  }
  std::vector<std::uint32_t> levels = number_bottom_levels(renderer.context().gpu, states.size());
  const auto instances = static_cast<std::uint32_t>(states.size());
  // A view needs at least one element, even of an empty scene.
  if (states.empty()) {
    levels.push_back(0);
    corners.emplace_back(0.0f);
  }
  const auto level_buffer = rtapi::CreateUploadBuffer(renderer.device(), levels, "bottom levels");
  if (!level_buffer) return level_buffer.error();
  const auto corner_buffer = rtapi::CreateUploadBuffer(renderer.device(), corners, "box corners");
  if (!corner_buffer) return corner_buffer.error();
  PixelView view(renderer);
  if (const auto s = view.create(); !s) return s.error();
  if (const auto s = view.views.set_shader_resource(3, *level_buffer, 4); !s) return s.error();
  if (const auto s = view.views.set_shader_resource(4, *corner_buffer, 16); !s) return s.error();
  const auto colored = view.run("BottomLevels");
  if (!colored) return colored.error();
  if (const auto s = view.run("BoxOutlines", 12, instances, instances); !s) return s.error();
  return view.read();
}

rtapi::Result<FloatImage> view_light_clusters(FrameRenderer& renderer) {
  const Lighting& lighting = *renderer.lights().lighting();
  const auto listed = renderer.runner().execute(
      [&](rtapi::CommandList& list) { lighting.update(list, renderer.frame(), false); });
  if (!listed) return listed.error();
  return run_over(renderer, "LightClusters",
                  [&](PassViews& views) { return lighting.bind(views); });
}

rtapi::Result<FloatImage> view_variance(FrameRenderer& renderer, const std::string& signal) {
  return run_over_memory(renderer, signal, "Variance", "VisibilityVariance");
}

rtapi::Result<FloatImage> view_history_length(FrameRenderer& renderer, const std::string& signal) {
  return run_over_memory(renderer, signal, "HistoryLength", "VisibilityHistory");
}

rtapi::Result<FloatImage> view_volume_cells(FrameRenderer& renderer) {
  return run_over(renderer, "VolumeCells",
                  [&](PassViews& views) { return renderer.lights().volume()->bind(views); });
}

}  // namespace kaamos::effects
