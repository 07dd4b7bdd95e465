// SPDX-License-Identifier: MIT
// Local lights: clusters lose no light, and shadow maps and contact shadows agree with the true
// shadows.
#include "effects/light/lights/lighting.h"

#include <gtest/gtest.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <span>

#include "effects/assets/built_in/light_forest.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/assets/scene/shapes.h"
#include "effects/engine/frame_fixture.h"
#include "effects/engine/picture.h"
#include "effects/light/direct/direct.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 32;

// A scene with its G-buffer and its local lights.
struct Stage : FrameStage {
  explicit Stage(Scene given) : FrameStage(std::move(given), kWidth, kHeight) {
    lights = light_constants(scene, scene.cameras.front().position());
    lighting = Lighting::create(device, frame, gpu, lighting_library().value(),
                                static_cast<std::uint32_t>(lights.size()))
                   .value();
    direct = DirectLighting::create(device, frame, lighting, direct_library().value()).value();
    const RayPass gbuffer = make_pass(gbuffer_pass(gbuffer_library().value()));
    run([&](rtapi::CommandList& list) {
      gbuffer.dispatch(list, frame, {}, kHeight);
      lighting.update(list, frame);
    });
  }

  FloatImage light(bool leave_out_strongest = false,
                   LightCulling culling = LightCulling::kClusters) {
    rtapi::CommandList list = device.CreateCommandList().value();
    direct.dispatch(list, frame, leave_out_strongest, culling);
    queue.ExecuteAndWait(list).value();
    return read_picture(device, queue, direct.direct()).value();
  }

  // Mean visibility of the strongest point light over the samples.
  FloatImage contact(const ContactShadowConstants& constants, std::uint32_t samples) {
    const rtapi::Texture picture =
        frame.create_picture(device, "contact", rtapi::Format::kR32G32B32A32Float).value();
    const rtapi::Texture sharpness =
        frame.create_picture(device, "sharpness", rtapi::Format::kR32G32B32A32Float).value();
    PassViews views = frame.create_pass_views(device).value();
    views.set_unordered_access(0, direct.strongest()).value();
    views.set_unordered_access(1, picture).value();
    views.set_unordered_access(2, sharpness).value();
    const RayPass pass =
        RayPass::create(device, frame, gpu, contact_shadow_pass(contact_shadow_library().value()))
            .value();
    PassConstants counts;
    counts.sample_count = samples;
    rtapi::CommandList list = device.CreateCommandList().value();
    direct.dispatch(list, frame, true);
    pass.dispatch(list, frame, counts, kHeight, PassArguments(views, constants));
    queue.ExecuteAndWait(list).value();
    FloatImage image = read_picture(device, queue, picture).value();
    for (float& value : image.values) value /= static_cast<float>(samples);
    return image;
  }

  std::vector<LightConstants> lights;
  Lighting lighting;
  DirectLighting direct;
};

Light point_light(const glm::dvec3& position, float range) {
  Light light;
  light.position = position;
  light.range = range;
  light.intensity = 5.0f;
  light.radius = 0.0f;
  return light;
}

Scene scene_of_many_lights(int count, double extent) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-extent, extent), height(0.2, 4.0);
  std::uniform_real_distribution<float> range(0.5f, 6.0f);
  for (int i = 0; i < count; ++i) {
    Light light = point_light({place(random), height(random), place(random)}, range(random));
    if (i % 3 == 0) {
      light.type = LightType::kSpot;
      light.direction = glm::normalize(glm::vec3(place(random), -extent, place(random)));
      light.outer_cone_angle = 0.1f + 1.45f * static_cast<float>(i) / static_cast<float>(count);
      light.inner_cone_angle = 0.5f * light.outer_cone_angle;
    }
    scene.lights.push_back(light);
  }
  return scene;
}

// The C++ twin of ClusterOf.
std::uint32_t cluster_of(const FrameConstants& frame, const glm::vec3& position) {
  const glm::vec3 axes[3] = {glm::normalize(frame.camera_right), glm::normalize(frame.camera_up),
                             frame.camera_forward};
  std::uint32_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const float x = glm::dot(position, axes[axis]);
    const float steps = 1 + std::abs(x) / 0.5f;
    const int doublings = static_cast<int>(std::floor(std::log2(steps)));
    const bool upper = steps >= 1.5f * std::exp2(static_cast<float>(doublings));
    const int cell =
        std::min(2 * doublings + (upper ? 1 : 0), static_cast<int>(kClusterCells) / 2 - 1);
    const int coordinate = static_cast<int>(kClusterCells) / 2 + (x < 0 ? -1 - cell : cell);
    index = index * kClusterCells + static_cast<std::uint32_t>(coordinate);
  }
  return index;
}

