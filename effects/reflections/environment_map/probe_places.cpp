// SPDX-License-Identifier: MIT
#include "effects/reflections/environment_map/probe_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kPoints = 6;   // register t, space3
constexpr std::uint32_t kSights = 21;  // register u, space3
constexpr std::uint32_t kFaces = 6;
// As in probe_sights.hlsli.
constexpr std::uint32_t kSightSide = 8, kSightsOfFace = kSightSide * kSightSide;
constexpr std::uint32_t kSightsOfPoint = kFaces * kSightsOfFace;
constexpr std::uint32_t kPointsOfCell = 8;
constexpr glm::uvec3 kSurvey(6, 2, 6);  // points over the scene, among which rooms are found
// Where more of the sky is seen than from the camera, times this, or than this part, is outside.
constexpr double kOutside = 1.5, kLeastOpen = 0.125;
// A wall fills at least this part of a face's rays.
constexpr double kLeastWall = 1.0 / 16;
// One point has more room than another if it has so much more: rounding decides nothing.
constexpr float kMoreRoom = 1.015625f;

// Points are relative to the first camera, in floats: so a scene that stands elsewhere has the
// same.
struct Box {
  glm::vec3 low, high;
  bool holds(const glm::vec3& p) const {
    return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
  }
};

struct Sight {
  float axial;    // distance along the face's axis; 0: nothing is there
  float is_wall;  // 1: it faces the axis
  float distance;
  float unused;
};

// How much farther than the scene's end a box reaches where nothing is: as far away as things in
// this scene are, a length of its own.
double room_beyond(const Bounds& box) {
  const glm::dvec3 sides = box.size();
  const double longest = std::max({sides.x, sides.y, sides.z});
  return longest > 0 ? longest / 4 : 1;
}

// Moves sides on which a box ends at `from` or before, the sky above flat ground say.
void add_room(Bounds& box, const glm::dvec3& from) {
  const double beyond = room_beyond(box);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] < from[axis])) box.min[axis] = from[axis] - beyond;
    if (!(box.max[axis] > from[axis])) box.max[axis] = from[axis] + beyond;
  }
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// A box is halved along its longest sides.
std::vector<Box> cells_of(const Box& box, std::uint32_t count) {
  glm::vec3 size = box.high - box.low;
  glm::uvec3 cells(1);
  for (std::uint32_t made = 1; made * 2 <= count; made *= 2) {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (size[axis] > size[longest]) longest = axis;
    }
    size[longest] *= 0.5f;
    cells[longest] *= 2;
  }
  std::vector<Box> out;
  for (std::uint32_t z = 0; z < cells.z; ++z) {
    for (std::uint32_t y = 0; y < cells.y; ++y) {
      for (std::uint32_t x = 0; x < cells.x; ++x) {
        const glm::vec3 low = box.low + size * glm::vec3(x, y, z);
        out.push_back({low, low + size});
      }
    }
  }
  return out;
}

// Points in the middles of so many parts of a box.
void add_points(std::vector<glm::vec4>& points, const Box& box, const glm::uvec3& parts) {
  for (std::uint32_t z = 0; z < parts.z; ++z) {
    for (std::uint32_t y = 0; y < parts.y; ++y) {
      for (std::uint32_t x = 0; x < parts.x; ++x) {
        const glm::vec3 at = (glm::vec3(x, y, z) + 0.5f) / glm::vec3(parts);
        points.emplace_back(box.low + (box.high - box.low) * at, 0.0f);
      }
    }
  }
}

// What points see. The first is where the camera stands.
class Views {
 public:
  Views(std::vector<Sight> sights, std::size_t count) : sights_(std::move(sights)), count_(count) {
    find_joined();
  }
  std::span<const Sight> of(std::size_t point) const {
    return std::span(sights_).subspan(point * (kSightsOfPoint + count_), kSightsOfPoint);
  }
  // Whether a chain of points, each in sight of the next, joins it to the first.
  bool is_joined(std::size_t point) const { return joined_[point]; }
  // The part of what is around a point where nothing is.
  double openness(std::size_t point) const {
    const auto sights = of(point);
    const auto nothing = std::count_if(sights.begin(), sights.end(),
                                       [](const Sight& sight) { return sight.axial == 0; });
    return static_cast<double>(nothing) / kSightsOfPoint;
  }

