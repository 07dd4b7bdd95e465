// SPDX-License-Identifier: MIT
// A walking figure: its vertices against the host's, updated structures against new ones, and
// motion vectors against the host's projection. What did not move costs nothing.
#include "effects/geometry/structures/structures.h"

#include <gtest/gtest.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "effects/assets/built_in/destruction.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/runner.h"
#include "effects/engine/frame.h"
#include "effects/engine/ray_pass.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kEachFrame = 1, kNever = 0;

// A moving scene and its G-buffer.
struct Stage {
  Stage(const std::string& backend, Scene given, const StructureOptions& options = {},
        std::uint32_t width = 96, std::uint32_t height = 64)
      : scene(std::move(given)), camera(scene.cameras.front()), previous_camera(camera) {
    rtapi::DeviceDesc device_desc;
    device_desc.Backend = backend;
    device = test::device_for(device_desc);
    queue = device.CreateCommandQueue().value();
    manager = StructureManager::create(device, queue, scene, options).value();
    desc.width = width;
    desc.height = height;
    frame = Frame::create(device, scene, manager.scene(), camera, desc).value();
    gbuffer =
        RayPass::create(device, frame, manager.scene(), gbuffer_pass(gbuffer_library().value()))
            .value();
  }

  // Renders the next frame, all in one list as a renderer does.
  void go(double seconds, bool rays = true) {
    previous_states = states;
    states = evaluate_instances(scene, seconds);
    rtapi::CommandList list = device.CreateCommandList().value();
    manager.record(list, states, camera.position()).value();
    FrameTime time;
    time.index = manager.statistics().frame;
    time.previous_camera = previous_camera;
    frame.set_camera(device, scene, camera, time).value();
    if (rays) gbuffer.dispatch(list, frame, {}, desc.height);
    queue.ExecuteAndWait(list).value();
    previous_camera = camera;
  }
  FloatImage read(FrameTexture texture) { return frame.read(device, queue, texture).value(); }

  Scene scene;
  Camera camera, previous_camera;
  rtapi::Device device;
  rtapi::CommandQueue queue;
  StructureManager manager;
  FrameDesc desc;
  Frame frame;
  RayPass gbuffer;
  std::vector<InstanceState> states, previous_states;
};

struct DeformedVertex {
  Vertex vertex;
  glm::vec3 previous_position;
  float unused;
};
static_assert(sizeof(DeformedVertex) == kSkinnedVertexStride);

std::vector<DeformedVertex> deformed(Stage& stage, std::uint32_t instance) {
  const std::vector<std::byte> bytes =
      rtapi::ReadbackBuffer(stage.device, stage.queue, stage.manager.skinned_vertices(instance))
          .value();
  std::vector<DeformedVertex> out(bytes.size() / sizeof(DeformedVertex));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(DeformedVertex));
  return out;
}

class Structures : public test::OnBackends {};

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, Structures, testing::Values("embree", "vulkan"), backend_name);

double distance(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(glm::dvec3(a) - glm::dvec3(b));
}

TEST_P(Structures, VerticesAreThoseOfTheHost) {
  Stage stage(GetParam(), make_runner_scene({.crowd = 2, .crowd_poses = 2}));
  stage.go(0.11, false);
  stage.go(0.37, false);
  const Mesh& mesh = stage.scene.meshes[1];
  for (std::uint32_t instance = 1; instance <= 3; ++instance) {
    const std::vector<DeformedVertex> found = deformed(stage, instance);
    const std::vector<Vertex> now = skin_vertices(mesh, stage.states[instance].joints);
    const std::vector<Vertex> before = skin_vertices(mesh, stage.previous_states[instance].joints);
    ASSERT_EQ(found.size(), now.size());
    double position = 0, previous = 0, normal = 0, tangent = 0, moved = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      position = std::max(position, distance(found[i].vertex.position, now[i].position));
      previous = std::max(previous, distance(found[i].previous_position, before[i].position));
      normal = std::max(normal, distance(found[i].vertex.normal, now[i].normal));
      tangent = std::max(tangent,
                         distance(glm::vec3(found[i].vertex.tangent), glm::vec3(now[i].tangent)));
      moved = std::max(moved, distance(now[i].position, before[i].position));
      ASSERT_EQ(found[i].vertex.uv, now[i].uv);
      ASSERT_EQ(found[i].vertex.tangent.w, now[i].tangent.w);
    }
    EXPECT_LT(position, 2e-6);
    EXPECT_LT(previous, 2e-6);
    EXPECT_LT(normal, 1e-5);
    EXPECT_LT(tangent, 1e-5);
    EXPECT_GT(moved, 0.02);
  }
}

