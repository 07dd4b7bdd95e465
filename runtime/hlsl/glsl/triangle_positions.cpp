// SPDX-License-Identifier: MIT
//
// TriangleObjectPositions and ClusterID. The driver's own position fetch ignores the geometry, so
// the backend keeps the positions (spirv_interface.h: position tables).
#include "kaamos/shader/triangle_positions.h"

#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

static_assert(shader::kHitPositionTable == 6 && shader::kLeastTriangleHitKind == 254);
static_assert(shader::spirv::kPositionsNotKept == 1);
static_assert(shader::spirv::kClusterTable == 6 && shader::spirv::kClusterHit == 2 &&
              shader::spirv::kClusterMask == 6);
static_assert(offsetof(shader::spirv::DispatchBlock, position_tables) == 632);

void GlslEmitter::declare_address() {
  generated("g_Address",
            "layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer "
            "g_Address { uint64_t v; };\n");
}

// The name of the function that gives the position table of a hit, by the driver's numbers of
// instance, geometry and primitive. Where no shader reads tables, that of the instance will do.
std::string GlslEmitter::position_table() {
  declare_address();
  if (reads_tables()) {
    declare_instance_entry();
    return generated("g_position_table",
                     "uvec2 g_position_table(uint instance, uint geometry, uint id) {\n"
                     "  uint64_t tables = g_Address(k_dispatch_address + 632UL).v;\n"
                     "  uint64_t table = g_Address(tables + uint64_t(instance) * 8UL).v;\n"
                     "  if ((table & 6UL) != 6UL) return unpackUint2x32(table);\n"
                     "  uint64_t words = table & ~7UL;\n"
                     "  uint at = g_Word(words + uint64_t(geometry) * 4UL).v + "
                     "((table & 1UL) != 0UL ? 2u : 10u) * id;\n"
                     "  return unpackUint2x32((words + uint64_t(at) * 4UL) | 2UL | "
                     "(table & 1UL));\n"
                     "}\n");
  }
  return generated("g_position_table",
                   "uvec2 g_position_table(uint instance) {\n"
                   "  uint64_t tables = g_Address(k_dispatch_address + 632UL).v;\n"
                   "  return unpackUint2x32(g_Address(tables + uint64_t(instance) * 8UL).v);\n"
                   "}\n");
}

// Whether shaders of the library may read position tables.
bool GlslEmitter::reads_tables() const {
  return module_.target.ends_with("_10");
}

// The arguments of position_table() for a ray query's candidate, or committed hit.
std::string GlslEmitter::query_table_arguments(bool committed) const {
  const std::string of = committed ? "EXT(q, true))" : "EXT(q, false))";
  std::string text = "uint(rayQueryGetIntersectionInstanceCustomIndex" + of;
  if (!reads_tables()) return text;
  for (const char* what : {"GeometryIndex", "PrimitiveIndex"}) {
    text += std::string(", uint(rayQueryGetIntersection") + what + of;
  }
  return text;
}

std::string GlslEmitter::cluster_id(const Expr& expr) {
  declare_instance_entry();
  const std::string name = generated("g_cluster_id",
                                     "uint g_cluster_id(uvec2 table) {\n"
                                     "  if ((table.x & 6u) != 2u) return 0xFFFFFFFFu;\n"
                                     "  return g_Word(packUint2x32(table) & ~3UL).v;\n}\n");
  return call(name, expr.operands);
}

std::string GlslEmitter::triangle_positions(const Expr& expr) {
  declare_instance_entry();
  const std::string result = type(expr.type);
  const bool checked = module_.check_access;
  const std::string missing =
      checked
          ? "k_tell(words == 0UL ? " + glsl::number(static_cast<uint32_t>(shader::kNoTriangle)) +
                " : " + glsl::number(static_cast<uint32_t>(shader::kNoDataAccess)) +
                ", site, 0u, 0u, uint64_t(geometry), uint64_t(primitive), 0UL, 0UL);\n    "
          : "";
  const std::string name = generated(
      "g_triangle_positions",
      result + " g_triangle_positions(uvec2 table, uint geometry, uint primitive" +
          (checked ? ", uint site" : "") +
          ") {\n"
          "  uint64_t words = packUint2x32(table);\n"
          "  if (words == 0UL || (words & 1UL) != 0UL) {\n    " +
          missing + "return " + zero(expr.type) +
          ";\n"
          "  }\n"
          "  uint64_t at;\n"
          "  if ((words & 6UL) == 2UL) at = (words & ~3UL) + 4UL;\n"
          "  else at = words + 4UL * (uint64_t(g_Word(words + 4UL * uint64_t(geometry)).v) + "
          "9UL * uint64_t(primitive));\n"
          "  vec3 p[3];\n"
          "  for (int i = 0; i < 9; ++i) p[i / 3][i % 3] = "
          "uintBitsToFloat(g_Word(at + 4UL * uint64_t(i)).v);\n"
          "  return " +
          result + "(vec3[3](p[0], p[1], p[2]));\n}\n");
  std::string text = call(name, expr.operands);
  if (!checked) return text;
  text.pop_back();
  return text + ", " + site(expr.location) + ")";
}

}  // namespace kaamos::hlsl
