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

Json to_json_value(const ExplainedShader& shader);

// JSON has no infinity and no NaN, so they are written as text.
Json number_json(float value) {
  if (std::isfinite(value)) return value;
  return kaamos::explain::number_text(value);
}

Json vector_json(const float v[3]) {
  return Json::array({number_json(v[0]), number_json(v[1]), number_json(v[2])});
}

Json to_json_value(const std::vector<ExplainedValue>& values) {
  Json json = Json::array();
  for (const ExplainedValue& value : values) {
    json.push_back({{"name", value.Name}, {"type", value.Type}, {"value", value.Text}});
  }
  return json;
}

Json to_json_value(const ExplainedRecord& record) {
  Json json = {{"table", record.Table},
               {"index", record.Index},
               {"arithmetic", record.Arithmetic},
               {"export", record.Export}};
  if (!record.Reason.empty()) json["reason"] = record.Reason;
  return json;
}

Json to_json_value(const std::vector<ExplainedShader>& shaders) {
  Json json = Json::array();
  for (const ExplainedShader& shader : shaders) json.push_back(to_json_value(shader));
  return json;
}

Json to_json_value(const ExplainedCandidate& c) {
  Json json = {{"t", number_json(c.T)},
               {"instance", c.InstanceIndex},
               {"instance_id", c.InstanceID},
               {"geometry", c.GeometryIndex},
               {"primitive", c.PrimitiveIndex},
               {"procedural", c.Procedural},
               {"opaque", c.Opaque},
               {"outcome", outcome_name(c.Outcome)},
               {"reason", c.Reason}};
  if (c.ClusterID != 0xFFFFFFFF) json["cluster"] = c.ClusterID;
  if (!c.Procedural) {
    json["front_face"] = c.FrontFace;
    json["barycentrics"] = {number_json(c.Barycentrics[0]), number_json(c.Barycentrics[1])};
  }
  if (!c.Record.Table.empty()) json["record"] = to_json_value(c.Record);
  if (!c.Shaders.empty()) json["shaders"] = to_json_value(c.Shaders);
  return json;
}

Json ray_json(const ExplainedCall& call) {
  Json json;
  json["scene"] = ToText(call.Scene);
  json["flags"] = static_cast<uint32_t>(call.Flags);
  json["flag_names"] = kaamos::explain::ray_flags_text(static_cast<uint32_t>(call.Flags));
  json["mask"] = call.InstanceInclusionMask;
  json["origin"] = vector_json(call.Origin);
  json["t_min"] = number_json(call.TMin);
  json["direction"] = vector_json(call.Direction);
  json["t_max"] = number_json(call.TMax);
  json["candidates"] = Json::array();
  for (const ExplainedCandidate& c : call.Candidates)
    json["candidates"].push_back(to_json_value(c));
  if (call.CandidatesLeftOut != 0) json["candidates_left_out"] = call.CandidatesLeftOut;
  json["hit"] = call.Hit;
  if (call.Hit) json["hit_t"] = number_json(call.HitT);
  return json;
}

Json to_json_value(const ExplainedCall& call) {
  Json json;
  switch (call.Kind) {
    case ExplainedCallKind::kTraceRay:
      json["call"] = "TraceRay";
      json["depth"] = call.Depth;
      json["ray_contribution"] = call.RayContributionToHitGroupIndex;
      json["geometry_multiplier"] = call.MultiplierForGeometryContributionToHitGroupIndex;
      json["miss_index"] = call.MissShaderIndex;
      json.update(ray_json(call));
      break;
    case ExplainedCallKind::kRayQuery:
      json["call"] = "RayQuery";
      json.update(ray_json(call));
      break;
    case ExplainedCallKind::kCallShader:
      json["call"] = "CallShader";
      break;
    case ExplainedCallKind::kInvoke:
      json["call"] = "Invoke";
      json["depth"] = call.Depth;
      break;
    case ExplainedCallKind::kReportHit:
      json["call"] = "ReportHit";
      json["t"] = number_json(call.HitT);
      json["hit_kind"] = call.HitKind;
      json["accepted"] = call.Hit;
      break;
  }
  if (!call.Note.empty()) json["note"] = call.Note;
  if (!call.Before.empty()) json["before"] = to_json_value(call.Before);
  json["shaders"] = to_json_value(call.Shaders);
  if (!call.After.empty()) json["after"] = to_json_value(call.After);
  return json;
}

Json to_json_value(const ExplainedShader& shader) {
  Json json = {{"name", shader.Name},
               {"stage", stage_name(shader.Stage)},
               {"record", to_json_value(shader.Record)}};
  if (!shader.Result.empty()) json["result"] = shader.Result;
  if (!shader.Attributes.empty()) json["attributes"] = to_json_value(shader.Attributes);
  if (!shader.Before.empty()) json["before"] = to_json_value(shader.Before);
  json["calls"] = Json::array();
  for (const ExplainedCall& call : shader.Calls) json["calls"].push_back(to_json_value(call));
  if (!shader.After.empty()) json["after"] = to_json_value(shader.After);
  return json;
}

}  // namespace

std::string ToJson(const PixelExplanation& e) {
  Json json = {{"index", e.Index},
               {"dimensions", e.Dimensions},
               {"backend", e.Backend},
               {"executor", e.Executor}};
  json["ray_generation"] = to_json_value(e.RayGeneration);
  if (!e.Removal.empty()) json["removal"] = e.Removal;
  // Names may contain bytes that are not UTF-8; replace them instead of throwing.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rtapi