// Colours are behind what else a deformed vertex has, and hits read them there.
TEST_P(Structures, DeformedVerticesKeepTheirColors) {
  Scene scene = make_runner_scene({.crowd = 0});
  const VertexColor color{65535, 16384, 0, 65535};
  for (Mesh& mesh : scene.meshes) mesh.colors.assign(mesh.vertices.size(), color);
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(1);
    material.constants.image[kBaseColorTexture] = kNoTexture;
  }
  Stage stage(GetParam(), scene);
  stage.go(0.11);
  struct Colored {
    DeformedVertex vertex;
    VertexColor color;
    std::uint32_t unused[2];
  };
  static_assert(sizeof(Colored) == kColoredSkinnedVertexStride);
  const std::vector<std::byte> bytes =
      rtapi::ReadbackBuffer(stage.device, stage.queue, stage.manager.skinned_vertices(1)).value();
  std::vector<Colored> found(bytes.size() / sizeof(Colored));
  std::memcpy(found.data(), bytes.data(), found.size() * sizeof(Colored));
  const std::vector<Vertex> now =
      skin_vertices(scene.meshes[scene.instances[1].mesh], stage.states[1].joints);
  ASSERT_EQ(found.size(), now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    ASSERT_LT(distance(found[i].vertex.vertex.position, now[i].position), 2e-6) << i;
    ASSERT_EQ(found[i].color, color) << i;
  }
  const FloatImage seen = stage.read(kBaseColor);
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    for (std::uint32_t x = 0; x < seen.width; ++x) {
      if (seen.at(x, y, 3) == 0) continue;  // the sky
      ++count;
      ASSERT_NEAR(seen.at(x, y, 0), 1.0f, 1e-3f);
      ASSERT_NEAR(seen.at(x, y, 1), 0.5f, 0.5001f / 255);
      ASSERT_EQ(seen.at(x, y, 2), 0.0f);
    }
  }
  EXPECT_GT(count, 1000u);
}

// A walking figure whose vertices two targets move besides, and a square that only morphs.
Scene morphing_scene() {
  Scene scene = make_runner_scene({.crowd = 0});
  Mesh& figure = scene.meshes[scene.instances[1].mesh];
  Mesh square;
  square.name = "square";
  std::vector<Vertex> corners(4);
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i].position = glm::vec3(i % 2 == 0 ? -0.5f : 0.5f, i < 2 ? 0 : 1, 0);
    corners[i].normal = glm::vec3(0, 0, 1);
    corners[i].tangent = glm::vec4(1, 0, 0, 1);
  }
  square.add_geometry(corners, std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}, 0, false);
  const auto add_targets = [](Mesh& mesh) {
    mesh.morph_targets = 2;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const auto part = static_cast<float>(i % 7) / 7;
      mesh.morph.push_back({{0, 0.2f * part, 0}, {0.5f * part, 0, 0}, {}});
      mesh.morph.push_back({{0.1f, 0, 0.3f * part}, {0, part, 0}, {0, 0.5f, part}});
    }
  };
  add_targets(figure);
  add_targets(square);
  Node face;
  face.name = "face";
  face.weights = {0.0f, 0.25f};
  const auto node = static_cast<std::int32_t>(scene.nodes.size());
  scene.nodes.push_back(face);
  Channel channel;
  channel.node = static_cast<std::uint32_t>(node);
  channel.path = ChannelPath::kWeights;
  channel.times = {0, 1};
  channel.weights = {0, 0.25f, 1, -0.5f};
  scene.animations.at(0).channels.push_back(channel);
  scene.animations.at(0).duration = std::max(scene.animations.at(0).duration, 1.0);
  scene.instances[1].motion.morph = node;
  Instance instance;
  instance.name = "square";
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.transform[3] = glm::dvec4(0.5, 0.5, 1.5, 1);
  instance.motion.animation = 0;
  instance.motion.morph = node;
  scene.meshes.push_back(square);
  scene.instances.push_back(instance);
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  return scene;
}

