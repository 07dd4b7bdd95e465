// SPDX-License-Identifier: MIT
#include "effects/assets/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/common/ray_origin.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/image/srgb.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"
#include "effects/assets/scene/tangents.h"

namespace kaamos::effects {
namespace {

Scene valid_scene() {
  return make_sphere_oracle(0.5, 0.6);
}

void expect_refused(const Scene& scene, const std::string& part) {
  const Status status = validate(scene);
  EXPECT_FALSE(status.ok()) << part;
  EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
}

TEST(Validate, NamesTheFirstBrokenRule) {
  ASSERT_TRUE(validate(valid_scene()).ok());
  Scene scene = valid_scene();
  scene.meshes[1].geometries[0].material = 7;
  expect_refused(scene, "mesh \"sphere\", geometry 0: material 7 of 1");
  scene = valid_scene();
  scene.instances[0].mesh = 9;
  expect_refused(scene, "mesh 9 of 2");
  scene = valid_scene();
  scene.meshes[0].geometries[0].index_count += 3;
  expect_refused(scene, "indices end at byte");
  scene = valid_scene();
  scene.meshes[0].geometries[0].vertex_count = 2;
  expect_refused(scene, "the geometry has 2 vertices");
  scene = valid_scene();
  scene.materials[0].constants.image[kNormalTexture] = 0;
  expect_refused(scene, "image 0 of 0");
  scene = valid_scene();
  scene.instances[1].transform[3][0] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(scene, "instance \"sphere\": transform is not finite");
  scene = valid_scene();
  scene.cameras.clear();
  expect_refused(scene, "no camera");
  scene = valid_scene();
  scene.sun->direction_to_sun = glm::vec3(1, 1, 1);
  expect_refused(scene, "unit vector");
  scene = valid_scene();
  scene.particles.resize(2);
  scene.particles[1].radius = 0;
  expect_refused(scene, "particle 1: position or radiance is not finite, or radius is not above 0");
  scene.particles[1] = {.opacity = 1.5f};
  expect_refused(scene, "particle 1: opacity is 1.5");
}

TEST(Mesh, StoresShortIndicesWhereTheyFit) {
  Mesh mesh;
  const std::vector<Vertex> small(3), large(65537);
  const std::vector<std::uint32_t> first = {2, 1, 0}, second = {65536, 0, 7};
  mesh.add_geometry(small, first, 0, false);
  mesh.add_geometry(large, second, 1, true);
  EXPECT_EQ(mesh.geometries[0].index_size_bytes, 2u);
  EXPECT_EQ(mesh.geometries[1].index_size_bytes, 4u);
  EXPECT_EQ(mesh.geometries[1].index_offset_bytes % 16, 0u);
  EXPECT_EQ(mesh.index(mesh.geometries[0], 0), 2u);
  EXPECT_EQ(mesh.index(mesh.geometries[1], 0), 65536u);
  EXPECT_EQ(&mesh.corner(mesh.geometries[1], 0, 1), &mesh.vertices[3]);
}

TEST(TextureImage, MipsKeepMeanAndCoverage) {
  TextureImage image;
  image.width = 37;
  image.height = 20;
  image.mips.emplace_back(37 * 20 * 4);
  for (std::size_t i = 0; i < image.mips[0].size(); i += 4) {
    const bool hole = (pcg_hash(static_cast<std::uint32_t>(i)) & 3u) == 0;
    for (std::size_t c = 0; c < 3; ++c) image.mips[0][i + c] = 100;
    image.mips[0][i + 3] = hole ? 0 : 255;
  }
  generate_mips(image, 0.5f);
  ASSERT_EQ(image.mips.size(), 6u);
  EXPECT_EQ(image.mips.back().size(), 4u);
  EXPECT_EQ(image.mips[1].size(), 18u * 10 * 4);
  EXPECT_EQ(image.mips[3][0], 100) << "hidden texels do not darken";
  EXPECT_NEAR(alpha_coverage(image, 2, 0.5f), alpha_coverage(image, 0, 0.5f), 0.1f);
}

TEST(TextureImage, SrgbRoundTrip) {
  for (int i = 0; i < 256; ++i) {
    const float encoded = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(encoded)), encoded, 1e-5f);
  }
}

TEST(Camera, LookAtIsRigidAndLooksThere) {
  for (const glm::dvec3& target :
       {glm::dvec3(3, 2, 1), glm::dvec3(0, 5, 0), glm::dvec3(0, -5, 0), glm::dvec3(0, 0, 0)}) {
    const glm::dmat4 m = look_at({0, 0, 0}, target);
    EXPECT_NEAR(glm::determinant(glm::dmat3(m)), 1.0, 1e-12);
    if (target != glm::dvec3(0.0)) {
      EXPECT_NEAR(glm::dot(-glm::dvec3(m[2]), glm::normalize(target)), 1.0, 1e-12);
    }
  }
}

