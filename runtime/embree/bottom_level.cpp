// SPDX-License-Identifier: MIT
#include "runtime/embree/bottom_level.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "runtime/backend/errors.h"
#include "runtime/embree/instance_node.h"
#include "runtime/embree/parallel.h"
#include "runtime/structures/build_inputs.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::embree {
namespace {

using rtapi::HasAny;
using rtapi::RaytracingGeometryDesc;
using rtapi::RaytracingGeometryType;

const char* text_of(RTCError error) {
  switch (error) {
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "unsupported CPU";
    case RTC_ERROR_CANCELLED:
      return "cancelled";
    default:
      return "unknown error";
  }
}

// The error, if any, that Embree has stored since the last call.
rtapi::Status embree_status(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  return runtime::make_error(
      runtime::Id::kBuildFailed,
      error == RTC_ERROR_OUT_OF_MEMORY ? rtapi::ErrorCode::kOutOfMemory : rtapi::ErrorCode::kFailed,
      std::string("Embree reports ") + text_of(error) + " for a bottom level (" + what + ").");
}

RTCSceneFlags scene_flags(BuildFlags flags, bool robust) {
  int bits = shim::kSceneFlagQueryFilter;
  if (robust) bits |= RTC_SCENE_FLAG_ROBUST;
  if (HasAny(flags, BuildFlags::kAllowUpdate)) bits |= RTC_SCENE_FLAG_DYNAMIC;
  if (HasAny(flags, BuildFlags::kMinimizeMemory)) bits |= RTC_SCENE_FLAG_COMPACT;
  return static_cast<RTCSceneFlags>(bits);
}

// HIGH is never used: with ROBUST it equals MEDIUM, and its spatial splits would call an any-hit
// shader twice for one triangle.
RTCBuildQuality geometry_quality(BuildFlags flags) {
  return HasAny(flags, BuildFlags::kPreferFastBuild) ? RTC_BUILD_QUALITY_LOW
                                                     : RTC_BUILD_QUALITY_MEDIUM;
}
RTCBuildQuality scene_quality(BuildFlags flags) {
  // LOW selects the two-level builder, the only one that can refit.
  return HasAny(flags, BuildFlags::kPreferFastBuild | BuildFlags::kAllowUpdate)
             ? RTC_BUILD_QUALITY_LOW
             : RTC_BUILD_QUALITY_MEDIUM;
}

uint32_t class_of(const GeometryInfo& info) {
  if (info.linkage != nullptr) return kTriangleMicromap;
  if (info.type == RaytracingGeometryType::kTriangles) {
    return info.opaque ? kTriangleOpaque : kTriangleNonOpaque;
  }
  return info.opaque ? kProceduralOpaque : kProceduralNonOpaque;
}

void bounds_of_box(const RTCBoundsFunctionArguments* arguments) {
  const BuilderCallback callback;
  const auto& info = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
  const PaddedBox& box = info.padded[arguments->primID];
  alignas(16) float lower[4];
  alignas(16) float upper[4];
  _mm_store_ps(lower, box.lower);
  _mm_store_ps(upper, box.upper);
  *arguments->bounds_o = {lower[0], lower[1], lower[2], 0, upper[0], upper[1], upper[2], 0};
}

std::unique_ptr<GeometryInfo> describe(const RaytracingGeometryDesc& desc, uint32_t index,
                                       Linkages linkages) {
  auto info = std::make_unique<GeometryInfo>();
  static_cast<runtime::GeometryShape&>(*info) = runtime::shape_of(desc, index);
  info->slot = index;
  if (index < linkages.size()) info->linkage = linkages[index];
  info->linked = info->linkage != nullptr;
  return info;
}

// A geometry of triangles whose buffers are to be filled; null if Embree has no memory for it.
struct TriangleBuffers {
  RTCGeometry geometry = nullptr;
  float* vertices = nullptr;    // 3 for each
  uint32_t* indices = nullptr;  // 3 for each triangle
};
TriangleBuffers new_triangles(RTCDevice device, const GeometryInfo& info) {
  TriangleBuffers result;
  result.geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (result.geometry == nullptr) return result;
  result.vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      result.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, info.vertices));
  result.indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      result.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, info.primitives));
  if (result.vertices != nullptr && result.indices != nullptr) return result;
  rtcReleaseGeometry(result.geometry);
  return {};
}

void copy_boxes(const rtapi::RaytracingGeometryAabbsDesc& desc, GeometryInfo& info) {
  info.boxes.resize(desc.AABBCount);
  info.padded.resize(desc.AABBCount);
  for (uint64_t i = 0; i < desc.AABBCount; ++i) {
    info.boxes[i] = runtime::aabb_at(desc, i);
    info.padded[i] = PaddedBox::of(info.boxes[i]);
  }
}

