// SPDX-License-Identifier: MIT
#include "rtapi/src/pipelines/hit_attributes.h"

#include <vector>

namespace rtapi::detail {

namespace {

using shader::Stage;

bool ignores_attributes(const Subject& s) {
  return (s.code->flags & shader::kExportIgnoresAttributes) != 0;
}

}  // namespace

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::kPixel:
      return "pixel";
    case Stage::kVertex:
      return "vertex";
    case Stage::kGeometry:
      return "geometry";
    case Stage::kCompute:
      return "compute";
    case Stage::kLibrary:
      return "library function";
    case Stage::kRayGeneration:
      return "ray generation";
    case Stage::kIntersection:
      return "intersection";
    case Stage::kAnyHit:
      return "any-hit";
    case Stage::kClosestHit:
      return "closest-hit";
    case Stage::kMiss:
      return "miss";
    case Stage::kCallable:
      return "callable";
  }
  return "unknown";
}

std::string describe(const Subject& s) {
  return s.is_group() ? concat("hit group ", in_quotes(s.name))
                      : concat(stage_name(s.code->stage), " shader ", in_quotes(s.name));
}

// A shader that reads no attributes may declare any in a procedural group, as with the drivers of
// native devices: often it is one that serves triangles, too.
Status check_attributes(const DeviceImpl& device, const Subject& group) {
  const bool triangles = group.group.Type == HitGroupType::kTriangles;
  const Subject* first = nullptr;
  std::vector<const Subject*> unread;
  for (const SubjectPtr& m : group.members) {
    if (!m || m->code->attribute_bytes == 0) continue;
    if (triangles && m->code->attribute_bytes != 8) {
      return make_error(Id::kAttributesDisagree, describe(group), ": ", describe(*m), " takes ",
                        m->code->attribute_bytes,
                        " bytes of attributes, but triangles pass "
                        "BuiltInTriangleIntersectionAttributes (8 bytes)");
    }
    if (!triangles && ignores_attributes(*m)) {
      unread.push_back(m.get());
      continue;
    }
    if (first && first->code->attribute_bytes != m->code->attribute_bytes) {
      return make_error(Id::kAttributesDisagree, describe(group), ": ", describe(*first), " has ",
                        first->code->attribute_bytes, " bytes of attributes, but ", describe(*m),
                        " has ", m->code->attribute_bytes);
    }
    first = m.get();
  }
  // One that has an identifier was checked with the state object that it comes from.
  if (!first || group.identifier) return {};
  for (const Subject* m : unread) {
    if (m->code->attribute_bytes == first->code->attribute_bytes) continue;
    device.report(
        MessageSeverity::kWarning,
        make_error(Id::kAttributesUnread, describe(group), ": ", describe(*m), " declares ",
                   m->code->attribute_bytes, " bytes of attributes and reads none of them, and ",
                   describe(*first), " has ", first->code->attribute_bytes,
                   "; DXR wants one type in a hit group"));
  }
  return {};
}

}  // namespace rtapi::detail