TEST_P(Structures, MorphTargetsMoveWhatTheHostMoves) {
  Stage stage(GetParam(), morphing_scene());
  stage.go(0.11, false);
  stage.go(0.37, false);
  for (const std::size_t instance : {std::size_t{1}, stage.scene.instances.size() - 1}) {
    const Mesh& mesh = stage.scene.meshes[stage.scene.instances[instance].mesh];
    const std::vector<DeformedVertex> found = deformed(stage, static_cast<std::uint32_t>(instance));
    const std::vector<Vertex> now = deform_vertices(mesh, stage.states[instance]);
    const std::vector<Vertex> before = deform_vertices(mesh, stage.previous_states[instance]);
    ASSERT_EQ(found.size(), now.size());
    double moved = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      ASSERT_LT(distance(found[i].vertex.position, now[i].position), 2e-6) << instance << " " << i;
      ASSERT_LT(distance(found[i].previous_position, before[i].position), 2e-6) << i;
      ASSERT_LT(distance(found[i].vertex.normal, now[i].normal), 1e-5) << i;
      ASSERT_LT(distance(glm::vec3(found[i].vertex.tangent), glm::vec3(now[i].tangent)), 1e-5);
      moved = std::max(moved, distance(now[i].position, before[i].position));
    }
    EXPECT_GT(moved, 0.02);
  }
}

// The motion of the square's pixels leads to where the weights of the frame before put their
// points.
TEST_P(Structures, MotionFollowsMorphTargets) {
  Scene scene = morphing_scene();
  scene.cameras.front().camera_to_world = look_at({0.5, 1, 4}, {0.5, 1, 1.5});
  scene.cameras.front().half_height = 1;
  Stage stage(GetParam(), scene);
  stage.go(0.2);
  stage.go(0.3);
  const auto last = static_cast<std::uint32_t>(scene.instances.size()) - 1;
  const FloatImage ids = stage.read(kIds), motion = stage.read(kMotion),
                   position = stage.read(kPosition);
  const Mesh& mesh = scene.meshes[scene.instances[last].mesh];
  const std::vector<Vertex> now = deform_vertices(mesh, stage.states[last]);
  const std::vector<Vertex> before = deform_vertices(mesh, stage.previous_states[last]);
  int count = 0;
  for (std::uint32_t y = 0; y < ids.height; ++y) {
    for (std::uint32_t x = 0; x < ids.width; ++x) {
      std::uint32_t id[2];
      const float raw[2] = {ids.at(x, y, 0), ids.at(x, y, 1)};
      id[0] = static_cast<std::uint32_t>(raw[0]);
      id[1] = static_cast<std::uint32_t>(raw[1]);
      if (id[0] != last + 1) continue;
      const Geometry& geometry = mesh.geometries[0];
      glm::dvec3 a[3], b[3];
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.index(geometry, 3 * id[1] + c);
        a[c] = glm::dvec3(now[vertex].position);
        b[c] = glm::dvec3(before[vertex].position);
      }
      // The camera is level and looks along -z, so that its picture shows x and y as they are.
      const glm::dvec2 p(position.at(x, y, 0) + 0.5 - scene.instances[last].transform[3].x,
                         position.at(x, y, 1) + 1 - scene.instances[last].transform[3].y);
      const glm::dmat2 edges(glm::dvec2(a[1] - a[0]), glm::dvec2(a[2] - a[0]));
      const glm::dvec2 w = glm::inverse(edges) * (p - glm::dvec2(a[0]));
      const glm::dvec3 from = b[0] + w.x * (b[1] - b[0]) + w.y * (b[2] - b[0]);
      const double aspect = static_cast<double>(ids.width) / ids.height;
      ASSERT_NEAR(motion.at(x, y, 0), (from.x - p.x) / (2 * aspect), 1e-5);
      ASSERT_NEAR(motion.at(x, y, 1), -(from.y - p.y) / 2, 1e-5);
      ++count;
    }
  }
  EXPECT_GT(count, 100);
}

