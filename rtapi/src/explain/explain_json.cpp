// SPDX-License-Identifier: MIT
//
// Writes explanations as JSON: the same tree, with the names of explain.h.
#include <cmath>
#include <nlohmann/json.hpp>

#include "rtapi/src/explain/address_text.h"
#include "rtapi/src/explain/explain_names.h"
#include "runtime/explain/values.h"

namespace rtapi {

using namespace detail;

namespace {

using Json = nlohmann::ordered_json;

Json ToJsonValue(const ExplainedShader& shader);

// JSON has no infinity and no NaN, so they are written as text.
Json Number(float value) {
  if (std::isfinite(value)) return value;
  return kaamos::explain::number_text(value);
}

Json Vector(const float v[3]) {
  return Json::array({Number(v[0]), Number(v[1]), Number(v[2])});
}

Json ToJsonValue(const std::vector<ExplainedValue>& values) {
  Json json = Json::array();
  for (const ExplainedValue& value : values) {
    json.push_back({{"name", value.Name}, {"type", value.Type}, {"value", value.Text}});
  }
  return json;
}

Json ToJsonValue(const ExplainedRecord& record) {
  Json json = {{"table", record.Table},
               {"index", record.Index},
               {"arithmetic", record.Arithmetic},
               {"export", record.Export}};
  if (!record.Reason.empty()) json["reason"] = record.Reason;
  return json;
}

Json ToJsonValue(const std::vector<ExplainedShader>& shaders) {
  Json json = Json::array();
  for (const ExplainedShader& shader : shaders) json.push_back(ToJsonValue(shader));
  return json;
}

Json ToJsonValue(const ExplainedCandidate& c) {
  Json json = {{"t", Number(c.T)},
               {"instance", c.InstanceIndex},
               {"instance_id", c.InstanceID},
               {"geometry", c.GeometryIndex},
               {"primitive", c.PrimitiveIndex},
               {"procedural", c.Procedural},
               {"opaque", c.Opaque},
               {"outcome", OutcomeName(c.Outcome)},
               {"reason", c.Reason}};
  if (!c.Procedural) {
    json["front_face"] = c.FrontFace;
    json["barycentrics"] = {Number(c.Barycentrics[0]), Number(c.Barycentrics[1])};
  }
  if (!c.Record.Table.empty()) json["record"] = ToJsonValue(c.Record);
  if (!c.Shaders.empty()) json["shaders"] = ToJsonValue(c.Shaders);
  return json;
}

Json RayJson(const ExplainedCall& call) {
  Json json;
  json["scene"] = ToText(call.Scene);
  json["flags"] = static_cast<uint32_t>(call.Flags);
  json["flag_names"] = kaamos::explain::ray_flags_text(static_cast<uint32_t>(call.Flags));
  json["mask"] = call.InstanceInclusionMask;
  json["origin"] = Vector(call.Origin);
  json["t_min"] = Number(call.TMin);
  json["direction"] = Vector(call.Direction);
  json["t_max"] = Number(call.TMax);
  json["candidates"] = Json::array();
  for (const ExplainedCandidate& c : call.Candidates) json["candidates"].push_back(ToJsonValue(c));
  if (call.CandidatesLeftOut != 0) json["candidates_left_out"] = call.CandidatesLeftOut;
  json["hit"] = call.Hit;
  if (call.Hit) json["hit_t"] = Number(call.HitT);
  return json;
}

Json ToJsonValue(const ExplainedCall& call) {
  Json json;
  switch (call.Kind) {
    case ExplainedCallKind::kTraceRay:
      json["call"] = "TraceRay";
      json["depth"] = call.Depth;
      json["ray_contribution"] = call.RayContributionToHitGroupIndex;
      json["geometry_multiplier"] = call.MultiplierForGeometryContributionToHitGroupIndex;
      json["miss_index"] = call.MissShaderIndex;
      json.update(RayJson(call));
      break;
    case ExplainedCallKind::kRayQuery:
      json["call"] = "RayQuery";
      json.update(RayJson(call));
      break;
    case ExplainedCallKind::kCallShader:
      json["call"] = "CallShader";
      break;
    case ExplainedCallKind::kReportHit:
      json["call"] = "ReportHit";
      json["t"] = Number(call.HitT);
      json["hit_kind"] = call.HitKind;
      json["accepted"] = call.Hit;
      break;
  }
  if (!call.Note.empty()) json["note"] = call.Note;
  if (!call.Before.empty()) json["before"] = ToJsonValue(call.Before);
  json["shaders"] = ToJsonValue(call.Shaders);
  if (!call.After.empty()) json["after"] = ToJsonValue(call.After);
  return json;
}

Json ToJsonValue(const ExplainedShader& shader) {
  Json json = {{"name", shader.Name},
               {"stage", StageName(shader.Stage)},
               {"record", ToJsonValue(shader.Record)}};
  if (!shader.Result.empty()) json["result"] = shader.Result;
  if (!shader.Attributes.empty()) json["attributes"] = ToJsonValue(shader.Attributes);
  if (!shader.Before.empty()) json["before"] = ToJsonValue(shader.Before);
  json["calls"] = Json::array();
  for (const ExplainedCall& call : shader.Calls) json["calls"].push_back(ToJsonValue(call));
  if (!shader.After.empty()) json["after"] = ToJsonValue(shader.After);
  return json;
}

}  // namespace

std::string ToJson(const PixelExplanation& e) {
  Json json = {{"index", e.Index},
               {"dimensions", e.Dimensions},
               {"backend", e.Backend},
               {"executor", e.Executor}};
  json["ray_generation"] = ToJsonValue(e.RayGeneration);
  if (!e.Removal.empty()) json["removal"] = e.Removal;
  // Names may contain bytes that are not UTF-8; replace them instead of throwing.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rtapi
