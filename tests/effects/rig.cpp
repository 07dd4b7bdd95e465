// SPDX-License-Identifier: MIT
#include "rig.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/composite/composite.h"
#include "effects/direct/direct.h"
#include "effects/frame/picture.h"
#include "effects/frame/ray_pass.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/lights/light_constants.h"
#include "effects/lights/lighting.h"
#include "effects/scene/gpu_scene.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace kaamos::test {

using namespace effects;

namespace {

constexpr rtapi::Format kSignalFormat = rtapi::Format::kR32G32B32A32Float;

rtapi::Device make_device(const RigOptions& options) {
  rtapi::DeviceDesc desc;
  desc.Backend = options.backend;
  desc.Threads = options.threads;
  return rtapi::CreateDevice(desc).value();
}

class Rig {
 public:
  Rig(const Scene& scene, const RigOptions& options);
  Pictures frame(const Scene& scene);
  IndirectVolume volume() const { return volume_; }

 private:
  // An effect that adds to a sum, and its denoiser.
  struct Step {
    std::string name;
    RayPass pass;
    rtapi::Texture sum;
    PassArguments arguments;
    Denoiser denoiser;
  };

  bool has(std::uint32_t effect) const { return (options_.effects & effect) != 0; }
  rtapi::Texture picture(const std::string& name) {
    return frame_->create_picture(device_, name, kSignalFormat).value();
  }
  RayPass pass(const RayPassDesc& desc) {
    return RayPass::create(device_, *frame_, gpu_, desc).value();
  }
  void add(const std::string& name, const RayPassDesc& desc, const rtapi::Texture& sum,
           const PassArguments& arguments);
  PassViews views(std::initializer_list<rtapi::Texture> pictures);
  void make_volume(const Scene& scene);
  void make_effects();
  void make_compose();
  void clear(rtapi::CommandList& list);
  void dispatch(rtapi::CommandList& list, const RayPass& pass, PassConstants constants,
                const PassArguments& arguments) const;
  Pictures read();
  const rtapi::Texture* denoised(const std::string& name) const;