bool reaches(const LightConstants& light, const glm::vec3& p) {
  const glm::vec3 from_light = p - light.position;
  const float distance = glm::length(from_light);
  if (distance >= light.range) return false;
  return light.is_spot == 0 ||
         glm::dot(from_light, light.direction) * light.spot_scale + light.spot_offset * distance >
             0;
}

// The values that derive() adds are those that shaders would compute.
TEST(LightConstants, HoldWhatFollowsFromTheRest) {
  Scene scene;
  Light light = point_light({1, 2, 3}, 8);
  light.radius = 0.25f;
  scene.lights.push_back(light);
  light.type = LightType::kSpot;
  light.radius = 0;
  light.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
  light.outer_cone_angle = 0.6f;
  scene.lights.push_back(light);
  light.outer_cone_angle = 0;  // must light nothing and divide by nothing
  light.range = 1e-39f;
  scene.lights.push_back(light);
  const std::vector<LightConstants> lights = light_constants(scene, {0, 0, 0});
  EXPECT_FLOAT_EQ(lights[0].over_range, 1 / 8.0f);
  EXPECT_FLOAT_EQ(lights[0].over_least_distance, 4);
  // If all texels had the same area; true on average.
  EXPECT_NEAR(lights[0].map_texel * lights[0].map_texel * kShadowTile * kShadowTile, 12.56637,
              1e-4);
  EXPECT_FLOAT_EQ(lights[1].over_least_distance, 1 / 8e-7f);
  const float tangent = std::tan(0.6f);
  EXPECT_NEAR(lights[1].map_texel * kShadowTile, 2 * tangent, 1e-6);
  EXPECT_NEAR(glm::length(lights[1].map_right), 1 / tangent, 1e-6);
  EXPECT_NEAR(glm::length(lights[1].map_up), 1 / tangent, 1e-6);
  EXPECT_NEAR(glm::dot(lights[1].map_right, lights[1].map_up), 0, 1e-6);
  EXPECT_NEAR(glm::dot(lights[1].map_right, lights[1].direction), 0, 1e-6);
  for (const float derived : {lights[2].over_range, lights[2].over_least_distance,
                              lights[2].map_right.x, lights[2].map_up.y, lights[2].map_texel}) {
    EXPECT_TRUE(std::isfinite(derived)) << derived;
  }
  EXPECT_GT(lights[2].map_texel, 0);
}