bool in_embree_range(const float* values, uint64_t count) {
  bool inside = true;
  for (uint64_t i = 0; i < count; ++i) inside &= std::fabs(values[i]) < runtime::kLargestCoordinate;
  return inside;
}

}  // namespace

// Any-hit shaders see each triangle that a ray hits, so where they may run, shared edges count.
bool BuildContext::is_exact(std::span<const RaytracingGeometryDesc> geometries,
                            Linkages linkages) const {
  if (exact != Exact::kNonOpaque) return exact == Exact::kAll;
  const bool linked = std::any_of(linkages.begin(), linkages.end(),
                                  [](const auto& linkage) { return linkage != nullptr; });
  if (linked) return true;
  return std::any_of(geometries.begin(), geometries.end(), [](const RaytracingGeometryDesc& desc) {
    return desc.Type == RaytracingGeometryType::kTriangles &&
           !HasAny(desc.Flags, rtapi::RaytracingGeometryFlags::kOpaque);
  });
}

bool BuildContext::is_exact(std::span<const runtime::ClusteredGeometry> geometries) const {
  if (exact != Exact::kNonOpaque) return exact == Exact::kAll;
  return std::any_of(geometries.begin(), geometries.end(), [](const auto& geometry) {
    return geometry.linkage != nullptr ||
           !HasAny(geometry.flags, rtapi::RaytracingGeometryFlags::kOpaque);
  });
}

BottomLevel::~BottomLevel() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::build(
    const BuildContext& context, std::span<const RaytracingGeometryDesc> geometries,
    BuildFlags flags, Linkages linkages, std::span<const runtime::GeometryShape> shapes) {
  std::shared_ptr<BottomLevel> level(new BottomLevel);
  level->flags_ = flags;
  level->exact_ = context.is_exact(geometries, linkages);
  if (auto s = level->create_scene(context); !s) return s.error();
  if (auto s = level->add_geometries(context, geometries, linkages, nullptr); !s) return s.error();
  if (auto s = level->commit(context); !s) return s.error();
  for (size_t i = 0; i < shapes.size(); ++i) {
    static_cast<runtime::GeometryShape&>(*level->geometries_[i]) = shapes[i];
  }
  level->keep_positions();
  return level;
}

rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::updated_copy(
    const BuildContext& context, std::span<const RaytracingGeometryDesc> geometries,
    Linkages linkages) const {
  std::shared_ptr<BottomLevel> level(new BottomLevel);
  level->flags_ = flags_;
  level->exact_ = exact_;
  if (auto s = level->create_scene(context); !s) return s.error();
  if (auto s = level->add_geometries(context, geometries, linkages, this); !s) return s.error();
  if (auto s = level->commit(context); !s) return s.error();
  level->keep_positions();
  return level;
}

rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::build_clustered(
    const BuildContext& context, std::vector<runtime::ClusteredGeometry> geometries,
    BuildFlags flags) {
  std::shared_ptr<BottomLevel> level(new BottomLevel);
  level->flags_ = flags & ~BuildFlags::kAllowUpdate;
  level->exact_ = context.is_exact(geometries);
  level->clusters_.set(geometries);
  if (auto s = level->create_scene(context); !s) return s.error();
  for (runtime::ClusteredGeometry& geometry : geometries) {
    if (auto s = level->add_clusters(context, geometry); !s) return s.error();
  }
  if (auto s = level->commit(context); !s) return s.error();
  level->keep_positions();
  return level;
}

void BottomLevel::keep_positions() {
  positions_ = runtime::positions_of(*this, flags_);
  clusters_.refer_to(positions_);
}

rtapi::Status BottomLevel::create_scene(const BuildContext& context) {
  rtcGetDeviceError(context.device);  // clears an earlier build's error
  scene_ = rtcNewScene(context.device);
  if (scene_ == nullptr) return embree_status(context.device, "new scene");
  rtcSetSceneBuildQuality(scene_, scene_quality(flags_));
  return {};
}