// The first frames of the walk, once by updates alone and once rebuilt in each frame: the triangles
// are the same, so the hits must be. 10^5 rays.
TEST_P(Structures, UpdatedStructuresGiveTheHitsOfNewOnes) {
  const bool vulkan = GetParam() == "vulkan";
  StructureOptions updated, rebuilt;
  updated.deformable_period = updated.hero_period = kNever;
  rebuilt.deformable_period = rebuilt.hero_period = kEachFrame;
  const std::uint32_t width = vulkan ? 100 : 400, height = vulkan ? 64 : 256;
  const Scene scene = make_runner_scene({.crowd = 8, .crowd_poses = 4});
  Stage a(GetParam(), scene, updated, width, height), b(GetParam(), scene, rebuilt, width, height);
  const int frames = 7;
  for (int i = 0; i < frames; ++i) {
    const double seconds = 0.9 + 0.15 * i;
    a.go(seconds, i == frames - 1);
    b.go(seconds, i == frames - 1);
    EXPECT_EQ(a.manager.statistics().rebuilt, i == 0 ? 5u : 0u);
    EXPECT_EQ(a.manager.statistics().updated, i == 0 ? 0u : 5u);
    EXPECT_EQ(b.manager.statistics().rebuilt, 5u);
    EXPECT_EQ(b.manager.statistics().updated, 0u);
  }
  const FloatImage za = a.read(kViewZ), zb = b.read(kViewZ);
  const FloatImage ia = a.read(kIds), ib = b.read(kIds);
  std::size_t figures = 0, other_instance = 0, other_triangle = 0;
  for (std::size_t i = 0; i < za.values.size(); ++i) {
    const std::size_t id = i * static_cast<std::size_t>(ia.channels);
    figures += ia.values[id] > 1 ? 1 : 0;
    other_instance += ia.values[id] != ib.values[id] ? 1 : 0;
    other_triangle += ia.values[id + 1] != ib.values[id + 1] ? 1 : 0;
    // Two units in the last place.
    ASSERT_NEAR(za.values[i], zb.values[i], 2 * 1.2e-7 * std::abs(zb.values[i])) << "pixel " << i;
  }
  EXPECT_GT(figures, za.values.size() / 20);
  EXPECT_EQ(other_instance, 0u);
  // On an edge shared by two triangles, either may be hit first.
  EXPECT_LE(other_triangle, za.values.size() / 10000);
}

