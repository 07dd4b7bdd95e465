// SPDX-License-Identifier: MIT
#include "runtime/checks/draws.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/backend/backend.h"
#include "runtime/backend/linked_graphics.h"
#include "runtime/checks/names.h"
#include "runtime/checks/vertex_inputs.h"

namespace kaamos::checks {
namespace {

using runtime::DrawCounts;

constexpr size_t kMostSaid = 4096;
// A draw of as many vertices or instances is hardly meant.
constexpr uint32_t kAbsurd = 1u << 31;

std::string number(uint64_t value) {
  return std::to_string(value);
}
std::string counted(uint64_t count, const char* what) {
  return number(count) + " " + what + (count == 1 ? "" : "s");
}

std::string text_of(const rtapi::Viewport& v) {
  return "(" + float_name(v.TopLeftX) + ", " + float_name(v.TopLeftY) + ") + (" +
         float_name(v.Width) + ", " + float_name(v.Height) + ")";
}
std::string text_of(const rtapi::Rect& r) {
  return "(" + std::to_string(r.left) + ", " + std::to_string(r.top) + ") to (" +
         std::to_string(r.right) + ", " + std::to_string(r.bottom) + ")";
}

}  // namespace

void Draws::begin_list() {
  number_ = 0;
  drawn_.clear();
  targets_.begin_list();
}

void Draws::end_list() {
  for (const auto& [name, drawn] : drawn_) {
    if (drawn.arrived || drawn.silent == 0) continue;
    const std::string others = drawn.silent == 1 ? ""
                                                 : " Nothing of the list's other " +
                                                       counted(drawn.silent - 1, "draw") +
                                                       " with this pipeline arrives either.";
    report_once(drawn.id, name, drawn.cause, drawn.text + others + " (" + drawn.label + ")");
  }
  drawn_.clear();
}

void Draws::created(const runtime::LinkedGraphics& pipeline) {
  if (!pipeline.has_pixel()) return;
  const uint32_t flags = pipeline.pixel_desc().flags;
  if ((flags & shader::kGraphicsEarlyDepthStencil) == 0) return;
  const std::string who = "pipeline " + in_quotes(pipeline.name) + ": pixel shader " +
                          in_quotes(pipeline.pixel.name) + " has [earlydepthstencil] and ";
  if (pipeline.pixel_columns.depth != runtime::kNoColumn) {
    reporter_.report(Id::kEarlyDepth,
                     who +
                         "writes SV_Depth, which is ignored, as depth is tested and written "
                         "before the shader runs. Remove one of the two.");
  }
  const rtapi::DepthStencilDesc& depth = pipeline.depth_stencil;
  const bool stores_depth =
      depth.DepthEnable && depth.DepthWriteMask == rtapi::DepthWriteMask::kAll;
  if ((flags & shader::kGraphicsDiscards) != 0 && (stores_depth || changes_stencil(depth))) {
    reporter_.report(Id::kEarlyDepth,
                     who + "can discard, but " + (stores_depth ? "depth" : "stencil") +
                         " is written before it runs, also for pixels that it discards. Remove "
                         "the attribute, or set " +
                         (stores_depth ? "DepthWriteMask to kZero." : "operations to kKeep."));
  }
}

void Draws::check(const runtime::DrawCommand& command, const std::string& label) {
  who_ = "draw " + number(number_++) + ", pipeline " + in_quotes(command.linked->name);
  draws_nothing_ = false;
  label_ = label;
  targets_.check(command, who_, label);
  check_rectangles(command);
  check_vertex_inputs(addresses_, reporter_, command, who_);
  for (const runtime::LinkedShader* shader : command.linked->shaders()) {
    check_root_arguments(command, *shader);
  }
}

// [RAS-40, RAS-41, RAS-44]
void Draws::check_rectangles(const runtime::DrawCommand& command) {
  const runtime::DrawState& state = *command.state;
  const auto nothing = [&](const std::string& text) {
    draws_nothing_ = true;
    reporter_.report(Id::kDrawRectangles, who_ + " draws nothing: " + text);
  };
  if (state.viewport_count == 0) {
    return nothing("no viewport is set. Call RSSetViewports; a new list has none.");
  }
  if (state.scissor_count == 0) {
    return nothing(
        "no scissor rectangle is set, and D3D12's scissor test is always on. Call "
        "RSSetScissorRects; a new list has none.");
  }
  float width = 16384;
  float height = 16384;
  const auto take = [&](const runtime::TargetView& view) {
    if (view.texture == nullptr) return;
    width = std::min(width, static_cast<float>(view.width));
    height = std::min(height, static_cast<float>(view.height));
  };
  for (uint32_t i = 0; i < state.targets.color_count; ++i) take(state.targets.color[i]);
  take(state.targets.depth);
  const bool picks = command.linked->vertex_columns.viewport_array_index != runtime::kNoColumn;
  std::string first;
  for (uint32_t i = 0; i < (picks ? state.viewport_count : 1); ++i) {
    const rtapi::Viewport& v = state.viewports[i];
    const rtapi::Rect scissor = i < state.scissor_count ? state.scissors[i] : rtapi::Rect{};
    const float left = std::max(v.TopLeftX, static_cast<float>(scissor.left));
    const float right = std::min(v.TopLeftX + v.Width, static_cast<float>(scissor.right));
    const float top =
        std::max(std::min(v.TopLeftY, v.TopLeftY + v.Height), static_cast<float>(scissor.top));
    const float bottom =
        std::min(std::max(v.TopLeftY, v.TopLeftY + v.Height), static_cast<float>(scissor.bottom));
    const bool empty = v.Width <= 0 || v.Height == 0;
    const bool seen = std::max(left, 0.0f) < std::min(right, width) &&
                      std::max(top, 0.0f) < std::min(bottom, height);
    if (!empty && seen) return;
    if (!first.empty()) continue;
    if (empty) {
      first = "viewport " + number(i) + " is empty: " + text_of(v) + ".";
    } else if (scissor.left >= scissor.right || scissor.top >= scissor.bottom) {
      first = "scissor rectangle " + number(i) + " is empty: " + text_of(scissor) + ".";
    } else {
      first = "viewport " + text_of(v) + " and scissor rectangle " + text_of(scissor) +
              " have nothing in common with each other and with the targets (" + float_name(width) +
              " x " + float_name(height) + ").";
    }
  }
  nothing(first + " Set rectangles that overlap the targets.");
}

// Slots whose root parameter nobody has set under this signature.
void Draws::check_root_arguments(const runtime::DrawCommand& command,
                                 const runtime::LinkedShader& shader) {
  const runtime::RootBindings& bindings = command.bindings;
  if (bindings.argument_offsets == nullptr) return;
  const std::vector<uint32_t>& offsets = *bindings.argument_offsets;
  uint64_t told = 0;
  for (uint32_t i = 0; i < shader.slots.size(); ++i) {
    const shader::BindingSlot& slot = shader.slots[i];
    if (slot.source == shader::SlotSource::kUnbound || slot.local) continue;
    if (slot.source == shader::SlotSource::kStaticSampler) continue;
    for (uint32_t p = 0; p < offsets.size() && p < 64; ++p) {
      if (offsets[p] != slot.argument_offset) continue;
      if (((bindings.set_parameters | told) >> p & 1) != 0) continue;
      told |= uint64_t{1} << p;
      const bool changed = (bindings.forgotten_parameters >> p & 1) != 0;
      reporter_.report(
          Id::kRootArgumentUnset,
          who_ + ": root parameter " + number(p) + ", from which " + stage_name(shader.stage) +
              " shader " + in_quotes(shader.name) + " reads " +
              binding_name(shader.library->bindings[i]) + ", is not set" +
              (changed ? "; it was set before SetGraphicsRootSignature set another signature, "
                         "after which arguments are undefined. Set it again."
                       : " and reads as 0. Set it after SetGraphicsRootSignature."));
    }
  }
}

void Draws::check(const runtime::ExecuteIndirectCommand& command) {
  if (command.count != nullptr && command.count->host() != nullptr) {
    uint32_t count = 0;
    std::memcpy(&count, command.count->host() + command.count_offset, sizeof count);
    if (count > command.max_count) {
      reporter_.report(Id::kIndirectCount,
                       "the count buffer says " + number(count) + ", but MaxCommandCount is " +
                           number(command.max_count) + "; only so many commands run.");
    }
  }
  const runtime::IndirectLayout& layout = *command.layout;
  const bool draws = layout.work == runtime::IndirectWork::kDraw ||
                     layout.work == runtime::IndirectWork::kDrawIndexed;
  if (!draws || command.arguments->host() == nullptr) return;
  uint32_t commands = command.max_count;
  if (command.count != nullptr && command.count->host() != nullptr) {
    uint32_t count = 0;
    std::memcpy(&count, command.count->host() + command.count_offset, sizeof count);
    commands = std::min(commands, count);
  }
  for (uint32_t i = 0; i < commands; ++i) {
    uint32_t counts[2];
    std::memcpy(counts,
                command.arguments->host() + command.arguments_offset +
                    uint64_t{i} * layout.stride_bytes + layout.work_offset,
                sizeof counts);
    if (counts[0] < kAbsurd && counts[1] < kAbsurd) continue;
    reporter_.report(Id::kIndirectArguments,
                     "command " + number(i) + " draws " + number(counts[0]) + " vertices" +
                         " and " + counted(counts[1], "instance") +
                         ", which is hardly meant. Was the buffer written, and are the arguments "
                         "in the order of the command signature?");
  }
}

void Draws::drawn(const runtime::DrawCommand& command, const DrawCounts& counts) {
  report_positions(counts);
  report_outputs(command, counts);
  if (!draws_nothing_) report_nothing_drawn(command, counts);
}

void Draws::report_positions(const DrawCounts& counts) {
  if (counts.not_finite != 0) {
    reporter_.report(Id::kPositionNotFinite,
                     who_ + ": " + number(counts.not_finite) + " of " + number(counts.vertices) +
                         " vertices" + " have NaN or Inf in SV_Position (first: SV_VertexID " +
                         number(counts.first_not_finite) + "); " +
                         counted(counts.not_a_triangle, "triangle") +
                         " with such vertices are dropped. Look for a division by zero or a "
                         "vertex that was never written.");
  }
  if (counts.far_away != 0) {
    reporter_.report(
        Id::kPositionFarAway,
        who_ + ": " + number(counts.far_away) + " of " + number(counts.vertices) + " vertices" +
            " are more than 1e7 times as far from the centre of the screen as its "
            "border (first: SV_VertexID " +
            number(counts.first_far_away) +
            "); some drivers lose pixels of such triangles. Is w meant to be so small?");
  }
}

void Draws::report_outputs(const runtime::DrawCommand& command, const DrawCounts& counts) {
  const auto report = [&](const runtime::OddOutputs& odd, const std::string& what,
                          const std::string& effect) {
    if (odd.not_a_number + odd.infinite == 0) return;
    std::string kinds = odd.not_a_number != 0 ? "NaN at " + counted(odd.not_a_number, "pixel") : "";
    if (odd.infinite != 0) {
      kinds +=
          (kinds.empty() ? "" : " and ") + std::string("Inf at ") + counted(odd.infinite, "pixel");
    }
    reporter_.report(Id::kOutputNotANumber,
                     who_ + ": pixel shader " + in_quotes(command.linked->pixel.name) + " gave " +
                         what + " " + kinds + " (one of them: (" + number(odd.first.x) + ", " +
                         number(odd.first.y) + "), triangle " + number(odd.first.primitive_id) +
                         ")" + effect +
                         ". Look for a division by zero, a normalize of a "
                         "zero vector or a value that was never written.");
  };
  for (uint32_t i = 0; i < rtapi::kSimultaneousRenderTargetCount; ++i) {
    const rtapi::FormatClass type =
        rtapi::GetFormatInfo(command.state->targets.color[i].format).type;
    const bool normalized =
        type == rtapi::FormatClass::kUnorm || type == rtapi::FormatClass::kSnorm;
    report(counts.targets[i], "SV_Target" + number(i),
           normalized ? "; the target stores 0 there" : "");
  }
  report(counts.depth, "SV_Depth", "; it passes no comparison but NOT_EQUAL and ALWAYS");
}

void Draws::report_once(Id id, const std::string& pipeline, const char* cause,
                        const std::string& text) {
  if (said_.size() >= kMostSaid) said_.clear();
  if (said_.insert(pipeline + "|" + cause).second) reporter_.report(id, text);
}

// [RAS-51, RAS-52]
void Draws::report_nothing_drawn(const runtime::DrawCommand& command, const DrawCounts& counts) {
  if (counts.triangles == 0) return;
  const runtime::LinkedGraphics& linked = *command.linked;
  Drawn& drawn = drawn_[linked.name];
  if (counts.written != 0) {
    drawn.arrived = true;
    return;
  }
  const std::string all = "all " + counted(counts.triangles, "triangle");
  const auto tell = [&](Id id, const char* cause, const std::string& text) {
    if (drawn.silent++ > 0) return;
    drawn.id = id;
    drawn.cause = cause;
    drawn.text = who_ + " draws nothing: " + text;
    drawn.label = label_;
  };
  const rtapi::RasterizerDesc& raster = linked.rasterizer;
  if (counts.culled != 0 &&
      counts.culled + counts.zero_area + counts.no_pixel == counts.triangles) {
    const bool back = raster.CullMode == rtapi::CullMode::kBack;
    tell(Id::kNothingDrawn, "facing",
         all + " are culled by facing or have no pixel (" + number(counts.culled) +
             " by facing): CullMode is " + (back ? "kBack" : "kFront") + " and " +
             (raster.FrontCounterClockwise ? "counterclockwise" : "clockwise") +
             " triangles are front facing. Is FrontCounterClockwise right, and the order of the "
             "vertices?");
    return;
  }
  if (counts.zero_area == counts.triangles) {
    return tell(Id::kNothingDrawn, "area",
                all + " have no area on the screen. Are all positions the same, or all indices 0?");
  }
  if (counts.outside == counts.triangles) {
    return tell(Id::kNothingVisible, "outside",
                all + " are outside of what can be seen (-w to w in x and y" +
                    (raster.DepthClipEnable ? ", 0 to w in z" : "") +
                    "). Are the matrices set, and in the right order?");
  }
  if (counts.failed_stencil != 0 && counts.failed_stencil + counts.failed_depth == counts.covered) {
    drawn.arrived = true;  // hidden by other draws, which is what stencil is for
    return;
  }
  if (counts.covered != 0 && counts.failed_depth == counts.covered) {
    const runtime::TargetView& depth = command.state->targets.depth;
    const std::string cleared = targets_.only_cleared(depth);
    if (cleared.empty() || targets_.told_of_clear()) {  // hidden by other draws, or known
      drawn.arrived = true;
      return;
    }
    return tell(Id::kNothingDrawn, "depth",
                "all " + counted(counts.covered, "pixel") + " fail the depth test " +
                    comparison_name(linked.depth_stencil.DepthFunc) +
                    " against a depth buffer that " + cleared +
                    ". Is depth reversed in one place and not in another?");
  }
  if (counts.shaded != 0 && counts.discarded == counts.shaded) {
    return tell(Id::kNothingVisible, "discard",
                "pixel shader " + in_quotes(linked.pixel.name) + " discards all " +
                    counted(counts.shaded, "pixel") + ".");
  }
}

}  // namespace kaamos::checks