rtapi::Status BottomLevel::add_geometries(const BuildContext& context,
                                          std::span<const RaytracingGeometryDesc> geometries,
                                          Linkages linkages, const BottomLevel* indices_of) {
  for (uint32_t i = 0; i < geometries.size(); ++i) {
    const RaytracingGeometryDesc& desc = geometries[i];
    if (auto s = runtime::check_primitive_count(desc, i); !s) return s;
    auto info = describe(desc, i, linkages);
    if (desc.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
      procedural_ = true;
      if (auto s = add_boxes(context, desc.AABBs, std::move(info)); !s) return s;
      continue;
    }
    if (exact_) {
      GeometryInfo* user = geometries_.emplace_back(std::move(info)).get();
      const auto* built = indices_of != nullptr ? indices_of->geometries_[i]->exact.get() : nullptr;
      add_exact_triangles(desc.Triangles, user, built != nullptr ? &built->indices : nullptr);
      continue;
    }
    const uint32_t* indices = nullptr;
    if (indices_of != nullptr && info->primitives != 0 && info->vertices != 0) {
      indices = static_cast<const uint32_t*>(rtcGetGeometryBufferData(
          rtcGetGeometry(indices_of->scene_, i), RTC_BUFFER_TYPE_INDEX, 0));
    }
    if (auto s = add_triangles(context, desc.Triangles, std::move(info), indices); !s) return s;
  }
  return {};
}

rtapi::Status BottomLevel::add_triangles(const BuildContext& context,
                                         const rtapi::RaytracingGeometryTrianglesDesc& desc,
                                         std::unique_ptr<GeometryInfo> info,
                                         const uint32_t* indices) {
  GeometryInfo* user = geometries_.emplace_back(std::move(info)).get();
  // An empty geometry keeps its GeometryIndex but needs no Embree geometry.
  if (user->primitives == 0 || user->vertices == 0) return {};
  const TriangleBuffers to = new_triangles(context.device, *user);
  if (to.geometry == nullptr) return embree_status(context.device, "buffers");
  runtime::decode_vertices(desc, to.vertices);
  if (indices != nullptr) {
    std::memcpy(to.indices, indices, uint64_t{user->primitives} * 12);
  } else {
    out_of_range_triangles_ += runtime::decode_indices(desc, to.indices);
  }
  attach_triangles(to.geometry, *user);
  return embree_status(context.device, "triangles");
}

// Gives the scene a geometry whose buffers are filled.
void BottomLevel::attach_triangles(RTCGeometry geometry, GeometryInfo& info) {
  rtcSetGeometryBuildQuality(geometry, geometry_quality(flags_));
  rtcSetGeometryMask(geometry, class_of(info));
  rtcSetGeometryUserData(geometry, &info);
  if (!info.opaque || info.linkage != nullptr) {
    rtcSetGeometryIntersectFilterFunction(geometry, filter_triangle);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_triangle);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, info.slot);
  rtcReleaseGeometry(geometry);
}

rtapi::Status BottomLevel::add_clusters(const BuildContext& context,
                                        runtime::ClusteredGeometry& geometry) {
  GeometryInfo& info = *geometries_.emplace_back(std::make_unique<GeometryInfo>());
  static_cast<runtime::GeometryShape&>(info) = runtime::shape_of(geometry);
  info.slot = static_cast<uint32_t>(geometries_.size() - 1);
  info.linkage = std::move(geometry.linkage);
  if (info.primitives == 0 || info.vertices == 0) return {};
  if (exact_) {
    info.exact = std::make_unique<ExactTriangles>();
    info.exact->frame = &exact_frame_;
    info.exact->vertices = std::move(geometry.xyz);
    info.exact->indices = std::move(geometry.indices);
    return {};
  }
  const TriangleBuffers to = new_triangles(context.device, info);
  if (to.geometry == nullptr) return embree_status(context.device, "buffers");
  std::copy(geometry.xyz.begin(), geometry.xyz.end(), to.vertices);
  std::copy(geometry.indices.begin(), geometry.indices.end(), to.indices);
  attach_triangles(to.geometry, info);
  return embree_status(context.device, "clusters");
}

void BottomLevel::add_exact_triangles(const rtapi::RaytracingGeometryTrianglesDesc& desc,
                                      GeometryInfo* user, const std::vector<uint32_t>* indices) {
  if (user->primitives == 0 || user->vertices == 0) return;
  user->exact = std::make_unique<ExactTriangles>();
  user->exact->frame = &exact_frame_;
  user->exact->vertices.resize(3 * uint64_t{user->vertices});
  runtime::decode_vertices(desc, user->exact->vertices.data());
  if (indices != nullptr) {
    user->exact->indices = *indices;
  } else {
    user->exact->indices.resize(3 * uint64_t{user->primitives});
    out_of_range_triangles_ += runtime::decode_indices(desc, user->exact->indices.data());
  }
}

