// SPDX-License-Identifier: MIT
#include "runtime/checks/code_findings.h"

#include <bit>
#include <cstdio>
#include <iterator>
#include <optional>

#include <kaamos/shader/debugging.h>
#include <kaamos/shader/triangle_positions.h>

#include "runtime/backend/ray_flags.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using shader::CheckReport;
using shader::Finding;

std::string float_text(uint64_t bits) {
  char text[32];
  std::snprintf(text, sizeof text, "%g",
                static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits))));
  return text;
}
std::string text_of(uint64_t number) {
  return std::to_string(number);
}

// "shaders/leaf.hlsl:31"
std::string site_name(const shader::LibraryDesc& library, uint32_t site) {
  const uint32_t file = site >> 20;
  const uint32_t line = site & 0xFFFFFu;
  if (line == 0 || file >= library.file_count) return "";
  return std::string(library.files[file]) + ":" + std::to_string(line);
}

const char* kind_name(uint64_t kind) {
  constexpr const char* kNames[] = {
      "nothing",        "a constant buffer", "a raw buffer", "a structured buffer",
      "a typed buffer", "a texture",         "a sampler",    "an acceleration structure"};
  return kind < std::size(kNames) ? kNames[kind] : "an unknown kind";
}
// `access` as shader::checked::with_shape() makes it.
std::string descriptor_name(uint64_t kind, uint64_t access) {
  const bool has_access = kind >= 2 && kind <= 5;
  const auto shape = static_cast<uint32_t>(access >> 8);
  access &= 0xFF;
  return std::string(kind_name(kind)) + (shape != 0 ? " (" + texture_name(shape) + ")" : "") +
         (!has_access || access > 1 ? ""
          : access == 0             ? " to read (SRV)"
                                    : " to write (UAV)");
}

// The first of ERR-18's rules that `flags` break.
std::string flags_problem(uint32_t flags, bool query) {
  if (query) flags &= ~shader::kRayQueryAllowsMicromaps;
  if ((flags & ~runtime::kAllRayFlags) != 0) {
    return "bits " + hex(flags & ~runtime::kAllRayFlags) + " are not ray flags of this tier";
  }
  if (query && (flags & 8) != 0) {
    return "a RayQuery runs no closest-hit shader, so SKIP_CLOSEST_HIT_SHADER (0x8) is not allowed";
  }
  if (std::popcount(flags & 0xC3u) > 1) {
    return "only one of FORCE_OPAQUE, FORCE_NON_OPAQUE, CULL_OPAQUE and CULL_NON_OPAQUE is allowed";
  }
  if ((flags & 0x30u) == 0x30u) {
    return "CULL_BACK_FACING_TRIANGLES and CULL_FRONT_FACING_TRIANGLES cannot both be set";
  }
  return "SKIP_TRIANGLES cannot be combined with the facing culls or SKIP_PROCEDURAL_PRIMITIVES";
}

std::string ray_text(const CheckReport& r) {
  std::string out = "Origin (";
  const auto word = [&](int i) { return float_text(r.values[i / 2] >> (i % 2 * 32)); };
  out += word(0) + "," + word(1) + "," + word(2) + "), TMin " + word(3) + ", Direction (" +
         word(4) + "," + word(5) + "," + word(6) + "), TMax " + word(7);
  return out;
}

// The names of QueryValue in the IR.
std::string query_value_name(uint64_t value, bool committed) {
  constexpr const char* kNames[] = {"Type",
                                    "RayT",
                                    "InstanceIndex",
                                    "InstanceID",
                                    "InstanceContributionToHitGroupIndex",
                                    "GeometryIndex",
                                    "PrimitiveIndex",
                                    "ObjectRayOrigin",
                                    "ObjectRayDirection",
                                    "ObjectToWorld3x4",
                                    "ObjectToWorld4x3",
                                    "WorldToObject3x4",
                                    "WorldToObject4x3",
                                    "TriangleBarycentrics",
                                    "TriangleFrontFace",
                                    "ProceduralPrimitiveNonOpaque"};
  if (value >= std::size(kNames)) return "the commit";
  return std::string(committed ? "Committed" : "Candidate") + kNames[value] + "()";
}

std::string candidate_text(const CheckReport& r) {
  const std::string what = query_value_name(r.values[0], false);
  if (r.values[1] == 0) {
    return what + " has no candidate: Proceed() has not returned true, or has returned false since";
  }
  return what + " is for " + (r.values[3] == 0 ? "triangle" : "procedural") +
         " candidates, but this one is a " +
         (r.values[2] == 0 ? "triangle" : "procedural primitive") + ". Test CandidateType() first";
}

std::string committed_text(const CheckReport& r) {
  const std::string what = query_value_name(r.values[0], true);
  if (r.values[1] == 0) {
    return what + " was read without a hit: CommittedStatus() is COMMITTED_NOTHING. Test it first";
  }
  return what + " is for triangles, but the hit is procedural. Test CommittedStatus() first";
}