// Class 4: debris and cloth are built anew in each frame after the burst, and rays hit what they
// hit in structures of the same pose that nothing was built before. [Northlight deck: Bottom Level
// Build Flags]
TEST_P(Structures, DebrisAndClothAreBuiltAnewEachFrame) {
  const Scene scene = make_destruction();
  Stage stage(GetParam(), scene);
  const StructureStatistics& s = stage.manager.statistics();
  for (const double seconds : {0.1, 0.2, 0.9, 1.2}) {
    stage.go(seconds, seconds > 1.0);
    const bool still = seconds == 0.2;
    EXPECT_EQ(s.rebuilt, still ? 0u : 2u) << seconds;
    EXPECT_EQ(s.skipped, still ? 2u : 0u) << seconds;
    EXPECT_EQ(s.updated, 0u);
  }
  Stage fresh(GetParam(), posed_scene(scene, 1.2));
  fresh.go(0.0);
  const FloatImage za = stage.read(kViewZ), zb = fresh.read(kViewZ);
  const FloatImage ia = stage.read(kIds), ib = fresh.read(kIds);
  std::size_t debris = 0, cloth = 0, other_instance = 0;
  for (std::size_t i = 0; i < za.values.size(); ++i) {
    debris += ia.values[2 * i] == 2;
    cloth += ia.values[2 * i] == 3;
    other_instance += ia.values[2 * i] != ib.values[2 * i];
    // The device skins in single precision, the host in double.
    EXPECT_NEAR(za.values[i], zb.values[i], 1e-3f * zb.values[i]) << "pixel " << i;
  }
  EXPECT_GT(debris, za.values.size() / 20);
  EXPECT_GT(cloth, za.values.size() / 50);
  // On the outline of a piece.
  EXPECT_LE(other_instance, 2u);
}

TEST_P(Structures, WhatDidNotMoveIsSkipped) {
  Stage stage(GetParam(), make_runner_scene({.crowd = 4, .crowd_poses = 2}));
  const StructureStatistics& s = stage.manager.statistics();
  EXPECT_EQ(s.static_structures, 1u);
  EXPECT_EQ(s.skinned_structures, 3u);  // the hero's and one per pose
  stage.go(0.5);
  EXPECT_EQ(s.skinned, 3u);
  EXPECT_EQ(s.rebuilt, 3u);
  EXPECT_EQ(s.barriers, 4u);
  EXPECT_EQ(s.moved_instances, 0u);  // there is no earlier frame
  stage.go(0.6);
  EXPECT_EQ(s.skinned, 3u);
  EXPECT_EQ(s.rebuilt + s.updated, 3u);
  EXPECT_EQ(s.moved_instances, 5u);
  const FloatImage before = stage.read(kViewZ);
  stage.go(0.6);
  EXPECT_EQ(s.skipped, 3u);
  EXPECT_EQ(s.skinned + s.rebuilt + s.updated, 0u);
  EXPECT_EQ(s.barriers, 1u);  // for the top level
  EXPECT_EQ(s.moved_instances, 0u);
  EXPECT_EQ(stage.read(kViewZ).values, before.values);
  for (const float value : stage.read(kMotion).values) ASSERT_NEAR(value, 0.0f, 1e-6);
  // The pose before the pause is the history of the pose after it.
  stage.go(0.7, false);
  const std::vector<Vertex> pose =
      skin_vertices(stage.scene.meshes[1], stage.previous_states[1].joints);
  EXPECT_LT(distance(deformed(stage, 1)[100].previous_position, pose[100].position), 2e-6);
}

TEST_P(Structures, RebuildsAreStaggered) {
  StructureOptions options;
  options.deformable_period = 4;
  options.hero_period = 6;
  Stage stage(GetParam(), make_runner_scene({.crowd = 4, .crowd_poses = 4}), options, 8, 8);
  stage.go(0, false);
  std::uint32_t rebuilt = 0;
  for (int i = 1; i <= 12; ++i) {
    stage.go(0.03 * i, false);
    const StructureStatistics& s = stage.manager.statistics();
    EXPECT_EQ(s.rebuilt + s.updated, 5u);
    EXPECT_LE(s.rebuilt, 2u);  // one of the crowd, and the hero
    rebuilt += s.rebuilt;
  }
  EXPECT_EQ(rebuilt, 4u * 3u + 2u);
}

// Picture coordinates and depth of a point relative to a camera.
glm::dvec3 project(const FrameConstants& c, const glm::dvec3& p, bool previous) {
  const glm::dvec3 right(previous ? c.previous_right : c.camera_right);
  const glm::dvec3 up(previous ? c.previous_up : c.camera_up);
  const glm::dvec3 forward(previous ? c.previous_forward : c.camera_forward);
  const double z = glm::dot(p, forward);
  return {0.5 + 0.5 * glm::dot(p, right) / glm::dot(right, right) / z,
          0.5 - 0.5 * glm::dot(p, up) / glm::dot(up, up) / z, z};
}

