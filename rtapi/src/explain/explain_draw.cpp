// SPDX-License-Identifier: MIT
#include <rtapi/explain_draw.h>

#include <algorithm>
#include <bit>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/commands/command_queue_impl.h"
#include "rtapi/src/commands/execute_held.h"
#include "runtime/backend/draw_observation.h"
#include "runtime/backend/linked_graphics.h"
#include "runtime/explain/values.h"
#include "runtime/shader/texture/format_codec.h"

namespace rtapi {

using namespace detail;

namespace {

using kaamos::explain::number_text;
using runtime::PixelEvent;

// Executes `list` and notes its draws.
Status ExecuteObserved(const CommandQueue& queue, const CommandList& list, const char* call,
                       runtime::DrawObservation& observation) {
  if (Status s = prepare_explained(queue, list, call); !s.ok()) return s;
  DeviceImpl& device = *queue.impl()->device;
  return execute_held(device, *list.impl()->uses, [&]() -> Status {
    if (!device.backend->observe_draws(&observation)) {
      Error error = make_error(Id::kExplain, call, ": the ", device.backend->info().Name,
                               " backend does not rasterize by itself; use the embree backend");
      error.code = ErrorCode::kUnsupported;
      return error;
    }
    Status s = execute_commands(device, *list.impl()->commands);
    device.backend->observe_draws(nullptr);
    return s;
  });
}

std::string TexelText(Format format, const std::array<uint8_t, 16>& bytes) {
  const shader::Texel texel =
      shader::format_codec(static_cast<uint32_t>(format)).decode(bytes.data());
  const FormatInfo info = GetFormatInfo(format);
  std::string text;
  for (uint32_t c = 0; c < info.channels; ++c) {
    if (c != 0) text += " ";
    if (info.type == FormatClass::kUint) {
      text += concat(texel.bits[c]);
    } else if (info.type == FormatClass::kSint) {
      text += concat(static_cast<int32_t>(texel.bits[c]));
    } else {
      text += number_text(std::bit_cast<float>(texel.bits[c]));
    }
  }
  return text;
}

std::vector<ExplainedValue> Outputs(const runtime::LinkedGraphics& linked,
                                    const PixelEvent& event) {
  std::vector<ExplainedValue> out;
  const shader::GraphicsDesc& desc = linked.pixel_desc();
  for (uint32_t i = 0; i < desc.output_count; ++i) {
    const shader::SignatureElement& element = desc.outputs[i];
    ExplainedValue value;
    value.Name = element.system_value == shader::SystemValue::kTarget
                     ? concat("SV_Target", element.semantic_index)
                     : std::string(element.semantic);
    const bool is_float = element.type == shader::ColumnType::kFloat;
    const bool is_int = element.type == shader::ColumnType::kInt;
    value.Type = is_float ? "float" : is_int ? "int" : "uint";
    if (element.components > 1) value.Type += concat(uint32_t{element.components});
    for (uint32_t c = 0; c < element.components; ++c) {
      const uint32_t bits = event.outputs[element.first_column + c];
      if (c != 0) value.Text += " ";
      value.Text += is_float ? number_text(std::bit_cast<float>(bits))
                    : is_int ? concat(static_cast<int32_t>(bits))
                             : concat(bits);
    }
    out.push_back(std::move(value));
  }
  return out;
}

ExplainedTriangle Explain(const runtime::DrawObservation::LoggedDraw& draw,
                          const PixelEvent& event) {
  const runtime::LinkedGraphics& linked = *draw.linked;
  ExplainedTriangle out;
  out.Draw = event.draw;
  out.Command = draw.label;
  out.Pipeline = linked.name;
  out.InstanceID = event.instance;
  out.PrimitiveID = event.primitive_id;
  out.FrontFace = event.front_facing;
  std::copy(std::begin(event.weights), std::end(event.weights), out.Weights);
  out.Z = event.z;
  out.StencilTested = event.stencil_tested;
  out.StencilPassed = event.stencil_passed;
  out.StoredStencil = event.stored_stencil;
  out.DepthTested = event.tested;
  out.TestedLate = event.late;
  out.DepthFunc = linked.depth_stencil.DepthFunc;
  out.TestedDepth = event.tested_depth;
  out.StoredDepth = event.stored_depth;
  out.DepthPassed = event.passed;
  out.DepthWritten = event.writes_depth;
  if (event.shaded) {
    out.PixelShader = linked.pixel.name;
    if (!event.discarded) out.Outputs = Outputs(linked, event);
  }
  for (const runtime::TexelChange& change : event.texels) {
    out.Texels.push_back({change.slot, change.format, TexelText(change.format, change.before),
                          TexelText(change.format, change.after)});
  }
  out.Outcome = event.culled            ? TriangleOutcome::kCulledByFace
                : !event.stencil_passed ? TriangleOutcome::kFailedStencil
                : !event.passed         ? TriangleOutcome::kFailedDepth
                : event.discarded       ? TriangleOutcome::kDiscarded
                                        : TriangleOutcome::kWritten;
  return out;
}

}  // namespace

Result<DrawPixelExplanation> ExplainDrawPixel(const CommandQueue& queue, const CommandList& list,
                                              const ExplainDrawDesc& desc) {
  runtime::DrawObservation seen;
  seen.first_draw = desc.Draws.FirstDraw;
  seen.draw_count = desc.Draws.DrawCount;
  seen.logs_pixel = true;
  seen.log.x = desc.X;
  seen.log.y = desc.Y;
  seen.log.slice = desc.Draws.Slice;
  if (Status s = ExecuteObserved(queue, list, "ExplainDrawPixel", seen); !s.ok()) return s.error();
  if (seen.noted == 0) {
    return make_error(Id::kExplain, "none of draws ", desc.Draws.FirstDraw,
                      " and later was noted; the list has ", seen.next_draw, " draws, ",
                      seen.left_out, " of these without targets");
  }
  if (desc.X >= seen.width || desc.Y >= seen.height) {
    return make_error(Id::kExplain, "pixel (", desc.X, ", ", desc.Y,
                      ") is outside of the targets (", seen.width, " x ", seen.height, ")");
  }
  DrawPixelExplanation out;
  out.X = desc.X;
  out.Y = desc.Y;
  out.Slice = desc.Draws.Slice;
  out.Width = seen.width;
  out.Height = seen.height;
  out.Backend = queue.impl()->device->backend->info().Name;
  out.Draws = seen.noted;
  out.DrawsLeftOut = seen.left_out;
  for (const PixelEvent& event : seen.log.events) {
    out.Triangles.push_back(Explain(seen.logged.at(event.draw), event));
  }
  return out;
}

Result<OverdrawStatistics> CollectOverdraw(const CommandQueue& queue, const CommandList& list,
                                           const DrawRange& draws) {
  runtime::DrawObservation seen;
  seen.first_draw = draws.FirstDraw;
  seen.draw_count = draws.DrawCount;
  seen.counts_pixels = true;
  seen.map.slice = draws.Slice;
  if (Status s = ExecuteObserved(queue, list, "CollectOverdraw", seen); !s.ok()) return s.error();
  OverdrawStatistics out;
  out.Width = seen.width;
  out.Height = seen.height;
  out.Draws = seen.noted;
  out.DrawsLeftOut = seen.left_out;
  out.Pixels.reserve(seen.map.pixels.size());
  for (const runtime::PixelCounts& pixel : seen.map.pixels) {
    out.Pixels.push_back({pixel.covered, pixel.shaded, pixel.written});
  }
  return out;
}

}  // namespace rtapi