// For points anywhere around the camera, also behind it: every light that reaches the point by its
// range and cone is in its cluster's list.
TEST(Clusters, NoLightIsLost) {
  Stage stage(scene_of_many_lights(100, 30));
  std::vector<std::byte> bytes =
      rtapi::ReadbackBuffer(stage.device, stage.queue, stage.lighting.cluster_counts()).value();
  std::vector<std::uint32_t> counts(kClusterCount);
  std::memcpy(counts.data(), bytes.data(), bytes.size());
  bytes = rtapi::ReadbackBuffer(stage.device, stage.queue, stage.lighting.cluster_lights()).value();
  std::vector<std::uint32_t> indices(kClusterCount * kClusterCapacity);
  std::memcpy(indices.data(), bytes.data(), bytes.size());
  FrameDesc desc;
  desc.width = kWidth;
  desc.height = kHeight;
  const Camera& camera = stage.scene.cameras.front();
  const FrameConstants constants =
      frame_constants(stage.scene, camera, desc, {.previous_camera = camera});
  std::uint64_t in_range = 0, listed = 0;
  const auto expect_listed = [&](const glm::vec3& p) {
    const std::uint32_t cluster = cluster_of(constants, p);
    ASSERT_LE(counts[cluster], kClusterCapacity);
    const auto begin = indices.begin() + cluster * kClusterCapacity;
    listed += counts[cluster];
    for (std::uint32_t light = 0; light < stage.lights.size(); ++light) {
      if (!reaches(stage.lights[light], p)) continue;
      ++in_range;
      ASSERT_TRUE(std::binary_search(begin, begin + counts[cluster], light))
          << "light " << light << " at " << p.x << "," << p.y << "," << p.z;
    }
  };
  std::mt19937 random(23);
  std::uniform_real_distribution<float> place(-40, 40);
  for (int i = 0; i < 20'000; ++i) expect_listed({place(random), place(random), place(random)});
  EXPECT_GT(in_range, 500u);
  EXPECT_LT(listed, 20'000u * 100 / 4);  // most lights are left out
  // Points on the rims of the spots' caps, where their reach ends.
  for (const LightConstants& light : stage.lights) {
    if (light.is_spot == 0) continue;
    const glm::vec3 x = glm::normalize(glm::cross(light.direction, glm::vec3(0.3f, 0.2f, 0.9f)));
    const glm::vec3 y = glm::cross(light.direction, x);
    const float angle = 0.9999f * std::acos(light.cos_outer);
    for (int i = 0; i < 200; ++i) {
      const float turn = 0.0314159f * static_cast<float>(i);
      const glm::vec3 across = x * std::cos(turn) + y * std::sin(turn);
      expect_listed(light.position +
                    0.9999f * light.range *
                        (light.direction * std::cos(angle) + across * std::sin(angle)));
    }
  }
}

// The same bits as a loop over all lights, which is what overflowing clusters do.
TEST(Clusters, GiveTheSumOverAllLights) {
  Stage stage(scene_of_many_lights(100, 8));
  const FloatImage clustered = stage.light();
  const rtapi::Buffer overflow =
      rtapi::CreateUploadBuffer(stage.device,
                                std::vector<std::uint32_t>(kClusterCount, kClusterOverflow))
          .value();
  rtapi::CommandList list = stage.device.CreateCommandList().value();
  const rtapi::Buffer& counts = stage.lighting.cluster_counts();
  list.ResourceBarrier(rtapi::ResourceBarrier::Transition(
      counts, rtapi::ResourceStates::kUnorderedAccess, rtapi::ResourceStates::kCopyDest));
  list.CopyBufferRegion(counts, 0, overflow, 0, kClusterCount * 4);
  list.ResourceBarrier(rtapi::ResourceBarrier::Transition(counts, rtapi::ResourceStates::kCopyDest,
                                                          rtapi::ResourceStates::kUnorderedAccess));
  stage.queue.ExecuteAndWait(list).value();
  const FloatImage all = stage.light();
  double brightest = 0;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    ASSERT_EQ(clustered.values[i], all.values[i]) << i;
    brightest = std::max(brightest, static_cast<double>(all.values[i]));
  }
  EXPECT_GT(brightest, 0.1);
}

TEST(Clusters, ThatOverflowLoseNothing) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  for (int i = 0; i < 200; ++i) scene.lights.push_back(point_light({0.01 * i, 3, 0}, 8));
  Stage stage(scene);
  Scene one = make_sphere_oracle(1.0, 1.5);
  one.lights.push_back(point_light({1, 3, 0}, 8));
  one.lights.back().intensity *= 200;
  Stage together(one);
  const FloatImage many = stage.light(), single = together.light();
  double sum = 0, expected = 0;
  for (std::size_t i = 0; i < many.values.size(); i += 4) {
    sum += many.values[i];
    expected += single.values[i];
  }
  EXPECT_NEAR(sum / expected, 1, 0.05);  // the lamps are spread over two metres
}

// The same bits as with clusters, and the same strongest lights, though most lights are never
// looked at: those whose reach lies beside or behind the camera's frustum. [survey 5.3.1]
TEST(FrustumCulling, LosesNoLightOfThePicture) {
  for (const bool leave_out_strongest : {false, true}) {
    Stage stage(make_light_forest({.lights = 300}));
    const FloatImage clustered = stage.light(leave_out_strongest);
    const FloatImage strongest =
        read_picture(stage.device, stage.queue, stage.direct.strongest()).value();
    const FloatImage culled = stage.light(leave_out_strongest, LightCulling::kFrustum);
    EXPECT_EQ(clustered.values, culled.values);
    EXPECT_EQ(strongest.values,
              read_picture(stage.device, stage.queue, stage.direct.strongest()).value().values);
    EXPECT_GT(*std::max_element(culled.values.begin(), culled.values.end()), 0.1f);
    const std::vector<std::byte> bytes =
        rtapi::ReadbackBuffer(stage.device, stage.queue, stage.direct.lights_in_view()).value();
    std::vector<std::uint32_t> in_view(bytes.size() / 4);
    std::memcpy(in_view.data(), bytes.data(), bytes.size());
    const std::uint32_t count = in_view[0];
    EXPECT_GT(count, 50u);
    EXPECT_LT(count, 280u);
    EXPECT_TRUE(std::is_sorted(in_view.begin() + 1, in_view.begin() + 1 + count));
  }
}