TEST(Camera, FramingShowsTheWholeBox) {
  Bounds box;
  box.add({-1, 0, -2});
  box.add({4, 3, 1});
  const Camera camera = framing_camera(box);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 p((i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                       (i & 4) ? box.max.z : box.min.z);
    const glm::dvec4 v = glm::inverse(camera.camera_to_world) * glm::dvec4(p, 1.0);
    EXPECT_LT(v.z, -camera.near_plane);
    EXPECT_LT(std::abs(v.y / v.z), std::tan(0.5 * camera.vertical_fov));
    EXPECT_LT(std::abs(v.x / v.z), std::tan(0.5 * camera.vertical_fov) * 16.0 / 9.0);
  }
}

Scene boxes(bool inside_out, double size) {
  Scene scene = valid_scene();
  scene.meshes.resize(1);
  scene.instances.resize(1);
  Shape shape = box(glm::dvec3(size));
  if (inside_out)
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
      std::swap(shape.indices[i], shape.indices[i + 1]);
  scene.meshes[0] = Mesh{};
  add_shape(scene.meshes[0], shape, 0);
  return scene;
}

TEST(Staging, RoomsAreLookedAtFromInside) {
  const Scene room = boxes(true, 3.0), cube = boxes(false, 3.0);
  EXPECT_TRUE(is_interior(room));
  EXPECT_FALSE(is_interior(cube)) << "its faces look outwards";
  const glm::dvec3 inside = default_camera(room).position();
  const glm::dvec3 outside = default_camera(cube).position();
  EXPECT_LT(std::max({std::abs(inside.x), std::abs(inside.y), std::abs(inside.z)}), 3.0);
  EXPECT_GT(std::max({std::abs(outside.x), std::abs(outside.y), std::abs(outside.z)}), 3.0);
}

TEST(Staging, GroundIsAddedWhereThereIsNone) {
  Scene scene = boxes(false, 3.0);
  EXPECT_TRUE(needs_ground(scene)) << "its lowest face looks down";
  add_ground(scene);
  EXPECT_FALSE(needs_ground(scene));
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error().message;
  EXPECT_EQ(scene_bounds(scene).min.y, -3.0);
  EXPECT_FALSE(needs_ground(boxes(true, 3.0))) << "a room has its floor";
}

TEST(Instance, TransformRowsAreRelativeToTheOrigin) {
  Instance instance;
  instance.transform = translate({1e6, 2, 3}) * glm::dmat4(glm::dmat3(2.0));
  instance.transform[1][0] = 5.0;
  const glm::mat3x4 rows = transform_3x4(instance, {1e6 - 0.25, 0, 0});
  EXPECT_EQ(rows[0], glm::vec4(2, 5, 0, 0.25f));
  EXPECT_EQ(rows[1], glm::vec4(0, 2, 0, 2));
  EXPECT_FALSE(is_mirrored(instance));
  instance.transform[2][2] = -2.0;
  EXPECT_TRUE(is_mirrored(instance));
}