// Makes the packs, their Embree geometries, the frame around all of them, and the bounds of the
// level. The bounds of Embree's scene are relative to the frame.
rtapi::Status BottomLevel::pack_exact_triangles(const BuildContext& context) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low[3] = {kInfinity, kInfinity, kInfinity};
  float high[3] = {-kInfinity, -kInfinity, -kInfinity};
  const RTCBuildQuality quality = geometry_quality(flags_);
  for (const auto& info : geometries_) {
    if (info->exact != nullptr) info->exact->pack(context.device, quality, low, high);
  }
  if (auto s = embree_status(context.device, "packs"); !s) return s;
  empty_ = low[0] > high[0];
  bounds_ = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
  const double lower[3] = {low[0], low[1], low[2]};
  const double upper[3] = {high[0], high[1], high[2]};
  exact_frame_ = ExactFrame::of(lower, upper);
  for (const auto& info : geometries_) {
    if (info->exact == nullptr) continue;
    if (std::exchange(info->exact->attached, false)) rtcDetachGeometry(scene_, info->slot);
    if (auto s = attach_packs(context, *info); !s) return s;
  }
  return {};
}

rtapi::Status BottomLevel::attach_packs(const BuildContext& context, GeometryInfo& info) {
  if (info.exact->packs.empty()) return {};
  RTCGeometry geometry = rtcNewGeometry(context.device, RTC_GEOMETRY_TYPE_USER);
  if (geometry == nullptr) return embree_status(context.device, "new geometry");
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<uint32_t>(info.exact->packs.size()));
  rtcSetGeometryUserData(geometry, &info);
  rtcSetGeometryBoundsFunction(geometry, bounds_of_exact_pack, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_exact_pack);
  rtcSetGeometryOccludedFunction(geometry, occlude_exact_pack);
  rtcSetGeometryBuildQuality(geometry, geometry_quality(flags_));
  rtcSetGeometryMask(geometry, class_of(info));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, info.slot);
  info.exact->attached = true;
  rtcReleaseGeometry(geometry);
  return embree_status(context.device, "triangles");
}

rtapi::Status BottomLevel::add_boxes(const BuildContext& context,
                                     const rtapi::RaytracingGeometryAabbsDesc& desc,
                                     std::unique_ptr<GeometryInfo> info) {
  GeometryInfo* user = geometries_.emplace_back(std::move(info)).get();
  if (user->primitives == 0) return {};
  copy_boxes(desc, *user);
  RTCGeometry geometry = rtcNewGeometry(context.device, RTC_GEOMETRY_TYPE_USER);
  if (geometry == nullptr) return embree_status(context.device, "new geometry");
  rtcSetGeometryUserPrimitiveCount(geometry, user->primitives);
  rtcSetGeometryUserData(geometry, user);
  rtcSetGeometryBoundsFunction(geometry, bounds_of_box, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_procedural);
  rtcSetGeometryOccludedFunction(geometry, occlude_procedural);
  rtcSetGeometryBuildQuality(geometry, geometry_quality(flags_));
  rtcSetGeometryMask(geometry, class_of(*user));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, user->slot);
  rtcReleaseGeometry(geometry);
  return embree_status(context.device, "boxes");
}

// Embree tests the boxes of nodes. Only trees that are built once, in full quality, have a leaf for
// each primitive, and a tree of a single leaf has no node.
bool BottomLevel::tests_each_box() const {
  if (scene_quality(flags_) != RTC_BUILD_QUALITY_MEDIUM) return false;
  size_t active = 0;
  for (const auto& info : geometries_) {
    active += static_cast<size_t>(std::count_if(info->padded.begin(), info->padded.end(),
                                                [](const PaddedBox& box) { return box.active(); }));
  }
  return active > 1;
}

rtapi::Status BottomLevel::commit(const BuildContext& context) {
  const bool own_bounds = exact();
  if (own_bounds) {
    if (auto s = pack_exact_triangles(context); !s) return s;
  }
  // The boxes of packs are padded enough for the faster traversal.
  rtcSetSceneFlags(scene_, scene_flags(flags_, context.robust && !own_bounds));
  {
    const BuilderRun run;
    rtcCommitScene(scene_);
  }
  if (auto s = embree_status(context.device, "commit"); !s) return s;
  if (own_bounds) return {};
  if (procedural_) {
    const bool tested = tests_each_box();
    for (const auto& info : geometries_) info->tested_by_embree = tested;
  }
  rtcGetSceneBounds(scene_, &bounds_);
  empty_ = !(bounds_.lower_x <= bounds_.upper_x && bounds_.lower_y <= bounds_.upper_y &&
             bounds_.lower_z <= bounds_.upper_z);
  return {};
}

runtime::Bounds BottomLevel::object_bounds() const {
  return {{bounds_.lower_x, bounds_.lower_y, bounds_.lower_z},
          {bounds_.upper_x, bounds_.upper_y, bounds_.upper_z}};
}