// Lights straight ahead and straight behind.
TEST(FrustumCulling, LeavesOutWhatIsBehind) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  const Camera& camera = scene.cameras.front();
  const glm::dvec3 eye = camera.position(), ahead = camera.forward();
  const glm::dvec3 side(camera.camera_to_world[0]);
  scene.lights = {point_light(eye + 5.0 * ahead, 1), point_light(eye - 5.0 * ahead, 4.9f),
                  point_light(eye - 5.0 * ahead, 5.2f), point_light(eye + 5.0 * side, 2),
                  point_light(eye + 2.0 * ahead + 40.0 * side, 1)};
  Stage stage(scene);
  stage.light(false, LightCulling::kFrustum);
  const std::vector<std::byte> bytes =
      rtapi::ReadbackBuffer(stage.device, stage.queue, stage.direct.lights_in_view()).value();
  std::uint32_t in_view[3];
  std::memcpy(in_view, bytes.data(), sizeof(in_view));
  EXPECT_EQ(in_view[0], 2u);
  EXPECT_EQ(in_view[1], 0u);
  EXPECT_EQ(in_view[2], 2u);
}

// A lamp over a sphere over a plane: the shadow on the plane is a disk of known radius.
Scene lamp_over_sphere() {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.lights.push_back(point_light({0, 5, 0}, 50));
  return scene;
}

// Radius of the shadow on the plane: the tangent of the cone that touches the sphere, times the
// height of the lamp.
double shadow_radius() {
  const double distance = 5 - 1.5;
  return 5 * 1.0 / std::sqrt(distance * distance - 1.0);
}

TEST(ShadowMaps, DarkenTheDiskUnderTheSphere) {
  Stage stage(lamp_over_sphere());
  const FloatImage image = stage.light();
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const FloatImage ids = stage.frame.read(stage.device, stage.queue, kIds).value();
  const glm::dvec3 eye = stage.scene.cameras.front().position();
  int dark = 0, lit = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (ids.at(x, y, 0) == 0) continue;
      const glm::dvec3 p =
          eye + glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
      if (std::abs(p.y) > 1e-3) continue;  // the sphere itself
      const double r = std::hypot(p.x, p.z);
      // A texel of the map is 0.2 m wide at that distance.
      if (r < shadow_radius() - 0.5) {
        EXPECT_EQ(image.at(x, y), 0) << r;
        ++dark;
      } else if (r > shadow_radius() + 0.5 && r < 8) {
        EXPECT_GT(image.at(x, y), 0) << r;
        ++lit;
      }
    }
  }
  EXPECT_GT(dark, 5);
  EXPECT_GT(lit, 50);
}

