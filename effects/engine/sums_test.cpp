// SPDX-License-Identifier: MIT
// PassConstants::accumulate, tested for every pass that sums samples: whether a pass adds to what
// the picture holds or begins anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/engine/picture.h"
#include "effects/engine/sums_fixture.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/direct/direct.h"
#include "effects/light/lights/lighting.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/sun_shadow/sun_shadow.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 36;

class Sums : public testing::Test {
 protected:
  Sums() {
    device_ = rtapi::CreateDevice().value();
    queue_ = device_.CreateCommandQueue().value();
    const Camera& camera = scene_.cameras.front();
    gpu_ = create_gpu_scene(device_, queue_, scene_, camera.position()).value();
    FrameDesc desc;
    desc.width = kWidth;
    desc.height = kHeight;
    frame_ = Frame::create(device_, scene_, gpu_, camera, desc).value();
    const auto lights = light_constants(scene_, camera.position());
    lighting_ = Lighting::create(device_, frame_, gpu_, lighting_library().value(),
                                 static_cast<std::uint32_t>(lights.size()))
                    .value();
    direct_ = DirectLighting::create(device_, frame_, lighting_, direct_library().value()).value();
    volume_ = GpuVolume::create(device_, {}, camera.position()).value();
    const RayPass gbuffer =
        RayPass::create(device_, frame_, gpu_, gbuffer_pass(gbuffer_library().value())).value();
    rtapi::CommandList list = device_.CreateCommandList().value();
    gbuffer.dispatch(list, frame_, {}, kHeight);
    lighting_.update(list, frame_);
    direct_.dispatch(list, frame_, true);
    queue_.ExecuteAndWait(list).value();
  }

  // Views with a picture of sums at `u` of space3.
  PassViews views_of(const rtapi::Texture& sum, std::uint32_t u) {
    PassViews views = frame_.create_pass_views(device_).value();
    views.set_unordered_access(u, sum).value();
    return views;
  }

  rtapi::Texture make_sum() {
    return frame_.create_picture(device_, "sum", rtapi::Format::kR32G32B32A32Float).value();
  }

  // Begins anew twice, then adds the same samples once more.
  void expect_sums(const RayPassDesc& desc, const rtapi::Texture& sum,
                   const PassArguments& arguments) {
    SCOPED_TRACE(desc.name);
    const RayPass pass = RayPass::create(device_, frame_, gpu_, desc).value();
    PassConstants constants;
    constants.sample_count = 3;
    constants.radius = 4;
    const auto dispatch = [&](std::uint32_t accumulate) {
      constants.accumulate = accumulate;
      rtapi::CommandList list = device_.CreateCommandList().value();
      pass.dispatch(list, frame_, constants, kHeight, arguments);
      queue_.ExecuteAndWait(list).value();
      return read_picture(device_, queue_, sum).value().values;
    };
    const std::vector<float> first = dispatch(0);
    EXPECT_GT(std::count_if(first.begin(), first.end(), [](float x) { return x != 0; }),
              kWidth * kHeight / 16);  // the sun reaches a sixth of the pixels
    EXPECT_EQ(dispatch(0), first);
    std::vector<float> twice = first;
    for (float& value : twice) value *= 2;
    EXPECT_EQ(dispatch(1), twice);
    // No pixel keeps its old value, not even those without a surface.
    EXPECT_EQ(dispatch(0), first);
  }

  Scene scene_ = make_lounge();
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  Lighting lighting_;
  DirectLighting direct_;
  GpuVolume volume_;
};

TEST_F(Sums, ThePictureHasPixelsWithoutASurface) {
  const FloatImage ids = frame_.read(device_, queue_, kIds).value();
  std::uint32_t sky = 0;
  for (std::size_t i = 0; i < ids.values.size(); i += 2) sky += ids.values[i] == 0 ? 1 : 0;
  EXPECT_GT(sky, 10u);
  EXPECT_LT(sky, kWidth * kHeight / 2);
}

TEST_F(Sums, OfVisibility) {
  const AmbientSums ambient(device_, frame_);
  expect_sums(ambient_occlusion_pass(ambient_occlusion_library().value()), ambient.open,
              ambient.arguments());
  const SunSums sun(device_, frame_);
  for (const rtapi::Texture& sum : {sun.visible, sun.sharpness}) {
    expect_sums(sun_shadow_pass(sun_shadow_library().value()), sum, sun.arguments());
  }
}

TEST_F(Sums, OfContactShadows) {
  const rtapi::Texture sum = make_sum();
  const rtapi::Texture sharpness = make_sum();
  PassViews views = views_of(sum, 1);
  views.set_unordered_access(0, direct_.strongest()).value();
  views.set_unordered_access(2, sharpness).value();
  expect_sums(contact_shadow_pass(contact_shadow_library().value()), sum,
              PassArguments(views, ContactShadowConstants{}));
  expect_sums(contact_shadow_pass(contact_shadow_library().value()), sharpness,
              PassArguments(views, ContactShadowConstants{}));
}

TEST_F(Sums, OfIndirectLight) {
  const rtapi::Texture sum = make_sum();
  PassViews views = views_of(sum, 0);
  lighting_.bind(views).value();
  volume_.bind(views).value();
  for (const IndirectMode mode : {IndirectMode::kDirect, IndirectMode::kNearField}) {
    IndirectConstants constants;
    constants.mode = mode;
    expect_sums(indirect_diffuse_pass(indirect_diffuse_library().value()), sum,
                PassArguments(views, constants));
  }
}

TEST_F(Sums, OfReflections) {
  const rtapi::Texture sum = make_sum();
  PassViews views = views_of(sum, 0);
  lighting_.bind(views).value();
  volume_.bind(views).value();
  expect_sums(reflections_pass(reflections_library().value()), sum,
              PassArguments(views, ReflectionConstants{}));
}

}  // namespace
}  // namespace kaamos::effects
