// SPDX-License-Identifier: MIT
#include "runtime/explain/scene.h"

#include <cmath>
#include <cstring>
#include <tuple>

#include "runtime/structures/build_inputs.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/partitioned_instances.h"

namespace kaamos::explain {
namespace {

bool is_finite(const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (!(std::fabs(values[i]) < runtime::kLargestCoordinate)) return false;
  }
  return true;
}

// False if `m` is singular.
bool invert(const std::array<float, 12>& m, std::array<double, 12>& out) {
  const auto at = [&](int r, int c) { return double{m[r * 4 + c]}; };
  double cofactor[3][3];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      cofactor[r][c] = at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
    }
  }
  const double determinant =
      at(0, 0) * cofactor[0][0] + at(0, 1) * cofactor[0][1] + at(0, 2) * cofactor[0][2];
  if (determinant == 0 || !std::isfinite(1 / determinant)) return false;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) out[r * 4 + c] = cofactor[c][r] / determinant;
    out[r * 4 + 3] =
        -(out[r * 4] * at(0, 3) + out[r * 4 + 1] * at(1, 3) + out[r * 4 + 2] * at(2, 3));
  }
  return true;
}

double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
void cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; ++i) {
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  }
}

Box transformed(const Box& box, const std::array<float, 12>& m) {
  Box out;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const double p[3] = {(corner & 1 ? box.upper : box.lower)[0],
                         (corner & 2 ? box.upper : box.lower)[1],
                         (corner & 4 ? box.upper : box.lower)[2]};
    Box point;
    for (int r = 0; r < 3; ++r) {
      const double x = m[r * 4] * p[0] + m[r * 4 + 1] * p[1] + m[r * 4 + 2] * p[2] + m[r * 4 + 3];
      const double room = std::fabs(x) * 1e-12;
      point.lower[r] = x - room;
      point.upper[r] = x + room;
    }
    out.add(point);
  }
  return out;
}

}  // namespace

BottomLevel::BottomLevel(std::shared_ptr<const runtime::BottomLevelBase> source,
                         runtime::BuildFlags flags)
    : source_(std::move(source)), positions_(runtime::positions_of(*source_, flags)) {
  std::vector<Box> boxes;
  for (const runtime::GeometryShape& shape : source_->geometry_shapes()) {
    const auto g = static_cast<uint32_t>(geometries_.size());
    geometries_.push_back({shape, source_->geometry_contents(g), g, source_->cluster_triangles(g)});
    for (uint32_t i = 0; i < shape.primitives; ++i) {
      primitives_.push_back({g, i});
      boxes.push_back(box_of(geometries_.back(), i));
    }
  }
  bvh_.build(std::move(boxes));
}

bool BottomLevel::corners(const Geometry& geometry, uint32_t primitive,
                          const float* (&out)[3]) const {
  const auto& contents = geometry.contents;
  for (int corner = 0; corner < 3; ++corner) {
    const size_t position = size_t{primitive} * 3 + corner;
    const size_t vertex = contents.indices.empty()             ? position
                          : position < contents.indices.size() ? contents.indices[position]
                                                               : SIZE_MAX;
    if (vertex >= contents.xyz.size() / 3) return false;
    out[corner] = &contents.xyz[vertex * 3];
    if (!is_finite(out[corner], 3)) return false;
  }
  return true;
}

Box BottomLevel::box_of(const Geometry& geometry, uint32_t primitive) const {
  Box box;
  if (geometry.shape.type == rtapi::RaytracingGeometryType::kTriangles) {
    const float* corner[3];
    if (!corners(geometry, primitive, corner)) return box;
    for (const float* point : corner) {
      Box each;
      for (int i = 0; i < 3; ++i) each.lower[i] = each.upper[i] = point[i];
      box.add(each);
    }
    return box;
  }
  if (primitive >= geometry.contents.boxes.size()) return box;
  const runtime::PaddedBounds padded = runtime::padded_bounds(geometry.contents.boxes[primitive]);
  if (!padded.active) return box;
  for (int i = 0; i < 3; ++i) {
    box.lower[i] = padded.lower[i];
    box.upper[i] = padded.upper[i];
  }
  return box;
}

void BottomLevel::find(const Ray& ray, uint32_t instance, std::vector<Candidate>& out) const {
  bvh_.visit(ray, [&](uint32_t i) {
    const Geometry& geometry = geometries_[primitives_[i].geometry];
    if (geometry.shape.type == rtapi::RaytracingGeometryType::kTriangles) {
      test_triangle(ray, geometry, primitives_[i].index, instance, out);
    } else {
      test_box(ray, geometry, primitives_[i].index, instance, out);
    }
  });
}