// An empty room has no shadows: neither at the edges of its walls, where texels of two walls meet,
// nor in far corners, which the lamp sees at a slant. The lamp is close to two walls.
TEST(ShadowMaps, LeaveNoShadowsInTheCornersOfARoom) {
  constexpr float kAlbedo = 0.8f;
  for (const bool spot : {false, true}) {
    Scene scene = make_sphere_oracle(1.0, 1.5);
    scene.meshes.clear();
    scene.instances.resize(1);
    scene.sun.reset();
    scene.materials.resize(1);
    scene.materials[0].constants = {};
    scene.materials[0].constants.base_color = glm::vec4(glm::vec3(kAlbedo), 1);
    scene.materials[0].constants.roughness = 1;
    scene.materials[0].constants.metallic = 0;
    Shape walls = box({2, 1.5, 6});
    for (std::size_t i = 0; i < walls.indices.size(); i += 3) {  // seen from inside
      std::swap(walls.indices[i + 1], walls.indices[i + 2]);
    }
    for (Vertex& vertex : walls.vertices) vertex.normal = -vertex.normal;
    Mesh mesh;
    add_shape(mesh, walls, 0);
    scene.meshes.push_back(mesh);
    scene.instances[0] = {};
    Light lamp = point_light({1.6, 1.1, 4}, 1e3f);
    if (spot) {
      lamp.type = LightType::kSpot;
      lamp.direction = glm::normalize(glm::vec3(-1.6f, -1.1f, -8));
      lamp.outer_cone_angle = 1.0f;
      lamp.inner_cone_angle = 0.9f;
    }
    scene.lights.push_back(lamp);
    scene.cameras.front().camera_to_world = look_at({0, 0.2, 5.5}, {0, 0, -6});
    scene.cameras.front().vertical_fov = 1.2;
    Stage stage(scene);
    const FloatImage image = stage.light();
    const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
    const glm::dvec3 eye = scene.cameras.front().position();
    int count = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const glm::dvec3 p =
            eye + glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
        const glm::dvec3 to_lamp = lamp.position - p;
        // The wall is the one that the point is closest to.
        const glm::dvec3 beyond = glm::abs(p) / glm::dvec3(2, 1.5, 6);
        const int axis = beyond.x > beyond.y && beyond.x > beyond.z ? 0
                         : beyond.y > beyond.z                      ? 1
                                                                    : 2;
        const double cosine = std::abs(to_lamp[axis]) / glm::length(to_lamp);
        if (spot && glm::dot(-to_lamp, glm::dvec3(lamp.direction)) <
                        std::cos(0.85) * glm::length(to_lamp)) {
          continue;
        }
        // A rough surface reflects a little more than a diffuse one, never less.
        const double diffuse =
            kAlbedo / 3.14159265 * lamp.intensity * cosine / glm::dot(to_lamp, to_lamp);
        EXPECT_GT(image.at(x, y, 0), 0.9 * diffuse)
            << (spot ? "spot" : "point") << " " << p.x << "," << p.y << "," << p.z;
        ++count;
      }
    }
    EXPECT_GT(count, 500);
  }
}

TEST(ContactShadows, OfNoLengthAreNone) {
  Stage stage(lamp_over_sphere());
  const FloatImage image = stage.contact({0.0f}, 4);
  const FloatImage ids = stage.frame.read(stage.device, stage.queue, kIds).value();
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (ids.at(x, y, 0) != 1.0f) continue;  // the plane
      ASSERT_EQ(image.at(x, y, 0), 1.0f);
    }
  }
}

// With rays that reach the lamp, contact shadows are the exact hard shadow of a lamp without size.
TEST(ContactShadows, AtFullLengthAreTheShadow) {
  Stage stage(lamp_over_sphere());
  const FloatImage image = stage.contact({1e3f}, 1);
  const FloatImage ids = stage.frame.read(stage.device, stage.queue, kIds).value();
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const glm::dvec3 eye = stage.scene.cameras.front().position();
  int wrong = 0, dark = 0, count = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (ids.at(x, y, 0) != 1.0f) continue;
      const double r = std::hypot(eye.x + position.at(x, y, 0), eye.z + position.at(x, y, 2));
      if (std::abs(r - shadow_radius()) < 0.02) continue;  // the sphere consists of triangles
      ++count;
      const bool expected_dark = r < shadow_radius();
      dark += expected_dark;
      wrong += (image.at(x, y, 0) == 0.0f) != expected_dark;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(dark, 5);
  EXPECT_GT(count, 200);
}

// A lamp of 0.5 m radius: behind the edge of the sphere, its visible fraction falls from 1 to 0.
TEST(ContactShadows, AreSoftByTheLightsRadius) {
  Scene scene = lamp_over_sphere();
  scene.lights.front().radius = 0.5f;
  Stage stage(scene);
  const FloatImage image = stage.contact({1e3f}, 64);
  int partial = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    partial += image.values[i] > 0.05f && image.values[i] < 0.95f;
  }
  EXPECT_GT(partial, 20);
}