std::string access_text(const runtime::AddressMap& addresses, const CheckReport& r) {
  constexpr const char* kVerbs[] = {"reads ", "writes ", "changes "};
  return kVerbs[r.write < 3 ? r.write : 0] +
         range_name(addresses, r.values[0] + r.values[1], r.values[2]);
}

// Relative to the buffer that the root descriptor points into, though the bytes read may lie in
// another one.
std::string bounds_text(const runtime::AddressMap& addresses, const CheckReport& r) {
  constexpr const char* kVerbs[] = {"reads", "writes", "changes"};
  std::string text = kVerbs[r.write < 3 ? r.write : 0];
  const auto allocation = addresses.find(r.values[0]);
  if (!allocation) return access_text(addresses, r) + ". Was the buffer freed?";
  const uint64_t base = r.values[0] - allocation->address;
  const uint64_t first = base + r.values[1];
  text += " bytes " + text_of(first) + ".." + text_of(first + r.values[2]) + " of " +
          buffer_name(*allocation);
  if (base != 0) text += ", offset " + text_of(r.values[1]) + " from byte " + text_of(base);
  return text + (r.write == 0 ? "; it reads 0 here" : "; nothing is written here") +
         ". Check the index, and that the stride in the shader is that of the buffer";
}

// What only shader model 6.10 has; none for the other findings.
std::optional<Id> experimental_id(Finding finding) {
  if (finding == shader::kNoTriangle) return Id::kNoTriangle;
  if (finding == shader::kNoDataAccess) return Id::kNoDataAccess;
  if (finding == shader::kBreakWithoutDebugger) return Id::kDebugBreak;
  return std::nullopt;
}

std::string describe_experimental(const CheckReport& r) {
  if (r.finding == shader::kBreakWithoutDebugger) {
    return "DebugBreak: no debugger is attached that would stop here";
  }
  if (r.finding == shader::kNoTriangle) {
    return "TriangleObjectPositions of what is not the hit of a triangle; it reads 0";
  }
  return "TriangleObjectPositions of geometry " + text_of(r.values[0]) + ", primitive " +
         text_of(r.values[1]) + ", but the bottom level was built without kAllowDataAccess (0x100)";
}

Id id_of(const CheckReport& r) {
  if (const auto id = experimental_id(r.finding)) return *id;
  switch (r.finding) {
    case Finding::kOutOfBounds:
      return Id::kRootAccessOutOfBounds;
    case Finding::kNotAllocated:
      return Id::kRootAddress;
    case Finding::kMisaligned:
      return Id::kMisalignedAccess;
    case Finding::kOutsideBinding:
      return Id::kOutsideBinding;
    case Finding::kOutsideHeap:
      return Id::kOutsideHeap;
    case Finding::kWrongDescriptor:
      return Id::kWrongDescriptor;
    case Finding::kRayNotANumber:
      return Id::kRayNotANumber;
    case Finding::kRayInterval:
      return Id::kRayInterval;
    case Finding::kRayFlags:
      return Id::kRayFlags;
    case Finding::kQueryFlags:
      return Id::kQueryFlags;
    case Finding::kRecursion:
      return Id::kRecursionDepth;
    case Finding::kHitKind:
      return Id::kHitKind;
    case Finding::kNoCandidate:
      return Id::kQueryNoCandidate;
    case Finding::kNoCommittedHit:
      return Id::kQueryNoHit;
    case Finding::kCommitOutOfRange:
      return Id::kCommitOutOfRange;
    case Finding::kStaleView:
      return r.values[3] == 0 ? Id::kStaleView : Id::kResourceState;
    case Finding::kPayloadMismatch:
      return r.values[2] == 0 ? Id::kPayloadMismatch : Id::kCallableMismatch;
    default:
      return Id::kMoreFindings;
  }
}

