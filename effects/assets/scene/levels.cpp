// SPDX-License-Identifier: MIT
#include "effects/assets/scene/levels.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace kaamos::effects {
namespace {

// "tree_LOD2" is level 2 of "tree_".
struct LevelName {
  std::string stem;
  std::size_t level;
};

std::optional<LevelName> parse_level(const std::string& name) {
  std::size_t digits = name.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1]))) --digits;
  constexpr std::size_t kMostDigits = 2;
  if (digits == name.size() || name.size() - digits > kMostDigits || digits < 3) return {};
  std::string word = name.substr(digits - 3, 3);
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (word != "lod") return {};
  return LevelName{name.substr(0, digits - 3), std::stoul(name.substr(digits))};
}

bool can_be_level(const Instance& a, const Instance& b) {
  return a.transform == b.transform && a.motion == b.motion && a.motion.skin == kNoIndex &&
         a.motion.morph == kNoIndex && a.mask == b.mask && a.levels.empty() && b.levels.empty();
}

}  // namespace

double screen_coverage(const Bounds& bounds, const glm::dmat4& transform, const Camera& camera) {
  if (bounds.empty()) return 0;
  const glm::dvec3 center(transform * glm::dvec4(bounds.center(), 1));
  double stretch = 0;
  for (int axis = 0; axis < 3; ++axis) {
    stretch = std::max(stretch, glm::length(glm::dvec3(transform[axis])));
  }
  const double radius = 0.5 * glm::length(bounds.size()) * stretch;
  if (camera.is_orthographic()) return radius / camera.half_height;
  const double distance = glm::length(center - camera.position());
  if (!(distance > radius)) return std::numeric_limits<double>::infinity();
  return radius / (distance * std::tan(camera.vertical_fov / 2));
}

std::vector<std::uint32_t> select_levels(const Scene& scene, const Camera& camera,
                                         std::span<const glm::dmat4> transforms) {
  std::map<std::uint32_t, Bounds> bounds;  // of the finest meshes
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    out.push_back(instance.mesh);
    if (instance.levels.empty()) continue;
    const std::uint32_t finest = instance.levels.front().mesh;
    const auto [found, is_new] = bounds.try_emplace(finest);
    if (is_new) found->second = scene.meshes[finest].bounds();
    const glm::dmat4& transform = transforms.empty() ? instance.transform : transforms[i];
    const double coverage = screen_coverage(found->second, transform, camera);
    const auto level =
        std::find_if(instance.levels.begin(), instance.levels.end() - 1,
                     [&](const Level& candidate) { return coverage >= candidate.coverage; });
    out.back() = level->mesh;
  }
  return out;
}

void show_levels(Scene& scene, const Camera& camera) {
  const std::vector<std::uint32_t> meshes = select_levels(scene, camera);
  for (std::size_t i = 0; i < meshes.size(); ++i) scene.instances[i].mesh = meshes[i];
}

std::vector<float> default_coverages(std::size_t count) {
  std::vector<float> out(count, 0.0f);
  for (std::size_t i = 0; i + 1 < count; ++i) out[i] = std::ldexp(0.5f, -static_cast<int>(i));
  return out;
}

std::size_t join_levels_by_name(Scene& scene) {
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>>
      groups;  // level, instance
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (const auto name = parse_level(scene.instances[i].name)) {
      groups[name->stem].push_back({name->level, i});
    }
  }
  std::vector<bool> gone(scene.instances.size(), false);
  for (auto& [stem, members] : groups) {
    std::sort(members.begin(), members.end());
    Instance& first = scene.instances[members.front().second];
    bool whole = members.size() > 1;
    for (std::size_t level = 0; level < members.size(); ++level) {
      whole = whole && members[level].first == level &&
              can_be_level(first, scene.instances[members[level].second]);
    }
    if (!whole) continue;
    const std::vector<float> coverages = default_coverages(members.size());
    std::vector<Level> levels;
    for (std::size_t level = 0; level < members.size(); ++level) {
      levels.push_back({scene.instances[members[level].second].mesh, coverages[level]});
      gone[members[level].second] = level > 0;
    }
    first.levels = std::move(levels);
  }
  std::vector<Instance> kept;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) kept.push_back(std::move(scene.instances[i]));
  }
  const std::size_t count = gone.size() - kept.size();
  scene.instances = std::move(kept);
  return count;
}

}  // namespace kaamos::effects
