// SPDX-License-Identifier: MIT
//
// Writes explanations of draws as text and as JSON.
#include <rtapi/explain_draw.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "rtapi/src/explain/address_text.h"
#include "runtime/explain/values.h"

namespace rtapi {

using namespace detail;

namespace {

using Json = nlohmann::ordered_json;
using kaamos::explain::number_text;

const char* outcome_name(TriangleOutcome outcome) {
  switch (outcome) {
    case TriangleOutcome::kWritten:
      return "written";
    case TriangleOutcome::kCulledByFace:
      return "culled";
    case TriangleOutcome::kFailedDepth:
      return "failed the depth test";
    case TriangleOutcome::kDiscarded:
      return "discarded";
    case TriangleOutcome::kFailedStencil:
      return "failed the stencil test";
  }
  return "";
}

const char* func_name(ComparisonFunc func) {
  constexpr const char* kNames[] = {"?",       "NEVER",     "LESS",          "EQUAL", "LESS_EQUAL",
                                    "GREATER", "NOT_EQUAL", "GREATER_EQUAL", "ALWAYS"};
  const auto number = static_cast<uint32_t>(func);
  return number < std::size(kNames) ? kNames[number] : kNames[0];
}

std::string depth_text(const ExplainedTriangle& t) {
  if (!t.DepthTested) {
    return concat("z ", number_text(t.Z),
                  t.DepthWritten ? ", stored without a test" : ", not tested");
  }
  return concat("z ", number_text(t.Z), "; depth ", number_text(t.TestedDepth), " ",
                func_name(t.DepthFunc), " ", number_text(t.StoredDepth),
                t.TestedLate ? " after the pixel shader" : " before the pixel shader", ": ",
                t.DepthPassed ? "passed" : "failed", t.DepthWritten ? ", stored" : "");
}

// JSON has no infinity and no NaN, so they are written as text.
Json depth_number(float value) {
  if (std::isfinite(value)) return value;
  return number_text(value);
}

}  // namespace

std::string ToText(const DrawPixelExplanation& e) {
  std::string out =
      concat("pixel (", e.X, ", ", e.Y, ") of slice ", e.Slice, " of ", e.Width, " x ", e.Height,
             " on ", e.Backend, "\n", e.Draws, e.Draws == 1 ? " draw" : " draws");
  if (e.DrawsLeftOut != 0)
    out += concat(", ", e.DrawsLeftOut, " left out: targets of another size");
  out += e.Triangles.empty() ? std::string("; no triangle covers the pixel\n")
                             : concat("; ", e.Triangles.size(),
                                      e.Triangles.size() == 1 ? " triangle" : " triangles",
                                      " in the order of drawing:\n");
  for (const ExplainedTriangle& t : e.Triangles) {
    out += concat("  draw ", t.Draw, " (", t.Command, "), ", in_quotes(t.Pipeline), ": instance ",
                  t.InstanceID, ", triangle ", t.PrimitiveID,
                  t.FrontFace ? ", front face: " : ", back face: ", outcome_name(t.Outcome), "\n");
    out += concat("    weights ", number_text(t.Weights[0]), " ", number_text(t.Weights[1]), " ",
                  number_text(t.Weights[2]), "\n");
    if (t.Outcome == TriangleOutcome::kCulledByFace) continue;
    if (t.StencilTested) {
      out += concat("    stencil ", uint32_t{t.StoredStencil},
                    t.TestedLate ? " after the pixel shader: " : " before the pixel shader: ",
                    t.StencilPassed ? "passed" : "failed", "\n");
    }
    out += concat("    ", depth_text(t), "\n");
    if (!t.PixelShader.empty()) {
      out += concat("    pixel ", in_quotes(t.PixelShader),
                    t.Outcome == TriangleOutcome::kDiscarded ? " discarded it" : ":");
      for (size_t i = 0; i < t.Outputs.size(); ++i) {
        out += concat(i == 0 ? " " : ", ", t.Outputs[i].Name, " = ", t.Outputs[i].Text);
      }
      out += "\n";
    }
    for (const ExplainedTexel& texel : t.Texels) {
      out += concat("    target ", texel.Slot, ": ", texel.Before, " -> ", texel.After, "\n");
    }
  }
  return out;
}

std::string ToJson(const DrawPixelExplanation& e) {
  Json triangles = Json::array();
  for (const ExplainedTriangle& t : e.Triangles) {
    Json json = {{"draw", t.Draw},
                 {"command", t.Command},
                 {"pipeline", t.Pipeline},
                 {"instance", t.InstanceID},
                 {"primitive", t.PrimitiveID},
                 {"front_face", t.FrontFace},
                 {"weights", Json::array({t.Weights[0], t.Weights[1], t.Weights[2]})},
                 {"z", depth_number(t.Z)}};
    if (t.StencilTested) {
      json["stencil_test"] = {
          {"late", t.TestedLate}, {"stored", t.StoredStencil}, {"passed", t.StencilPassed}};
    }
    if (t.DepthTested) {
      json["depth_test"] = {{"late", t.TestedLate},
                            {"func", func_name(t.DepthFunc)},
                            {"tested", depth_number(t.TestedDepth)},
                            {"stored", depth_number(t.StoredDepth)},
                            {"passed", t.DepthPassed}};
    }
    json["depth_written"] = t.DepthWritten;
    if (!t.PixelShader.empty()) {
      json["pixel_shader"] = t.PixelShader;
      Json outputs = Json::array();
      for (const ExplainedValue& value : t.Outputs) {
        outputs.push_back({{"name", value.Name}, {"type", value.Type}, {"value", value.Text}});
      }
      json["outputs"] = std::move(outputs);
    }
    Json texels = Json::array();
    for (const ExplainedTexel& texel : t.Texels) {
      texels.push_back({{"slot", texel.Slot}, {"before", texel.Before}, {"after", texel.After}});
    }
    json["texels"] = std::move(texels);
    json["outcome"] = outcome_name(t.Outcome);
    triangles.push_back(std::move(json));
  }
  const Json json = {{"pixel", Json::array({e.X, e.Y})},
                     {"slice", e.Slice},
                     {"size", Json::array({e.Width, e.Height})},
                     {"backend", e.Backend},
                     {"draws", e.Draws},
                     {"draws_left_out", e.DrawsLeftOut},
                     {"triangles", std::move(triangles)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rtapi