// Two-sided. [Moeller and Trumbore 1997]
void BottomLevel::test_triangle(const Ray& ray, const Geometry& geometry, uint32_t primitive,
                                uint32_t instance, std::vector<Candidate>& out) const {
  const float* corner[3];
  if (!corners(geometry, primitive, corner)) return;
  double edge1[3], edge2[3], to_origin[3], p[3], q[3];
  for (int i = 0; i < 3; ++i) {
    edge1[i] = double{corner[1][i]} - corner[0][i];
    edge2[i] = double{corner[2][i]} - corner[0][i];
    to_origin[i] = ray.origin[i] - corner[0][i];
  }
  cross(ray.direction, edge2, p);
  const double determinant = dot(edge1, p);
  if (determinant == 0 || !std::isfinite(1 / determinant)) return;
  const double u = dot(to_origin, p) / determinant;
  cross(to_origin, edge1, q);
  const double v = dot(ray.direction, q) / determinant;
  const double t = dot(edge2, q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && t >= 0)) return;
  Candidate candidate;
  candidate.t = t;
  candidate.instance = instance;
  candidate.geometry = geometry.shape.index;
  candidate.primitive = primitive;
  candidate.slot = geometry.slot;
  candidate.number = primitive;
  if (geometry.clustered != nullptr) {
    candidate.cluster = &geometry.clustered[primitive];
    candidate.primitive = candidate.cluster->primitive_index;
  }
  candidate.geometry_opaque = geometry.shape.opaque;
  // The determinant is -(edge1 x edge2 . direction): positive where that normal points against the
  // ray.
  candidate.clockwise = determinant > 0;
  candidate.barycentrics[0] = static_cast<float>(u);
  candidate.barycentrics[1] = static_cast<float>(v);
  if (const runtime::MicromapLinkage* linkage = geometry.contents.linkage) {
    candidate.micromap =
        linkage->state_at(primitive, candidate.barycentrics[0], candidate.barycentrics[1]);
  }
  out.push_back(candidate);
}

void BottomLevel::test_box(const Ray& ray, const Geometry& geometry, uint32_t primitive,
                           uint32_t instance, std::vector<Candidate>& out) const {
  double enter, leave;
  if (!clip(ray, box_of(geometry, primitive), enter, leave) || leave < 0) return;
  Candidate candidate;
  candidate.t = std::max(enter, 0.0);
  candidate.leave = leave;
  candidate.instance = instance;
  candidate.geometry = geometry.shape.index;
  candidate.primitive = primitive;
  candidate.slot = geometry.slot;
  candidate.number = primitive;
  candidate.procedural = true;
  candidate.geometry_opaque = geometry.shape.opaque;
  out.push_back(candidate);
}

void TopLevel::find(const shader::RayDesc& ray, std::vector<Candidate>& out) const {
  out.clear();
  Ray world;
  for (int i = 0; i < 3; ++i) {
    world.origin[i] = ray.origin[i];
    world.direction[i] = ray.direction[i];
  }
  bvh_.visit(world, [&](uint32_t index) {
    const Instance& instance = instances_[index];
    const auto& m = instance.inverse;
    Ray object;
    for (int r = 0; r < 3; ++r) {
      object.origin[r] = m[r * 4] * world.origin[0] + m[r * 4 + 1] * world.origin[1] +
                         m[r * 4 + 2] * world.origin[2] + m[r * 4 + 3];
      object.direction[r] = m[r * 4] * world.direction[0] + m[r * 4 + 1] * world.direction[1] +
                            m[r * 4 + 2] * world.direction[2];
    }
    instance.bottom_level->find(object, index, out);
  });
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.t, a.instance, a.slot, a.number) <
           std::tie(b.t, b.instance, b.slot, b.number);
  });
}

std::shared_ptr<const BottomLevel> Scenes::bottom_level(uint64_t address) {
  const auto structure = address == 0 ? nullptr : backend_.find_structure(address);
  if (structure == nullptr || structure->bottom_level == nullptr ||
      structure->bottom_level->empty()) {
    return nullptr;
  }
  auto& made = bottom_levels_[structure->bottom_level.get()];
  if (made == nullptr)
    made = std::make_shared<BottomLevel>(structure->bottom_level, structure->flags);
  return made;
}

const TopLevel* Scenes::find(uint64_t address) {
  if (const auto it = top_levels_.find(address); it != top_levels_.end()) return it->second.get();
  const auto structure = address == 0 ? nullptr : backend_.find_structure(address);
  auto& level = top_levels_[address];
  if (structure == nullptr || structure->top_level == nullptr) return nullptr;
  level = std::make_unique<TopLevel>();
  std::vector<Box> boxes;
  const auto add = [&](const rtapi::RaytracingInstanceDesc& desc, uint32_t id) {
    Instance& instance = level->instances_.emplace_back();
    instance.desc = desc;
    instance.id = id;
    std::memcpy(instance.object_to_world.data(), desc.Transform, sizeof desc.Transform);
    Box box;
    if (is_finite(instance.object_to_world.data(), 12) &&
        runtime::invert_transform(instance.object_to_world.data(), instance.world_to_object.rows) &&
        invert(instance.object_to_world, instance.inverse)) {
      instance.bottom_level = bottom_level(desc.AccelerationStructure);
      if (instance.bottom_level != nullptr) {
        instance.world_to_object.positions = shader::table_of(instance.bottom_level->positions());
        box = transformed(instance.bottom_level->bounds(), instance.object_to_world);
      }
    }
    boxes.push_back(box);
  };
  runtime::for_each_instance(*structure, add);
  level->bvh_.build(std::move(boxes));
  return level.get();
}

}  // namespace kaamos::explain