TEST(Tangents, FollowTheTexture) {
  // The uv of a picture on a wall facing +z: u to the right, v down.
  Shape shape = patch({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
  for (Vertex& vertex : shape.vertices) vertex.uv.y = 1.0f - vertex.uv.y;
  make_tangents(shape.vertices, shape.indices);
  for (const Vertex& vertex : shape.vertices)
    EXPECT_EQ(vertex.tangent, glm::vec4(1, 0, 0, 1)) << "the bitangent is up in the picture";
  for (Vertex& vertex : shape.vertices) vertex.uv.x = -vertex.uv.x;
  make_tangents(shape.vertices, shape.indices);
  EXPECT_EQ(shape.vertices[4].tangent, glm::vec4(-1, 0, 0, -1)) << "mirrored";
  for (Vertex& vertex : shape.vertices) vertex.uv = glm::vec2(0.0f);
  make_tangents(shape.vertices, shape.indices);
  EXPECT_NEAR(glm::dot(glm::vec3(shape.vertices[4].tangent), shape.vertices[4].normal), 0.0f,
              1e-6f);
}

TEST(Tangents, SmoothNormalsOfASphereAreRadial) {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 32; ++i) {
    const double a = 3.14159265358979 * (i / 32.0 - 0.5);
    profile.emplace_back(std::cos(a), std::sin(a));
  }
  Shape sphere = revolve(profile, 64);
  for (const Vertex& v : sphere.vertices)
    EXPECT_GT(glm::dot(v.normal, glm::normalize(v.position)), 0.998f);
  std::vector<Vertex> flat = sphere.vertices;
  std::vector<std::uint32_t> indices = sphere.indices;
  make_flat_normals(flat, indices);
  EXPECT_EQ(flat.size(), indices.size());
  for (std::size_t i = 0; i < flat.size(); i += 3) EXPECT_EQ(flat[i].normal, flat[i + 2].normal);
  make_smooth_normals(sphere.vertices, sphere.indices);
  const Vertex& equator = sphere.vertices[32 * 65];
  EXPECT_GT(glm::dot(equator.normal, glm::normalize(equator.position)), 0.99f);
}

/// Volume enclosed by a closed surface; negative if it is inside out.
double volume(const Shape& shape) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const glm::dvec3 a(shape.vertices[shape.indices[i]].position);
    const glm::dvec3 b(shape.vertices[shape.indices[i + 1]].position);
    const glm::dvec3 c(shape.vertices[shape.indices[i + 2]].position);
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

TEST(Shapes, AreClosedAndFaceOutside) {
  constexpr double kPi = 3.14159265358979;
  EXPECT_NEAR(volume(box({1, 2, 3})), 48.0, 1e-5);
  const double r = 0.2;
  const glm::dvec3 core(0.8, 1.8, 2.8);
  // The Minkowski sum of the core box and a ball.
  const double rounded = 8 * core.x * core.y * core.z +
                         8 * r * (core.x * core.y + core.y * core.z + core.z * core.x) +
                         2 * kPi * r * r * (core.x + core.y + core.z) + 4.0 / 3 * kPi * r * r * r;
  EXPECT_NEAR(volume(rounded_box({1, 2, 3}, r, 8)), rounded, 1e-2);
  const std::vector<glm::dvec3> line = {{0, 0, 0}, {0, 0, 1}, {0, 0, 3}};
  EXPECT_NEAR(volume(tube(
                  line, [](double) { return 0.5; }, 64)),
              3 * kPi * 0.25, 5e-3);
  EXPECT_NEAR(volume(bar(line, 0.5, 0.2, [](std::size_t) { return glm::dvec3(0, 1, 0); })), 0.3,
              1e-6);
  Shape mirrored;
  append(mirrored, box({1, 1, 1}), glm::dmat4(glm::dmat3(-1.0)));
  EXPECT_NEAR(volume(mirrored), 8.0, 1e-5) << "a mirrored part keeps its outside";
  Shape twisted = rounded_box({1, 1, 1}, 0.3, 6, {8, 8, 8});
  deform(twisted, [](const glm::dvec3& p) {
    const double a = 0.5 * p.y;
    return glm::dvec3(p.x * std::cos(a) - p.z * std::sin(a), p.y,
                      p.x * std::sin(a) + p.z * std::cos(a));
  });
  EXPECT_GT(volume(twisted), 0.95 * volume(rounded_box({1, 1, 1}, 0.3, 6)));
}

TEST(Oracle, ScenesAreValidAndSeenByTheirCamera) {
  for (const Scene& scene :
       {make_sphere_oracle(0.5, 0.6), make_wall_oracle(2.0), make_penumbra_oracle(1.0, 0.05)}) {
    const Status status = validate(scene);
    EXPECT_TRUE(status.ok()) << status.error().message;
    const glm::dvec4 origin =
        glm::inverse(scene.cameras[0].camera_to_world) * glm::dvec4(0, 0, 0, 1);
    EXPECT_LT(origin.z, 0.0) << scene.name;
    EXPECT_EQ(scene.instances[0].name, "plane");
  }
}

TEST(Oracle, FormulasAgreeWithIntegration) {
  // Fraction of cosine-weighted directions that hit the sphere, the wall, the sheet.
  constexpr std::uint32_t kCount = 1u << 16;
  std::uint32_t sphere = 0, wall = 0, bounded = 0, lit = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const glm::vec3 local = sample_cosine_hemisphere(sobol_owen(i, 5));
    const glm::dvec3 d(local.x, local.z, local.y);
    const glm::dvec3 to_center = glm::dvec3(0, 0.6, 0) - glm::dvec3(0.3, 0, 0);
    const double along = glm::dot(to_center, d);
    sphere += along > 0 && glm::dot(to_center, to_center) - along * along < 0.25;
    const double t = d.x < 0 ? -0.7 / d.x : 1e9;
    wall += t < 1e8 && t * d.y < 1.5;
    bounded += t < 2.0;
    const glm::vec2 disk = sample_disk(sobol_owen(i, 6));
    lit += 0.02 + disk.x * std::tan(0.05) * 1.0 > 0.0;
  }
  EXPECT_NEAR(sphere / double{kCount}, sphere_occlusion(0.5, 0.6, 0.3), 1e-3);
  EXPECT_NEAR(wall / double{kCount}, wall_occlusion(1.5, 0.7), 1e-3);
  EXPECT_NEAR(bounded / double{kCount}, wall_occlusion_bounded(2.0, 0.7), 1e-3);
  EXPECT_NEAR(lit / double{kCount}, penumbra_visibility(1.0, 0.05, 0.02), 1e-3);
  EXPECT_EQ(penumbra_visibility(1.0, 0.05, 1.0), 1.0);
  EXPECT_EQ(penumbra_visibility(1.0, 0.05, -1.0), 0.0);
}

