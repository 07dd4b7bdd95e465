// SPDX-License-Identifier: MIT
//
// Writes explanations as text, indented by depth in the tree.
#include <rtapi/explain.h>

#include "rtapi/src/explain/address_text.h"
#include "rtapi/src/explain/explain_names.h"
#include "runtime/explain/values.h"

namespace rtapi {

using namespace detail;

namespace {

using kaamos::explain::number_text;

class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}
  void write_shader(const ExplainedShader& shader, int indent);

 private:
  void write_line(int indent, const std::string& text) {
    out_ += std::string(2 * static_cast<size_t>(indent), ' ') + text + "\n";
  }
  void write_call(const ExplainedCall& call, int indent);
  void write_trace_ray(const ExplainedCall& call, int indent);
  void write_plain_call(const ExplainedCall& call, const std::string& title,
                        const std::string& what, int indent);
  void write_candidate(const ExplainedCandidate& candidate, int indent);

  std::string& out_;
};

std::string values_text(const std::vector<ExplainedValue>& values) {
  std::string text;
  for (const ExplainedValue& value : values) {
    text += (text.empty() ? "" : ", ") + value.Name + " = " + value.Text;
  }
  return text;
}

std::string vector_text(const float v[3]) {
  return "(" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + ")";
}

std::string record_text(const ExplainedRecord& record) {
  std::string text = concat(record.Table, " record ", record.Index);
  if (!record.Arithmetic.empty()) text += " = " + record.Arithmetic;
  if (!record.Export.empty()) text += concat(", ", in_quotes(record.Export));
  if (!record.Reason.empty()) text += concat(", nothing: ", record.Reason);
  return text;
}

void Writer::write_shader(const ExplainedShader& shader, int indent) {
  std::string title = concat(stage_name(shader.Stage), " ", in_quotes(shader.Name));
  if (!shader.Result.empty()) title += ": " + shader.Result;
  write_line(indent, title);
  write_line(indent + 1, record_text(shader.Record));
  if (!shader.Attributes.empty())
    write_line(indent + 1, "attributes: " + values_text(shader.Attributes));
  const bool callable = shader.Stage == ShaderStage::kCallable;
  if (!shader.Before.empty() && !callable)
    write_line(indent + 1, "payload before: " + values_text(shader.Before));
  for (const ExplainedCall& call : shader.Calls) write_call(call, indent + 1);
  if (!shader.After.empty() && !callable)
    write_line(indent + 1, "payload after: " + values_text(shader.After));
}

void Writer::write_candidate(const ExplainedCandidate& c, int indent) {
  std::string text = concat("t ", number_text(c.T), ": instance ", c.InstanceIndex, " (ID ",
                            c.InstanceID, "), geometry ", c.GeometryIndex, ", ",
                            c.Procedural ? "box " : "triangle ", c.PrimitiveIndex);
  if (c.ClusterID != 0xFFFFFFFF) text += concat(" of cluster ", c.ClusterID);
  if (!c.Procedural) text += c.FrontFace ? ", front face" : ", back face";
  text += concat(": ", outcome_name(c.Outcome));
  if (!c.Reason.empty()) text += concat(" (", c.Reason, ")");
  write_line(indent, text);
  for (const ExplainedShader& shader : c.Shaders) write_shader(shader, indent + 1);
}

void Writer::write_trace_ray(const ExplainedCall& call, int indent) {
  const bool query = call.Kind == ExplainedCallKind::kRayQuery;
  write_line(indent, query ? std::string("RayQuery") : concat("TraceRay, depth ", call.Depth));
  write_line(indent + 1, "scene: " + ToText(call.Scene));
  write_line(indent + 1,
             concat("flags: ", kaamos::explain::ray_flags_text(static_cast<uint32_t>(call.Flags)),
                    "; mask ", hex(call.InstanceInclusionMask)));
  write_line(indent + 1, concat("ray: origin ", vector_text(call.Origin), ", direction ",
                                vector_text(call.Direction), ", t ", number_text(call.TMin), " to ",
                                number_text(call.TMax)));
  if (!query) {
    write_line(indent + 1, concat("records: ray contribution ", call.RayContributionToHitGroupIndex,
                                  ", geometry multiplier ",
                                  call.MultiplierForGeometryContributionToHitGroupIndex,
                                  ", miss index ", call.MissShaderIndex));
  }
  if (!call.Before.empty()) write_line(indent + 1, "payload before: " + values_text(call.Before));
  const size_t count = call.Candidates.size() + call.CandidatesLeftOut;
  write_line(indent + 1, count == 0 ? std::string("no candidates")
                                    : concat(count, count == 1 ? " candidate" : " candidates",
                                             ", front to back:"));
  for (const ExplainedCandidate& candidate : call.Candidates)
    write_candidate(candidate, indent + 2);
  if (call.CandidatesLeftOut != 0)
    write_line(indent + 2, concat("and ", call.CandidatesLeftOut, " more"));
  write_line(indent + 1,
             call.Hit ? concat("hit at t ", number_text(call.HitT)) : std::string("miss"));
  if (!call.Note.empty()) write_line(indent + 1, "note: " + call.Note);
  for (const ExplainedShader& shader : call.Shaders) write_shader(shader, indent + 1);
  if (!call.After.empty()) write_line(indent + 1, "payload after: " + values_text(call.After));
}

void Writer::write_plain_call(const ExplainedCall& call, const std::string& title,
                              const std::string& what, int indent) {
  write_line(indent, title);
  if (!call.Note.empty()) write_line(indent + 1, "note: " + call.Note);
  if (!call.Before.empty()) write_line(indent + 1, what + " before: " + values_text(call.Before));
  for (const ExplainedShader& shader : call.Shaders) write_shader(shader, indent + 1);
  if (!call.After.empty()) write_line(indent + 1, what + " after: " + values_text(call.After));
}

void Writer::write_call(const ExplainedCall& call, int indent) {
  switch (call.Kind) {
    case ExplainedCallKind::kTraceRay:
    case ExplainedCallKind::kRayQuery:
      return write_trace_ray(call, indent);
    case ExplainedCallKind::kReportHit:
      write_line(indent, concat("ReportHit, t ", number_text(call.HitT), ", kind ", call.HitKind,
                                ": ", call.Note));
      for (const ExplainedShader& shader : call.Shaders) write_shader(shader, indent + 1);
      return;
    case ExplainedCallKind::kCallShader:
      return write_plain_call(call, "CallShader", "data", indent);
    case ExplainedCallKind::kInvoke:
      return write_plain_call(call, concat("Invoke, depth ", call.Depth), "payload", indent);
  }
}

}  // namespace

std::string ToText(const PixelExplanation& e) {
  std::string out = concat("pixel (", e.Index[0], ", ", e.Index[1], ", ", e.Index[2], ") of ",
                           e.Dimensions[0], " x ", e.Dimensions[1], " x ", e.Dimensions[2], " on ",
                           e.Backend, "\n", e.Executor, "\n");
  Writer writer(out);
  if (e.RayGeneration.empty()) out += "the ray generation record runs nothing\n";
  for (const ExplainedShader& shader : e.RayGeneration) writer.write_shader(shader, 0);
  if (!e.Removal.empty())
    out += concat("ended: ", e.Removal, "; the dispatch removes the device\n");
  return out;
}

}  // namespace rtapi