// Barycentrics of a point in a triangle; the third value is its distance from the plane, and more
// if it is outside.
glm::dvec3 locate(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                  const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double area = glm::dot(n, n);
  if (area == 0) return {0, 0, 1e9};
  const double v = glm::dot(glm::cross(p - a, c - a), n) / area;
  const double w = glm::dot(glm::cross(b - a, p - a), n) / area;
  const double outside = std::max({-v, -w, v + w - 1.0, 0.0});
  return {v, w, std::abs(glm::dot(p - a, n)) / std::sqrt(area) + outside};
}

// Finds where a point of an instance was before, if it lies in triangle `primitive` of one of its
// geometries.
bool previous_of(const Mesh& mesh, const std::vector<Vertex>& now,
                 const std::vector<Vertex>& before, std::uint32_t primitive,
                 const glm::dvec3& object, glm::dvec3& out) {
  double best = 1e-4;
  for (const Geometry& g : mesh.geometries) {
    if (3 * primitive + 2 >= g.index_count) continue;
    std::size_t id[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      id[k] = g.first_vertex + mesh.index(g, 3 * primitive + k);
    }
    const glm::dvec3 at = locate(object, glm::dvec3(now[id[0]].position),
                                 glm::dvec3(now[id[1]].position), glm::dvec3(now[id[2]].position));
    if (at.z >= best) continue;
    best = at.z;
    out = glm::dvec3(before[id[0]].position) * (1 - at.x - at.y) +
          glm::dvec3(before[id[1]].position) * at.x + glm::dvec3(before[id[2]].position) * at.y;
  }
  return best < 1e-4;
}

// Figures walk while the camera moves and turns, near the origin and far from it.
TEST_P(Structures, MotionIsWhereTheHostProjectsThePreviousPosition) {
  for (const double away : {0.0, 1e5}) {
    Scene scene = make_runner_scene({.crowd = 4, .crowd_poses = 2});
    const glm::dvec3 far_away(away, 0, -away);
    for (Instance& instance : scene.instances) instance.transform[3] += glm::dvec4(far_away, 0);
    scene.cameras[0].camera_to_world[3] += glm::dvec4(far_away, 0);
    Stage stage(GetParam(), scene);
    stage.go(0.40);
    stage.camera.camera_to_world =
        look_at(far_away + glm::dvec3(0.65, 1.72, 4.5), far_away + glm::dvec3(0.03, 0.9, 0));
    FrameTime time;
    time.previous_camera = stage.previous_camera;
    const FrameConstants c = frame_constants(stage.scene, stage.camera, stage.desc, time);
    stage.go(0.44);
    const FloatImage ids = stage.read(kIds), at = stage.read(kPosition);
    const FloatImage motion = stage.read(kMotion);
    std::vector<std::vector<Vertex>> now(scene.instances.size()), before(scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
      const bool skinned = scene.instances[i].motion.skin != kNoIndex;
      now[i] = skinned ? skin_vertices(mesh, stage.states[i].joints) : mesh.vertices;
      before[i] = skinned ? skin_vertices(mesh, stage.previous_states[i].joints) : mesh.vertices;
    }
    std::size_t compared = 0, on_figures = 0;
    double largest = 0;
    for (std::size_t pixel = 0; pixel < motion.values.size() / 4; ++pixel) {
      const std::uint32_t id =
          static_cast<std::uint32_t>(ids.values[pixel * static_cast<std::size_t>(ids.channels)]);
      if (id == 0) continue;
      const std::size_t i = id - 1;
      const glm::dvec3 position(at.values[4 * pixel], at.values[4 * pixel + 1],
                                at.values[4 * pixel + 2]);
      const glm::dvec3 world = position + stage.camera.position();
      const glm::dvec3 object(glm::inverse(stage.states[i].transform) * glm::dvec4(world, 1));
      glm::dvec3 then;
      const std::uint32_t primitive = static_cast<std::uint32_t>(
          ids.values[pixel * static_cast<std::size_t>(ids.channels) + 1]);
      ASSERT_TRUE(previous_of(scene.meshes[scene.instances[i].mesh], now[i], before[i], primitive,
                              object, then))
          << "pixel " << pixel << ", instance " << i;
      const glm::dvec3 world_then(stage.previous_states[i].transform * glm::dvec4(then, 1));
      const glm::dvec3 expected =
          project(c, world_then - glm::dvec3(scene.cameras[0].position()), true) -
          project(c, position, false);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(motion.values[4 * pixel + k], expected[static_cast<int>(k)], 1e-4)
            << "pixel " << pixel << ", instance " << i << ", component " << k;
      }
      ++compared;
      if (i == 0) continue;
      ++on_figures;
      largest = std::max(largest, glm::length(glm::dvec2(expected)));
    }
    EXPECT_GT(compared, motion.values.size() / 8);
    EXPECT_GT(on_figures, motion.values.size() / 80);
    EXPECT_GT(largest, 0.005);
  }
}