 private:
  void find_joined() {
    joined_.assign(count_, false);
    std::vector<std::size_t> open = {0};
    joined_[0] = true;
    while (!open.empty()) {
      const std::size_t from = open.back();
      open.pop_back();
      for (std::size_t to = 0; to < count_; ++to) {
        const std::size_t at = from * (kSightsOfPoint + count_) + kSightsOfPoint + to;
        if (joined_[to] || sights_[at].axial == 0) continue;
        joined_[to] = true;
        open.push_back(to);
      }
    }
  }

  std::vector<Sight> sights_;
  std::size_t count_;
  std::vector<bool> joined_;
};

rtapi::Result<Views> look_around(const EffectScope& scope, const std::vector<glm::vec4>& points) {
  RayPassDesc desc;
  desc.name = "probe sights";
  desc.library = scope.library("reflections/environment_map/environment_bake");
  desc.ray_generation = "LookAround";
  desc.miss[kRayTypeSurface] = "SightMiss";
  desc.hit[kRayTypeSurface] = {"SightAnyHit", "SightClosestHit"};
  desc.payload_bytes = 16;
  const auto pass = RayPass::create(scope.device, scope.frame, scope.gpu, desc);
  if (!pass) return pass.error();
  const auto count = static_cast<std::uint32_t>(points.size());
  const std::uint32_t row = kSightsOfPoint + count;
  const auto buffer = rtapi::CreateUploadBuffer(scope.device, points, "probe points");
  if (!buffer) return buffer.error();
  rtapi::BufferDesc sights;
  sights.SizeInBytes = std::uint64_t{row} * count * sizeof(Sight);
  sights.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  sights.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  sights.Name = "probe sights";
  const auto seen = scope.device.CreateBuffer(sights);
  if (!seen) return seen.error();
  if (const auto s = scope.views.set_shader_resource(kPoints, *buffer, sizeof(glm::vec4)); !s) {
    return s.error();
  }
  if (const auto s = scope.views.set_unordered_access(kSights, *seen, sizeof(Sight)); !s) {
    return s.error();
  }
  auto list = scope.device.CreateCommandList();
  if (!list) return list.error();
  pass->dispatch_grid(*list, scope.frame, {}, row, count, PassArguments(scope.views));
  if (const auto s = scope.queue.ExecuteAndWait(*list); !s) return s.error();
  const auto bytes = rtapi::ReadbackBuffer(scope.device, scope.queue, *seen);
  if (!bytes) return bytes.error();
  std::vector<Sight> out(std::size_t{row} * count);
  std::memcpy(out.data(), bytes->data(), out.size() * sizeof(Sight));
  return Views(std::move(out), count);
}

// How near the nearest thing is; 0: nothing is in sight.
float room_around(std::span<const Sight> sights) {
  float nearest = 0;
  for (const Sight& sight : sights) {
    if (sight.axial > 0 && (nearest == 0 || sight.distance < nearest)) nearest = sight.distance;
  }
  return nearest;
}

// How far away the wall of a face is: a sixth of the walls that fill it is no farther, so that
// neither a box on the way counts for it nor another room behind a doorway. 0: there is none.
float wall_of(std::span<const Sight> face) {
  std::vector<float> walls;
  for (const Sight& sight : face) {
    if (sight.is_wall != 0) walls.push_back(sight.axial);
  }
  if (static_cast<double>(walls.size()) < kLeastWall * kSightsOfFace) return 0;
  std::sort(walls.begin(), walls.end());
  return walls[walls.size() / 6];
}

// How far beyond the end of the scene a side without a wall lies.
double beyond_of(std::span<const Sight> face, const Bounds& scene) {
  const auto nothing =
      std::count_if(face.begin(), face.end(), [](const Sight& sight) { return sight.axial == 0; });
  return 2 * static_cast<std::size_t>(nothing) > face.size() ? room_beyond(scene) : 0;
}

EnvironmentProbe probe_at(const glm::dvec3& position, std::span<const Sight> sights,
                          const Bounds& scene) {
  Bounds box = scene;
  add_room(box, position);
  EnvironmentProbe probe{position, box.min, box.max};
  for (std::uint32_t face = 0; face < kFaces; ++face) {
    const auto seen = sights.subspan(std::size_t{face} * kSightsOfFace, kSightsOfFace);
    const float wall = wall_of(seen);
    const auto axis = static_cast<int>(face / 2);
    double& low = probe.box_min[axis];
    double& high = probe.box_max[axis];
    if (face % 2 == 0) {
      high = wall > 0 ? position[axis] + wall : high + beyond_of(seen, scene);
    } else {
      low = wall > 0 ? position[axis] - wall : low - beyond_of(seen, scene);
    }
  }
  return probe;
}