std::string describe(const runtime::AddressMap& addresses, const CheckReport& r) {
  if (experimental_id(r.finding)) return describe_experimental(r);
  const uint64_t* v = r.values;
  switch (r.finding) {
    case Finding::kOutOfBounds:
      return bounds_text(addresses, r);
    case Finding::kNotAllocated:
      return "is set to " +
             (v[0] == 0 ? std::string("address 0")
                        : "address " + hex(v[0]) + ", which is in no live buffer") +
             ", but the shader accesses byte " + text_of(v[1]) +
             " from there. Was the root argument or the record written, and is the buffer alive?";
    case Finding::kMisaligned:
      return (v[2] == 0 ? "is set to " : "accesses byte " + text_of(v[1]) + " from ") +
             address_name(addresses, v[0]) + ": " + hex(v[0] + v[1]) + " is not a multiple of " +
             text_of(v[3]) +
             (v[2] == 0 ? ". Constant buffers start at multiples of 256"
                        : ". The low bits of the offset are ignored, or the access is slow; "
                          "align it");
    case Finding::kOutsideBinding:
      return "index " + text_of(v[0]) + " is past the end of " + text_of(v[1]) +
             " elements; it reads as a null descriptor";
    case Finding::kOutsideHeap:
      if (v[2] == 0) {
        return "index " + text_of(v[0]) + " is outside the heap of " + text_of(v[1]) +
               " descriptors; it reads as a null descriptor";
      }
      return "handle " + hex(v[0]) + " (the table starts at " + hex(v[3]) +
             ") is not in the heap that is set, which has " + text_of(v[1]) +
             " descriptors. Was the table set, and SetDescriptorHeaps called with its heap?";
    case Finding::kWrongDescriptor:
      return "the slot holds " + descriptor_name(v[0], v[1]) + ", but the shader declares " +
             descriptor_name(v[2], v[3]) +
             "; it reads as a null descriptor. Are the views in the order of the registers?";
    case Finding::kRayNotANumber:
      return ray_text(r) +
             "; the ray misses everything. Is a normal of length 0, or was it never written?";
    case Finding::kRayInterval:
      return ray_text(r) + "; TMin must be at least 0 and at most TMax";
    case Finding::kRayFlags:
      return "flags " + hex(v[0]) + ": " + flags_problem(static_cast<uint32_t>(v[0]), false);
    case Finding::kQueryFlags:
      return "flags " + hex(v[0]) + ": " + flags_problem(static_cast<uint32_t>(v[0]), true);
    case Finding::kRecursion:
      return "the caller is at depth " + text_of(v[0]) + ", but MaxTraceRecursionDepth is " +
             text_of(v[1]) + "; the device is removed. Raise it, or stop the recursion";
    case Finding::kHitKind:
      return "ReportHit with kind " + text_of(v[0]) +
             "; applications use 0 to 127, and 254 and 255 mean triangles";
    case Finding::kPayloadMismatch:
      return "the caller passes " + text_of(v[0]) + " bytes, but the shader's type has " +
             text_of(v[1]) + (v[0] == v[1] ? " with other scalars" : "") +
             ". Caller and shader must use the same type. Is this the record that was meant?";
    case Finding::kNoCandidate:
      return candidate_text(r);
    case Finding::kNoCommittedHit:
      return committed_text(r);
    case Finding::kCommitOutOfRange:
      return "t " + float_text(v[0]) + " is not between TMin " + float_text(v[1]) +
             " and the nearest hit so far " + float_text(v[2]) + "; the hit is dropped";
    case Finding::kStaleView:
      if (v[3] != 0)
        return "element " + text_of(v[2]) + " is a view of " + addresses.wrong_view(v[0]);
      return "element " + text_of(v[2]) + " is " + kind_name(v[1]) +
             (v[1] == 5 ? std::string() : ", at address " + hex(v[0])) +
             ", which has been freed; it reads as a null descriptor. Keep the resource alive, or "
             "write the slot again";
    default:
      return "an unknown kind of finding";
  }
}

std::string where(const CodePlace& place, const CheckReport& r) {
  std::string out;
  const runtime::LinkedShader* shader = place.shader;
  if (shader != nullptr) {
    out = std::string(stage_name(shader->stage)) + " " + in_quotes(shader->name);
  } else {
    out = "a shader";
  }
  const bool draws = shader != nullptr && (shader->stage == shader::Stage::kVertex ||
                                           shader->stage == shader::Stage::kGeometry ||
                                           shader->stage == shader::Stage::kPixel);
  if (place.tables != nullptr) {
    out += " at " + pixel_name(place.index, place.dimensions[2]);
  } else if (!draws) {
    out += " in thread group (" + text_of(place.index[0]) + "," + text_of(place.index[1]) + "," +
           text_of(place.index[2]) + ")";
  }
  if (shader != nullptr) {
    if (const std::string site = site_name(*shader->library, r.site); !site.empty()) {
      out += ", " + site;
    }
  }
  if (place.tables != nullptr && r.local_arguments > 32) {
    const std::string record = record_name(*place.tables, r.local_arguments - 32);
    if (!record.empty()) out += ", " + record;
  }
  if (shader != nullptr && r.binding != 0 && r.binding <= shader->library->binding_count) {
    out += ", parameter " + binding_name(shader->library->bindings[r.binding - 1]);
  }
  return out;
}

}  // namespace

void report_finding(Reporter& reporter, const runtime::AddressMap& addresses,
                    const CodePlace& place, const CheckReport& report, uint64_t count) {
  const uint64_t order =
      place.index[0] + uint64_t{place.dimensions[0]} *
                           (place.index[1] + uint64_t{place.dimensions[1]} * place.index[2]);
  uint64_t key = reinterpret_cast<uintptr_t>(place.shader);
  for (const uint64_t part :
       {uint64_t{report.site}, uint64_t{report.binding}, static_cast<uint64_t>(report.finding)}) {
    key = (key ^ part) * 0x9E3779B97F4A7C15u;
    key ^= key >> 29;
  }
  reporter.report(id_of(report), key, order,
                  [&] { return where(place, report) + ": " + describe(addresses, report); });
  if (count > 1) reporter.add_count(id_of(report), key, count - 1);
}

}  // namespace kaamos::checks