TEST_P(Structures, StaticScenesAreThoseOfCreateGpuScene) {
  const Scene scene = make_sphere_oracle(1.0, 1.5);
  Stage stage(GetParam(), scene);
  stage.go(0);
  const GpuScene gpu =
      create_gpu_scene(stage.device, stage.queue, scene, stage.camera.position()).value();
  const FloatImage of_manager = stage.read(kPosition);
  stage.frame.set_scene(stage.device, gpu).value();
  rtapi::CommandList list = stage.device.CreateCommandList().value();
  stage.gbuffer.dispatch(list, stage.frame, {}, stage.desc.height);
  stage.queue.ExecuteAndWait(list).value();
  EXPECT_EQ(stage.read(kPosition).values, of_manager.values);
  const StructureStatistics& s = stage.manager.statistics();
  EXPECT_LE(s.static_bytes, s.static_bytes_before_compaction);
  EXPECT_EQ(s.static_structures, 2u);
  EXPECT_EQ(s.barriers, 1u);
}

// Rays hit the level of detail that the state names.
TEST_P(Structures, LevelsOfDetailAreWhatRaysMeet) {
  Scene scene = make_runner_scene({.crowd = 1, .crowd_poses = 1});
  std::size_t fixed = 0;
  while (scene.instances[fixed].motion.skin != kNoIndex) ++fixed;
  Instance& instance = scene.instances[fixed];
  // The coarse level is the same mesh without the last triangles.
  Mesh coarse = scene.meshes[instance.mesh];
  coarse.name += " coarse";
  coarse.geometries.resize(1);
  coarse.geometries[0].index_count = 3;
  scene.meshes.push_back(coarse);
  instance.levels = {{instance.mesh, 0.5f},
                     {static_cast<std::uint32_t>(scene.meshes.size() - 1), 0.0f}};
  Stage stage(GetParam(), scene);
  const auto hits_of = [&](std::int32_t mesh) {
    stage.states = evaluate_instances(stage.scene, 0);
    stage.states[fixed].mesh = mesh;
    rtapi::CommandList list = stage.device.CreateCommandList().value();
    stage.manager.record(list, stage.states, stage.camera.position()).value();
    stage.gbuffer.dispatch(list, stage.frame, {}, stage.desc.height);
    stage.queue.ExecuteAndWait(list).value();
    const FloatImage ids = stage.read(kIds);
    std::size_t count = 0;
    for (std::size_t i = 0; i < ids.values.size(); i += 2) {
      count += ids.values[i] == static_cast<float>(fixed + 1) ? 1 : 0;
    }
    return count;
  };
  const std::size_t fine = hits_of(kNoIndex);
  EXPECT_EQ(stage.manager.statistics().changed_levels, 0u);
  const std::size_t less = hits_of(static_cast<std::int32_t>(instance.levels[1].mesh));
  EXPECT_EQ(stage.manager.statistics().changed_levels, 1u);
  EXPECT_LT(less, fine);
  EXPECT_EQ(hits_of(kNoIndex), fine);
  stage.states[fixed].mesh = static_cast<std::int32_t>(stage.scene.meshes.size());
  rtapi::CommandList list = stage.device.CreateCommandList().value();
  const auto refused = stage.manager.record(list, stage.states, stage.camera.position());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("not one of its levels"), std::string::npos);
}