// How open a place may be that is not outside.
double most_openness(const Views& views) {
  return std::max(kOutside * views.openness(0), kLeastOpen);
}

// The room that a point is in, as far as the scene reaches.
Box room_of(const glm::dvec3& position, std::span<const Sight> sights, const Bounds& bounds,
            const Box& whole, const glm::dvec3& camera) {
  const EnvironmentProbe probe = probe_at(position, sights, bounds);
  return {glm::max(glm::vec3(probe.box_min - camera), whole.low),
          glm::min(glm::vec3(probe.box_max - camera), whole.high)};
}

// The camera's room, and those that a survey of the scene finds besides, the widest first.
rtapi::Result<std::vector<Box>> find_rooms(const EffectScope& scope, const Bounds& bounds,
                                           const Box& whole, const glm::dvec3& camera,
                                           std::uint32_t most) {
  std::vector<glm::vec4> points = {glm::vec4(0.0f)};
  add_points(points, whole, kSurvey);
  const auto views = look_around(scope, points);
  if (!views) return views.error();
  const double most_open = most_openness(*views);
  std::vector<Box> rooms = {room_of(camera, views->of(0), bounds, whole, camera)};
  while (rooms.size() < most) {
    std::size_t best = 0;
    float most_room = 0;
    for (std::size_t point = 1; point < points.size(); ++point) {
      const auto is_inside = [&](const Box& room) { return room.holds(glm::vec3(points[point])); };
      if (!views->is_joined(point) || views->openness(point) > most_open ||
          std::any_of(rooms.begin(), rooms.end(), is_inside)) {
        continue;
      }
      const float room = room_around(views->of(point));
      if (!(room > kMoreRoom * most_room)) continue;
      best = point;
      most_room = room;
    }
    if (best == 0) break;
    rooms.push_back(
        room_of(camera + glm::dvec3(points[best]), views->of(best), bounds, whole, camera));
  }
  return rooms;
}

}  // namespace

EnvironmentProbe camera_probe(const Scene& scene) {
  const glm::dvec3 position = scene.cameras.front().position();
  Bounds box = scene_bounds(scene);
  box.add(position);
  add_room(box, position);
  return {position, box.min, box.max};
}

rtapi::Result<std::vector<EnvironmentProbe>> find_environment_probes(const EffectScope& scope,
                                                                     std::uint32_t most) {
  const glm::dvec3 camera = scope.scene.cameras.front().position();
  Bounds bounds = scene_bounds(scope.scene);
  bounds.add(camera);
  if (!is_finite(bounds.min) || !is_finite(bounds.max)) {
    return std::vector{camera_probe(scope.scene)};
  }
  const Box whole{glm::vec3(bounds.min - camera), glm::vec3(bounds.max - camera)};
  const auto rooms = find_rooms(scope, bounds, whole, camera, most);
  if (!rooms) return rooms.error();
  std::vector<glm::vec4> points = {glm::vec4(0.0f)};
  for (const Box& room : *rooms) {
    const auto share = most / static_cast<std::uint32_t>(rooms->size());
    for (const Box& cell : cells_of(room, share)) add_points(points, cell, glm::uvec3(2));
  }
  const auto views = look_around(scope, points);
  if (!views) return views.error();
  const double most_open = most_openness(*views);
  std::vector<EnvironmentProbe> probes;
  for (std::size_t cell = 1; cell < points.size(); cell += kPointsOfCell) {
    std::size_t best = 0;
    float most_room = 0;
    for (std::size_t point = cell; point < cell + kPointsOfCell; ++point) {
      if (!views->is_joined(point) || views->openness(point) > most_open) continue;
      const float room = room_around(views->of(point));
      if (!(room > kMoreRoom * most_room)) continue;
      best = point;
      most_room = room;
    }
    if (best == 0) continue;
    probes.push_back(probe_at(camera + glm::dvec3(points[best]), views->of(best), bounds));
  }
  // Nothing is open but where the camera stands.
  if (probes.empty()) probes.push_back(probe_at(camera, views->of(0), bounds));
  return probes;
}

rtapi::Result<std::vector<EnvironmentProbe>> environment_probes(const EffectScope& scope,
                                                                std::uint32_t most) {
  if (!scope.scene.probes.empty()) return scope.scene.probes;
  return find_environment_probes(scope, most);
}

}  // namespace kaamos::effects