  RigOptions options_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  std::optional<Frame> frame_;
  std::optional<Lighting> lighting_;
  std::optional<DirectLighting> direct_;
  IndirectVolume volume_;
  GpuVolume gpu_volume_;
  RayPass gbuffer_;
  std::vector<std::unique_ptr<PassViews>> views_;  // arguments point to them
  std::vector<std::unique_ptr<Step>> steps_;
  std::optional<ComposePass> compose_;
  std::optional<RayPass> glass_pass_;
  PassArguments glass_arguments_;
  ComputePass glass_compose_;
  rtapi::Texture glass_, transmittance_;
  rtapi::DescriptorHeap clear_heap_;
  std::uint32_t frames_ = 0;
};

Rig::Rig(const Scene& scene, const RigOptions& options)
    : options_(options),
      device_(make_device(options)),
      queue_(device_.CreateCommandQueue().value()) {
  const Camera& camera = scene.cameras.front();
  gpu_ = create_gpu_scene(device_, queue_, scene, camera.position()).value();
  FrameDesc desc;
  desc.width = options.width;
  desc.height = options.height;
  desc.seed = options.seed;
  frame_ = Frame::create(device_, queue_, scene, gpu_, camera, desc).value();
  lighting_ =
      Lighting::create(device_, *frame_, gpu_, lighting_library().value(),
                       static_cast<std::uint32_t>(light_constants(scene, camera.position()).size()))
          .value();
  gbuffer_ = pass(gbuffer_pass(gbuffer_library().value()));
  make_volume(scene);
  make_effects();
  make_compose();
}

void Rig::make_volume(const Scene& scene) {
  rtapi::CommandList list = device_.CreateCommandList().value();
  lighting_->update(list, *frame_);
  queue_.ExecuteAndWait(list).value();
  const glm::dvec3 origin = scene.cameras.front().position();
  if (options_.volume) {
    volume_ = *options_.volume;
  } else if (has(kRigIndirect)) {
    volume_ = layout_volume(scene, options_.cell).value();
    BakeDesc desc;
    desc.samples = options_.bake_samples;
    desc.bounces = 2;
    const std::atomic<bool> stop = false;
    bake_volume(
        device_, queue_, *frame_, gpu_, *lighting_, origin, volume_bake_library().value(), desc,
        volume_, [](double) {}, stop)
        .value();
  }
  gpu_volume_ = GpuVolume::create(device_, volume_, origin).value();
}

PassViews Rig::views(std::initializer_list<rtapi::Texture> pictures) {
  PassViews out = frame_->create_pass_views(device_).value();
  std::uint32_t u = 0;
  for (const rtapi::Texture& texture : pictures) out.set_unordered_access(u++, texture).value();
  lighting_->bind(out).value();
  gpu_volume_.bind(out).value();
  return out;
}

void Rig::add(const std::string& name, const RayPassDesc& desc, const rtapi::Texture& sum,
              const PassArguments& arguments) {
  auto step = std::make_unique<Step>();
  step->name = name;
  step->pass = pass(desc);
  step->sum = sum;
  step->arguments = arguments;
  const DenoiseLibraries libraries = denoise_libraries().value();
  step->denoiser = Denoiser::create(device_, *frame_, libraries, name, picture(name + " mean"),
                                    default_denoise(options_.denoise))
                       .value();
  step->denoiser.create_load(device_, *frame_, libraries, sum).value();
  steps_.push_back(std::move(step));
}

void Rig::make_effects() {
  const auto keep = [&](const PassViews& made) -> const PassViews& {
    return *views_.emplace_back(std::make_unique<PassViews>(made));
  };
  if (has(kRigAo)) {
    add("ao", ambient_occlusion_pass(ambient_occlusion_library().value()),
        frame_->texture(kAmbientOcclusionSum), {});
  }
  if (has(kRigSun)) {
    add("sun", sun_shadow_pass(sun_shadow_library().value()), frame_->texture(kSunVisibilitySum),
        {});
  }
  if (has(kRigLocal)) {
    direct_ =
        DirectLighting::create(device_, *frame_, *lighting_, direct_library().value()).value();
  }
  if (has(kRigContact)) {
    const rtapi::Texture sum = picture("contact");
    add("contact", contact_shadow_pass(contact_shadow_library().value()), sum,
        {keep(views({direct_->strongest(), sum})), options_.contact});
    direct_->set_contact(*denoised("contact")).value();
  }
  if (has(kRigIndirect)) {
    const rtapi::Texture sum = picture("indirect");
    add("indirect", indirect_diffuse_pass(indirect_diffuse_library().value()), sum,
        {keep(views({sum})), options_.indirect});
  }
  if (has(kRigReflections)) {
    const rtapi::Texture sum = picture("reflection");
    add("reflection", reflections_pass(reflections_library().value()), sum,
        {keep(views({sum})), options_.reflection});
  }
  if (has(kRigGlass)) {
    const rtapi::ShaderLibrary library = transparent_library().value();
    glass_ = picture("glass");
    transmittance_ = picture("transmittance");
    glass_pass_ = pass(transparent_pass(library));
    glass_arguments_ = {keep(views({glass_, transmittance_})), options_.glass};
    glass_compose_ = transparent_compose_pass(device_, *frame_, library).value();
  }
}

const rtapi::Texture* Rig::denoised(const std::string& name) const {
  for (const auto& step : steps_) {
    if (step->name == name) return &step->denoiser.result();
  }
  return nullptr;
}

void Rig::make_compose() {
  FrameParts parts;
  parts.sun_visibility = denoised("sun");
  parts.ambient = denoised("ao");
  if (direct_) parts.local_lights = has(kRigContact) ? &direct_->total() : &direct_->direct();
  parts.indirect = denoised("indirect");
  parts.reflection = denoised("reflection");
  compose_ = ComposePass::create(device_, *frame_, composite_library().value(), parts).value();
  rtapi::DescriptorHeapDesc heap;
  heap.NumDescriptors = static_cast<std::uint32_t>(std::max<std::size_t>(steps_.size(), 1));
  heap.Flags = rtapi::DescriptorHeapFlags::kShaderVisible;
  clear_heap_ = device_.CreateDescriptorHeap(heap).value();
  for (std::uint32_t i = 0; i < steps_.size(); ++i) {
    device_.CreateUnorderedAccessView(steps_[i]->sum, clear_heap_.GetCPUDescriptorHandle(i))
        .value();
  }
}

void Rig::clear(rtapi::CommandList& list) {
  const float zero[4] = {0, 0, 0, 0};
  list.SetDescriptorHeaps({clear_heap_});
  for (std::uint32_t i = 0; i < steps_.size(); ++i) {
    list.ClearUnorderedAccessViewFloat(clear_heap_.GetGPUDescriptorHandle(i),
                                       clear_heap_.GetCPUDescriptorHandle(i), steps_[i]->sum, zero);
  }
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
}

void Rig::dispatch(rtapi::CommandList& list, const RayPass& pass, PassConstants constants,
                   const PassArguments& arguments) const {
  const std::uint32_t rows = options_.rows > 0 ? options_.rows : options_.height;
  for (std::uint32_t row = 0; row < options_.height; row += rows) {
    constants.first_row = row;
    pass.dispatch(list, *frame_, constants, std::min(rows, options_.height - row), arguments);
  }
}

Pictures Rig::frame(const Scene& scene) {
  const Camera& camera = scene.cameras.front();
  frame_->set_camera(device_, scene, camera, {.index = frames_++, .previous_camera = camera})
      .value();
  rtapi::CommandList list = device_.CreateCommandList().value();
  clear(list);
  dispatch(list, gbuffer_, {}, {});
  lighting_->update(list, *frame_);
  if (direct_) direct_->dispatch(list, *frame_, has(kRigContact));
  PassConstants constants;
  constants.sample_count = options_.samples;
  constants.radius = options_.ao_radius;
  for (const auto& step : steps_) dispatch(list, step->pass, constants, step->arguments);
  for (const auto& step : steps_) {
    step->denoiser.load(list, *frame_, 1.0f / static_cast<float>(options_.samples));
    step->denoiser.dispatch(list, *frame_);
  }
  if (has(kRigContact)) direct_->add_strongest(list, *frame_);
  compose_->dispatch(list, *frame_);
  if (glass_pass_) {
    dispatch(list, *glass_pass_, {}, glass_arguments_);
    glass_compose_.dispatch(list, *frame_, {}, glass_arguments_, options_.width, options_.height);
  }
  queue_.ExecuteAndWait(list).value();
  return read();
}

Pictures Rig::read() {
  Pictures out;
  const auto take = [&](const std::string& name, const rtapi::Texture& texture) {
    out[name] = read_picture(device_, queue_, texture).value();
  };
  // Splits a picture into its colours and what its fourth channel holds.
  const auto split = [&](const std::string& name, const std::string& fourth) {
    FloatImage& from = out[name];
    FloatImage color(from.width, from.height, 3), rest(from.width, from.height, 1);
    for (std::size_t i = 0; i < rest.values.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) color.values[3 * i + c] = from.values[4 * i + c];
      rest.values[i] = from.values[4 * i + 3];
    }
    from = std::move(color);
    if (!fourth.empty()) out[fourth] = std::move(rest);
  };
  const struct {
    const char* name;
    FrameTexture texture;
  } shared[] = {{"ids", kIds},           {"view_z", kViewZ},  {"normal", kNormal},
                {"position", kPosition}, {"motion", kMotion}, {"radiance", kRadiance}};
  for (const auto& part : shared) take(part.name, frame_->texture(part.texture));
  for (const auto& step : steps_) {
    take(step->name, step->sum);
    for (float& value : out[step->name].values) value /= static_cast<float>(options_.samples);
    take(step->name + "_denoised", step->denoiser.result());
  }
  if (direct_) take("direct", direct_->direct());
  if (has(kRigContact)) take("local", direct_->total());
  if (glass_pass_) {
    take("glass", glass_);
    take("transmittance", transmittance_);
    split("glass", "glass_depth");
    split("transmittance", "glass_layers");
  }
  if (has(kRigIndirect)) split("indirect", "indirect_length");
  if (has(kRigReflections)) split("reflection", "reflection_length");
  for (const char* name :
       {"radiance", "direct", "local", "indirect_denoised", "reflection_denoised"}) {
    if (out.count(name) != 0) split(name, "");
  }
  return out;
}

}  // namespace

Pictures render(const Scene& scene, const RigOptions& options) {
  return Rig(scene, options).frame(scene);
}

std::vector<Pictures> render_frames(std::span<const Scene> scenes, const RigOptions& options) {
  Rig rig(scenes.front(), options);
  std::vector<Pictures> out;
  for (const Scene& scene : scenes) out.push_back(rig.frame(scene));
  return out;
}

IndirectVolume bake(const Scene& scene, const RigOptions& options) {
  return Rig(scene, options).volume();
}

}  // namespace kaamos::test