/// Returns whether a ray hits the triangle, computed in float as an intersector would.
bool hits(const glm::vec3& o, const glm::vec3& d, const glm::vec3& a, const glm::vec3& b,
          const glm::vec3& c) {
  const glm::vec3 e1 = b - a, e2 = c - a, p = glm::cross(d, e2);
  const float det = glm::dot(e1, p);
  if (det == 0.0f) return false;
  const glm::vec3 s = o - a;
  const float u = glm::dot(s, p) / det;
  const glm::vec3 q = glm::cross(s, e1);
  const float v = glm::dot(d, q) / det;
  return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && glm::dot(e2, q) / det > 0.0f;
}

/// Fraction of rays spawned on random triangles that hit their own triangle again, and the mean
/// offset.
std::pair<double, double> self_hits(double distance, double scale, bool with_offset) {
  std::uint32_t count = 0, bad = 0;
  double offsets = 0.0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const auto r = [&](std::uint32_t k) { return unit_float(hash_combine(i * 32 + k, 99u)); };
    const auto v = [&](std::uint32_t k) {
      return glm::vec3(r(k), r(k + 1), r(k + 2)) * 2.0f - 1.0f;
    };
    const glm::vec3 a = v(0), b = v(3), c = v(6);
    const glm::dmat4 m = translate(glm::dvec3(v(9)) * distance) * rotate_y(6.28 * r(12)) *
                         rotate_x(6.28 * r(13)) * glm::dmat4(glm::dmat3(scale));
    Instance instance;
    instance.transform = m;
    const glm::mat3x4 to_world_rows = transform_3x4(instance);
    instance.transform = glm::inverse(m);
    const glm::mat3x4 to_object_rows = transform_3x4(instance);
    glm::vec2 bary(r(14), r(15));
    if (bary.x + bary.y > 1.0f) bary = 1.0f - bary;
    const SpawnPoint point = make_spawn_point(a, b, c, bary, to_world_rows, to_object_rows);
    const glm::vec3 local = sample_cosine_hemisphere({r(16), r(17)});
    const glm::vec3 d = to_world(local, i & 1 ? point.normal : -point.normal);
    const glm::vec3 o = with_offset ? spawn_origin(point, d) : point.position;
    // The intersector works in object space.
    const glm::vec3 oo = detail::rows_times_point(to_object_rows, o);
    const glm::vec3 od = glm::mat3(glm::inverse(glm::dmat3(m))) * d;
    bad += hits(oo, od, a, b, c);
    offsets += point.offset;
    ++count;
  }
  return {bad / static_cast<double>(count), offsets / count};
}

TEST(RayOrigin, SpawnedRaysDoNotHitTheirOwnTriangle) {
  // Without the offset nearly half of the rays hit the triangle that they leave.
  for (const auto& [distance, scale] :
       {std::pair{0.0, 1e-3}, std::pair{0.0, 1.0}, std::pair{1e3, 1.0}, std::pair{1e5, 1.0}}) {
    EXPECT_GT(self_hits(distance, scale, false).first, 0.3) << "the test can tell";
    const auto [rate, offset] = self_hits(distance, scale, true);
    EXPECT_LE(rate, 2e-4) << distance << " m, scale " << scale;
    EXPECT_LT(offset, 1e-5 * scale + 1e-6 * distance) << distance << " m, scale " << scale;
  }
}

TEST(RayOrigin, TrianglesWithoutAreaGetNoOffset) {
  const glm::mat3x4 identity(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0));
  const SpawnPoint point =
      make_spawn_point({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0.3f, 0.3f}, identity, identity);
  EXPECT_EQ(point.position, glm::vec3(1, 1, 1));
  EXPECT_EQ(point.offset, 0.0f);
  EXPECT_EQ(spawn_origin(point, {0, 1, 0}), glm::vec3(1, 1, 1));
}

}  // namespace
}  // namespace kaamos::effects