// Where penumbras are wider than a texel of the map, the map can show them: rays end before. A lamp
// without size has none.
TEST(ContactShadows, EndWhereTheMapIsFineEnough) {
  Scene scene = lamp_over_sphere();
  const auto render = [&](float radius, std::uint32_t only_where_coarse) {
    scene.lights.front().radius = radius;
    Stage stage(scene);
    return stage.contact({1e3f, only_where_coarse}, 16);
  };
  const auto same_pixels = [](const FloatImage& a, const FloatImage& b) {
    int same = 0, brighter = 0;
    for (std::size_t i = 0; i < a.values.size(); i += 4) {
      same += a.values[i] == b.values[i];
      brighter += a.values[i] > b.values[i];
    }
    return std::pair(same, brighter);
  };
  const auto all = static_cast<int>(kWidth * kHeight);
  EXPECT_EQ(same_pixels(render(0.0f, 1), render(0.0f, 0)), std::pair(all, 0));
  const auto [same, brighter] = same_pixels(render(0.5f, 1), render(0.5f, 0));
  EXPECT_EQ(same + brighter, all) << "a shorter ray meets nothing else";
  EXPECT_GT(brighter, 10);
}

// With a contact shadow that sees what the map sees, the product squares every penumbra; the
// minimum leaves it as it is, and is exact where only one of the two sees a shadow.
TEST(ContactShadows, ByMinimumCountNoPenumbraTwice) {
  Stage stage(lamp_over_sphere());
  const FloatImage all = stage.light();
  stage.light(true);
  const rtapi::Texture contact =
      stage.frame.create_picture(stage.device, "contact", rtapi::Format::kR32G32B32A32Float)
          .value();
  stage.direct.set_contact(contact).value();
  const auto total = [&](float visible, ContactCombination combination) {
    const FloatImage image(kWidth, kHeight, 4, visible);
    rtapi::UploadTexture(stage.device, stage.queue, contact, 0,
                         std::as_bytes(std::span(image.values)))
        .value();
    rtapi::CommandList list = stage.device.CreateCommandList().value();
    stage.direct.add_strongest(list, stage.frame, combination);
    stage.queue.ExecuteAndWait(list).value();
    return read_picture(stage.device, stage.queue, stage.direct.total()).value();
  };
  const FloatImage open = total(1, ContactCombination::kMinimum);
  const FloatImage product = total(0.5f, ContactCombination::kProduct);
  const FloatImage minimum = total(0.5f, ContactCombination::kMinimum);
  // Alone it lights what the map hides, too.
  const FloatImage alone = total(0.5f, ContactCombination::kAlone);
  int lit = 0, penumbra = 0, hidden = 0;
  for (std::size_t i = 0; i < all.values.size(); i += 4) {
    ASSERT_NEAR(open.values[i], all.values[i], 1e-6 * all.values[i]);
    ASSERT_NEAR(product.values[i], 0.5f * all.values[i], 1e-6 * all.values[i]);
    ASSERT_LE(minimum.values[i], all.values[i] * 1.000001f);
    ASSERT_GE(minimum.values[i], product.values[i] * 0.999999f);
    ASSERT_GE(alone.values[i], product.values[i] * 0.999999f);
    hidden += alone.values[i] > 0 && product.values[i] == 0;
    lit += product.values[i] > 0 && minimum.values[i] == product.values[i];
    penumbra += minimum.values[i] > 1.01f * product.values[i];
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(penumbra, 5);
  EXPECT_GT(hidden, 5);
}

TEST(ContactShadows, StrongestLightsAreNamedByKind) {
  Scene scene = lamp_over_sphere();
  Light spot = point_light({2, 4, 0}, 50);
  spot.type = LightType::kSpot;
  spot.outer_cone_angle = 1.2f;
  scene.lights.push_back(spot);
  Stage stage(scene);
  stage.light(true);
  const FloatImage strongest =
      read_picture(stage.device, stage.queue, stage.direct.strongest()).value();
  int both = 0;
  for (std::size_t i = 0; i < strongest.values.size(); i += 2) {
    both += strongest.values[i] == 0.0f && strongest.values[i + 1] == 1.0f;
    ASSERT_TRUE(strongest.values[i] == 0.0f || strongest.values[i] == 0xFFFFFF);
    ASSERT_TRUE(strongest.values[i + 1] == 1.0f || strongest.values[i + 1] == 0xFFFFFF);
  }
  EXPECT_GT(both, 100);
}

}  // namespace
}  // namespace kaamos::effects