TEST_P(Structures, StagesCanBeExecutedAndMeasured) {
  Stage stage(GetParam(), make_runner_scene({.crowd = 1, .crowd_poses = 1}));
  stage.manager
      .execute(stage.device, stage.queue, evaluate_instances(stage.scene, 0.2),
               stage.camera.position())
      .value();
  const StructureStatistics& s = stage.manager.statistics();
  EXPECT_EQ(s.rebuilt, 2u);
  EXPECT_GT(s.skinning_ms, 0);
  EXPECT_GT(s.bottom_level_ms, 0);
  EXPECT_GT(s.top_level_ms, 0);
  EXPECT_GT(s.skinned_vertices, 2000u);
}

TEST(StructureErrors, StatesOfAnotherScene) {
  Stage stage("embree", make_runner_scene({.crowd = 1, .crowd_poses = 1}), {}, 8, 8);
  rtapi::CommandList list = stage.device.CreateCommandList().value();
  std::vector<InstanceState> states = evaluate_instances(stage.scene, 0.0);
  states[1].joints.pop_back();
  const rtapi::Status joints = stage.manager.record(list, states, {});
  ASSERT_FALSE(joints);
  EXPECT_NE(joints.error().message.find("19 given, 20 expected"), std::string::npos);
  states.pop_back();
  const rtapi::Status count = stage.manager.record(list, states, {});
  ASSERT_FALSE(count);
  EXPECT_NE(count.error().message.find("2 given, 3 expected"), std::string::npos);
}

TEST(Runner, IsValidAndWalksInACircle) {
  const Scene scene = make_runner_scene();
  ASSERT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  EXPECT_EQ(scene.skins[0].joints.size(), kRunnerBones);
  const auto start = evaluate_instances(scene, 0.0);
  const auto end = evaluate_instances(scene, kRunnerSeconds);
  const auto half = evaluate_instances(scene, 0.5 * kRunnerSeconds);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(start[1].transform[3][c], end[1].transform[3][c], 1e-9);
  }
  EXPECT_NEAR(glm::length(start[1].transform[3] - half[1].transform[3]), 2.8, 0.01);
  // The feet are on the floor, never far below or above it.
  for (double t = 0; t < kRunnerSeconds; t += 0.1) {
    const auto states = evaluate_instances(scene, t);
    double lowest = 1e9;
    for (const Vertex& v : skin_vertices(scene.meshes[1], states[1].joints)) {
      lowest = std::min(lowest, static_cast<double>(v.position.y));
    }
    EXPECT_NEAR(lowest, 0.0, 0.09) << "at " << t << " s";
  }
}

TEST(Runner, BrokenSkeletonsAreNamed) {
  Scene scene = make_runner_scene();
  scene.nodes[3].parent = 7;
  EXPECT_NE(validate(scene).error().message.find("node \"neck\""), std::string::npos);
  scene = make_runner_scene();
  scene.meshes[1].skin[5].joints.x = 20;
  EXPECT_NE(validate(scene).error().message.find("joint 20 of 20"), std::string::npos);
  scene = make_runner_scene();
  scene.animations[0].channels[2].times[4] = 0.0f;
  EXPECT_NE(validate(scene).error().message.find("do not rise"), std::string::npos);
}

}  // namespace
}  // namespace kaamos::effects