rtapi::Status BottomLevel::check_update(std::span<const RaytracingGeometryDesc> geometries,
                                        BuildFlags flags, const std::vector<bool>& linked) const {
  return runtime::check_update(geometry_shapes(), flags_, geometries, flags, linked);
}

std::vector<runtime::GeometryShape> BottomLevel::geometry_shapes() const {
  std::vector<runtime::GeometryShape> shapes;
  shapes.reserve(geometries_.size());
  for (const auto& info : geometries_) shapes.push_back(*info);
  return shapes;
}

runtime::GeometryContents BottomLevel::geometry_contents(uint32_t geometry) const {
  const GeometryInfo& info = *geometries_[geometry];
  runtime::GeometryContents contents;
  contents.boxes = info.boxes;
  contents.linkage = info.linkage.get();
  if (info.type != RaytracingGeometryType::kTriangles || info.primitives == 0 ||
      info.vertices == 0) {
    return contents;
  }
  if (info.exact != nullptr) {
    contents.xyz = info.exact->vertices;
    contents.indices = info.exact->indices;
    return contents;
  }
  RTCGeometry handle = rtcGetGeometry(scene_, geometry);
  contents.xyz = {
      static_cast<const float*>(rtcGetGeometryBufferData(handle, RTC_BUFFER_TYPE_VERTEX, 0)),
      3 * size_t{info.vertices}};
  contents.indices = {
      static_cast<const uint32_t*>(rtcGetGeometryBufferData(handle, RTC_BUFFER_TYPE_INDEX, 0)),
      3 * size_t{info.primitives}};
  return contents;
}

std::shared_ptr<const BottomLevel> BottomLevel::exact_twin(const BuildContext& context) const {
  const std::lock_guard lock(twin_mutex_);
  if (twin_ != nullptr) return twin_;
  std::shared_ptr<BottomLevel> twin(new BottomLevel);
  twin->exact_ = true;
  twin->flags_ = flags_ & ~BuildFlags::kAllowUpdate;
  if (!twin->create_scene(context)) return nullptr;
  for (uint32_t i = 0; i < geometries_.size(); ++i) {
    GeometryInfo& info = *twin->geometries_.emplace_back(std::make_unique<GeometryInfo>());
    static_cast<runtime::GeometryShape&>(info) = *geometries_[i];
    info.slot = i;
    info.linkage = geometries_[i]->linkage;
    const runtime::GeometryContents contents = geometry_contents(i);
    if (contents.indices.empty()) continue;
    info.exact = std::make_unique<ExactTriangles>();
    info.exact->frame = &twin->exact_frame_;
    info.exact->vertices.assign(contents.xyz.begin(), contents.xyz.end());
    info.exact->indices.assign(contents.indices.begin(), contents.indices.end());
  }
  if (!twin->commit(context)) return nullptr;
  twin_ = std::move(twin);
  return twin_;
}

rtapi::Status BottomLevel::update(const BuildContext& context,
                                  std::span<const RaytracingGeometryDesc> geometries,
                                  Linkages linkages) {
  twin_ = nullptr;
  rtcGetDeviceError(context.device);
  for (uint32_t i = 0; i < geometries.size(); ++i) {
    GeometryInfo& info = *geometries_[i];
    if (i < linkages.size()) info.linkage = linkages[i];
    if (info.primitives == 0 || (!procedural_ && info.vertices == 0)) continue;
    if (info.exact != nullptr) {
      // Packed again, because triangles may become degenerate or stop being so.
      runtime::decode_vertices(geometries[i].Triangles, info.exact->vertices.data());
      continue;
    }
    RTCGeometry geometry = rtcGetGeometry(scene_, i);
    RTCBuildQuality quality = RTC_BUILD_QUALITY_REFIT;
    if (info.type == RaytracingGeometryType::kTriangles) {
      auto* vertices =
          static_cast<float*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
      const uint64_t count = 3 * uint64_t{info.vertices};
      // A refit would bring back nothing that the build dropped, and would keep what must be
      // dropped now.
      const bool was_inside = in_embree_range(vertices, count);
      runtime::decode_vertices(geometries[i].Triangles, vertices);
      if (!was_inside || !in_embree_range(vertices, count)) quality = geometry_quality(flags_);
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    } else {
      copy_boxes(geometries[i].AABBs, info);
      // Boxes may become inactive or active again; inactive ones are not in the tree.
      quality = geometry_quality(flags_);
    }
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
  }
  return commit(context);
}

}  // namespace kaamos::embree
