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
  void Shader(const ExplainedShader& shader, int indent);

 private:
  void Line(int indent, const std::string& text) {
    out_ += std::string(2 * static_cast<size_t>(indent), ' ') + text + "\n";
  }
  void Call(const ExplainedCall& call, int indent);
  void TraceRay(const ExplainedCall& call, int indent);
  void Candidate(const ExplainedCandidate& candidate, int indent);

  std::string& out_;
};

std::string Values(const std::vector<ExplainedValue>& values) {
  std::string text;
  for (const ExplainedValue& value : values) {
    text += (text.empty() ? "" : ", ") + value.Name + " = " + value.Text;
  }
  return text;
}

std::string Vector(const float v[3]) {
  return "(" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + ")";
}

std::string Record(const ExplainedRecord& record) {
  std::string text = Text(record.Table, " record ", record.Index);
  if (!record.Arithmetic.empty()) text += " = " + record.Arithmetic;
  if (!record.Export.empty()) text += Text(", ", Quoted(record.Export));
  if (!record.Reason.empty()) text += Text(", nothing: ", record.Reason);
  return text;
}

void Writer::Shader(const ExplainedShader& shader, int indent) {
  std::string title = Text(StageName(shader.Stage), " ", Quoted(shader.Name));
  if (!shader.Result.empty()) title += ": " + shader.Result;
  Line(indent, title);
  Line(indent + 1, Record(shader.Record));
  if (!shader.Attributes.empty()) Line(indent + 1, "attributes: " + Values(shader.Attributes));
  const bool callable = shader.Stage == ShaderStage::kCallable;
  if (!shader.Before.empty() && !callable)
    Line(indent + 1, "payload before: " + Values(shader.Before));
  for (const ExplainedCall& call : shader.Calls) Call(call, indent + 1);
  if (!shader.After.empty() && !callable)
    Line(indent + 1, "payload after: " + Values(shader.After));
}

void Writer::Candidate(const ExplainedCandidate& c, int indent) {
  std::string text = Text("t ", number_text(c.T), ": instance ", c.InstanceIndex, " (ID ",
                          c.InstanceID, "), geometry ", c.GeometryIndex, ", ",
                          c.Procedural ? "box " : "triangle ", c.PrimitiveIndex);
  if (!c.Procedural) text += c.FrontFace ? ", front face" : ", back face";
  text += Text(": ", OutcomeName(c.Outcome));
  if (!c.Reason.empty()) text += Text(" (", c.Reason, ")");
  Line(indent, text);
  for (const ExplainedShader& shader : c.Shaders) Shader(shader, indent + 1);
}

void Writer::TraceRay(const ExplainedCall& call, int indent) {
  const bool query = call.Kind == ExplainedCallKind::kRayQuery;
  Line(indent, query ? std::string("RayQuery") : Text("TraceRay, depth ", call.Depth));
  Line(indent + 1, "scene: " + ToText(call.Scene));
  Line(indent + 1,
       Text("flags: ", kaamos::explain::ray_flags_text(static_cast<uint32_t>(call.Flags)),
            "; mask ", Hex(call.InstanceInclusionMask)));
  Line(indent + 1, Text("ray: origin ", Vector(call.Origin), ", direction ", Vector(call.Direction),
                        ", t ", number_text(call.TMin), " to ", number_text(call.TMax)));
  if (!query) {
    Line(indent + 1,
         Text("records: ray contribution ", call.RayContributionToHitGroupIndex,
              ", geometry multiplier ", call.MultiplierForGeometryContributionToHitGroupIndex,
              ", miss index ", call.MissShaderIndex));
  }
  if (!call.Before.empty()) Line(indent + 1, "payload before: " + Values(call.Before));
  const size_t count = call.Candidates.size() + call.CandidatesLeftOut;
  Line(indent + 1,
       count == 0 ? std::string("no candidates")
                  : Text(count, count == 1 ? " candidate" : " candidates", ", front to back:"));
  for (const ExplainedCandidate& candidate : call.Candidates) Candidate(candidate, indent + 2);
  if (call.CandidatesLeftOut != 0) Line(indent + 2, Text("and ", call.CandidatesLeftOut, " more"));
  Line(indent + 1, call.Hit ? Text("hit at t ", number_text(call.HitT)) : std::string("miss"));
  if (!call.Note.empty()) Line(indent + 1, "note: " + call.Note);
  for (const ExplainedShader& shader : call.Shaders) Shader(shader, indent + 1);
  if (!call.After.empty()) Line(indent + 1, "payload after: " + Values(call.After));
}

void Writer::Call(const ExplainedCall& call, int indent) {
  switch (call.Kind) {
    case ExplainedCallKind::kTraceRay:
    case ExplainedCallKind::kRayQuery:
      return TraceRay(call, indent);
    case ExplainedCallKind::kReportHit:
      Line(indent,
           Text("ReportHit, t ", number_text(call.HitT), ", kind ", call.HitKind, ": ", call.Note));
      for (const ExplainedShader& shader : call.Shaders) Shader(shader, indent + 1);
      return;
    case ExplainedCallKind::kCallShader:
      Line(indent, "CallShader");
      if (!call.Note.empty()) Line(indent + 1, "note: " + call.Note);
      if (!call.Before.empty()) Line(indent + 1, "data before: " + Values(call.Before));
      for (const ExplainedShader& shader : call.Shaders) Shader(shader, indent + 1);
      if (!call.After.empty()) Line(indent + 1, "data after: " + Values(call.After));
      return;
  }
}

}  // namespace

std::string ToText(const PixelExplanation& e) {
  std::string out = Text("pixel (", e.Index[0], ", ", e.Index[1], ", ", e.Index[2], ") of ",
                         e.Dimensions[0], " x ", e.Dimensions[1], " x ", e.Dimensions[2], " on ",
                         e.Backend, "\n", e.Executor, "\n");
  Writer writer(out);
  if (e.RayGeneration.empty()) out += "the ray generation record runs nothing\n";
  for (const ExplainedShader& shader : e.RayGeneration) writer.Shader(shader, 0);
  if (!e.Removal.empty()) out += Text("ended: ", e.Removal, "; the dispatch removes the device\n");
  return out;
}

}  // namespace rtapi
