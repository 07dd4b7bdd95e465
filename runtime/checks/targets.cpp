// SPDX-License-Identifier: MIT
#include "runtime/checks/targets.h"

#include <algorithm>
#include <iterator>

#include "runtime/backend/linked_graphics.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using rtapi::ComparisonFunc;
using rtapi::ResourceStates;
using runtime::TargetView;

std::string slot_name(uint32_t slot) {
  return "render target " + std::to_string(slot);
}

bool reads_destination(const rtapi::RenderTargetBlendDesc& blend) {
  using rtapi::Blend;
  if (!blend.BlendEnable) return false;
  const auto uses = [](Blend factor) {
    return factor == Blend::kDestAlpha || factor == Blend::kInvDestAlpha ||
           factor == Blend::kDestColor || factor == Blend::kInvDestColor ||
           factor == Blend::kSrcAlphaSat;
  };
  return blend.DestBlend != Blend::kZero || blend.DestBlendAlpha != Blend::kZero ||
         uses(blend.SrcBlend) || uses(blend.SrcBlendAlpha);
}

// Whether the test depends on what is stored.
bool compares_stencil(const rtapi::DepthStencilOpDesc& face) {
  return face.StencilFunc != ComparisonFunc::kAlways && face.StencilFunc != ComparisonFunc::kNever;
}

}  // namespace

bool changes_stencil(const rtapi::DepthStencilDesc& desc) {
  const auto changes = [](const rtapi::DepthStencilOpDesc& face) {
    constexpr auto kKeep = rtapi::StencilOp::kKeep;
    return face.StencilWriteMask != 0 &&
           (face.StencilFailOp != kKeep || face.StencilDepthFailOp != kKeep ||
            face.StencilPassOp != kKeep);
  };
  return desc.StencilEnable && (changes(desc.FrontFace) || changes(desc.BackFace));
}

bool tests_depth(const runtime::DrawCommand& command) {
  return command.linked->depth_stencil.DepthEnable &&
         command.state->targets.depth.texture != nullptr;
}

bool writes_depth(const runtime::DrawCommand& command) {
  return tests_depth(command) &&
         command.linked->depth_stencil.DepthWriteMask == rtapi::DepthWriteMask::kAll &&
         !command.state->targets.depth.read_only_depth;
}

bool tests_stencil(const runtime::DrawCommand& command) {
  const TargetView& view = command.state->targets.depth;
  return command.linked->depth_stencil.StencilEnable && view.texture != nullptr &&
         rtapi::HasStencil(view.format);
}

bool writes_stencil(const runtime::DrawCommand& command) {
  if (!tests_stencil(command) || command.state->targets.depth.read_only_stencil) return false;
  return changes_stencil(command.linked->depth_stencil);
}

const char* comparison_name(ComparisonFunc func) {
  constexpr const char* kNames[] = {"?",       "NEVER",     "LESS",          "EQUAL", "LESS_EQUAL",
                                    "GREATER", "NOT_EQUAL", "GREATER_EQUAL", "ALWAYS"};
  const auto number = static_cast<uint32_t>(func);
  return number < std::size(kNames) ? kNames[number] : kNames[0];
}

void Targets::check(const runtime::DrawCommand& command, const std::string& who,
                    const std::string& label) {
  told_of_clear_ = false;
  check_formats(command, who);
  check_sizes(command, who);
  check_states(command, who, label);
  check_contents(command, who);
}

void Targets::check_formats(const runtime::DrawCommand& command, const std::string& who) {
  const runtime::LinkedGraphics& linked = *command.linked;
  const runtime::DrawTargets& targets = command.state->targets;
  for (uint32_t i = 0; i < std::min(targets.color_count, linked.target_count); ++i) {
    const TargetView& view = targets.color[i];
    const rtapi::Format expected = linked.target_formats[i];
    if (view.texture == nullptr || expected == rtapi::Format::kUnknown) continue;
    if (view.format == expected) continue;
    reporter_.report(Id::kTargetFormat,
                     who + ": " + slot_name(i) + " is " + states_.name_of(view.texture.get()) +
                         ", viewed as " + format_name(view.format) + ", but RTVFormats[" +
                         std::to_string(i) + "] of the pipeline is " + format_name(expected) +
                         ". Bind another view or make the pipeline with the view's format.");
  }
  const rtapi::DepthStencilDesc& depth = linked.depth_stencil;
  if (!depth.DepthEnable && !depth.StencilEnable) return;
  const TargetView& view = targets.depth;
  check_stencil_view(command, who);
  if (view.texture == nullptr) {
    const std::string enabled = depth.DepthEnable ? std::string("DepthEnable is true with ") +
                                                        comparison_name(depth.DepthFunc)
                                                  : "StencilEnable is true";
    reporter_.report(Id::kDepthNotBound,
                     who + ": " + enabled +
                         ", but OMSetRenderTargets bound no depth-stencil view, so that every "
                         "pixel passes. Bind one, or make a pipeline with " +
                         (depth.DepthEnable ? "DepthEnable" : "StencilEnable") + " false.");
  } else if (view.format != linked.depth_format) {
    reporter_.report(Id::kTargetFormat,
                     who + ": the depth buffer is " + states_.name_of(view.texture.get()) +
                         ", viewed as " + format_name(view.format) +
                         ", but DSVFormat of the pipeline is " + format_name(linked.depth_format) +
                         ". Bind another view or make the pipeline with the view's format.");
  } else if (depth.DepthEnable && view.read_only_depth &&
             depth.DepthWriteMask == rtapi::DepthWriteMask::kAll) {
    reporter_.report(Id::kReadOnlyDepth,
                     who + ": DepthWriteMask is kAll, but the depth-stencil view of " +
                         states_.name_of(view.texture.get()) +
                         " has kReadOnlyDepth, so that no depth is written. Set DepthWriteMask to "
                         "kZero, or bind a view without the flag.");
  }
}

void Targets::check_stencil_view(const runtime::DrawCommand& command, const std::string& who) {
  const rtapi::DepthStencilDesc& desc = command.linked->depth_stencil;
  const TargetView& view = command.state->targets.depth;
  if (!desc.StencilEnable || view.texture == nullptr) return;
  if (!rtapi::HasStencil(view.format)) {
    reporter_.report(Id::kDepthNotBound,
                     who + ": StencilEnable is true, but " + states_.name_of(view.texture.get()) +
                         ", viewed as " + format_name(view.format) +
                         ", has no stencil, so that every pixel passes. Take "
                         "D24_UNORM_S8_UINT or D32_FLOAT_S8X24_UINT, or make a pipeline with "
                         "StencilEnable false.");
  } else if (view.read_only_stencil && changes_stencil(desc)) {
    reporter_.report(Id::kReadOnlyDepth,
                     who +
                         ": stencil operations are not all kKeep, but the depth-stencil view of " +
                         states_.name_of(view.texture.get()) +
                         " has kReadOnlyStencil, so that no stencil is written. Set the "
                         "operations to kKeep, or bind a view without the flag.");
  }
}

void Targets::check_sizes(const runtime::DrawCommand& command, const std::string& who) {
  const runtime::DrawTargets& targets = command.state->targets;
  const TargetView* first = nullptr;
  std::string first_name;
  const auto compare = [&](const TargetView& view, const std::string& name) {
    if (view.texture == nullptr) return true;
    if (first == nullptr) {
      first = &view;
      first_name = name;
      return true;
    }
    if (view.width == first->width && view.height == first->height) return true;
    const auto size = [](const TargetView& of) {
      return std::to_string(of.width) + " x " + std::to_string(of.height);
    };
    reporter_.report(Id::kTargetSizes,
                     who + ": " + first_name + " is " + size(*first) + " texels and " + name + " " +
                         size(view) +
                         "; only what both have in common is drawn to. Bind targets of one size.");
    return false;
  };
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    if (!compare(targets.color[i], slot_name(i))) return;
  }
  compare(targets.depth, "the depth buffer");
}

void Targets::use(const TargetView& view, ResourceStates wanted, const std::string& what,
                  const std::string& label, uint32_t plane) {
  const bool before = bound_before_.count(view.texture.get()) != 0;
  // It was in the right state then.
  states_.use(view.texture.get(), subresources_of(view, plane), wanted, what, label,
              before ? Id::kTargetStateChanged : Id::kResourceState,
              before ? " Earlier draws of this list wrote to it; bind other targets before it "
                       "changes its state."
                     : "");
}

void Targets::check_states(const runtime::DrawCommand& command, const std::string& who,
                           const std::string& label) {
  const runtime::DrawTargets& targets = command.state->targets;
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    if (targets.color[i].texture == nullptr) continue;
    use(targets.color[i], ResourceStates::kRenderTarget, who + ": " + slot_name(i), label);
  }
  const TargetView& view = targets.depth;
  const auto check_plane = [&](uint32_t plane, bool tests, bool writes, const std::string& name) {
    if (!tests) return;
    if (writes) {
      use(view, ResourceStates::kDepthWrite, who + ": " + name, label, plane);
    } else if (!states_.is_in(view.texture.get(), subresources_of(view, plane),
                              ResourceStates::kDepthWrite)) {
      use(view, ResourceStates::kDepthRead, who + ": " + name + ", which is only tested,", label,
          plane);
    }
  };
  check_plane(0, tests_depth(command), writes_depth(command), "the depth buffer");
  check_plane(1, tests_stencil(command), writes_stencil(command), "the depth buffer's stencil");
}

bool Targets::was_written(const TargetView& view) const {
  const auto it = written_.find(view.texture.get());
  return it != written_.end() && !it->second.expired();
}

void Targets::check_contents(const runtime::DrawCommand& command, const std::string& who) {
  const runtime::LinkedGraphics& linked = *command.linked;
  const runtime::DrawTargets& targets = command.state->targets;
  const auto never = [&](const TargetView& view, const std::string& what) {
    reporter_.report(Id::kTargetNeverWritten,
                     who + ": " + what + " " + states_.name_of(view.texture.get()) +
                         ", which nothing has written since it was created; D3D12 leaves its "
                         "texels undefined, here they are 0. Clear it first.");
    written(view.texture);
  };
  for (uint32_t i = 0; i < std::min(targets.color_count, linked.target_count); ++i) {
    const TargetView& view = targets.color[i];
    if (view.texture == nullptr || !linked.has_pixel()) continue;
    if (linked.pixel_columns.targets[i].first_column == runtime::kNoColumn) continue;
    if (!reads_destination(linked.blend[i]) || was_written(view)) continue;
    never(view, "blending reads " + slot_name(i));
  }
  const rtapi::DepthStencilDesc& desc = linked.depth_stencil;
  if (tests_stencil(command) &&
      (compares_stencil(desc.FrontFace) || compares_stencil(desc.BackFace)) &&
      !was_written(targets.depth)) {
    never(targets.depth, "the stencil test reads");
  }
  if (!tests_depth(command)) return;
  const ComparisonFunc func = linked.depth_stencil.DepthFunc;
  if (func == ComparisonFunc::kAlways || func == ComparisonFunc::kNever) return;
  if (!was_written(targets.depth)) return never(targets.depth, "the depth test reads");
  const auto clear =
      cleared_.find({targets.depth.texture.get(), targets.depth.mip, targets.depth.first_slice});
  if (clear == cleared_.end() || clear->second.texture.expired()) return;
  const float depth = clear->second.depth;
  const bool greater = func == ComparisonFunc::kGreater || func == ComparisonFunc::kGreaterEqual;
  const bool less = func == ComparisonFunc::kLess || func == ComparisonFunc::kLessEqual;
  if (!(greater && depth >= 1) && !(less && depth <= 0)) return;
  told_of_clear_ = true;
  reporter_.report(Id::kClearDepth,
                   who + ": the depth test is " + comparison_name(func) + ", but " +
                       states_.name_of(targets.depth.texture.get()) + " was cleared to " +
                       (greater ? "1" : "0") + " in " + clear->second.by +
                       ", so that nothing can be nearer. " +
                       (greater ? "Clear to 0 for reversed depth, or use LESS."
                                : "Clear to 1, or use GREATER for reversed depth."));
}

void Targets::check(const runtime::ClearTargetCommand& command, const std::string& label) {
  const TargetView& view = command.view;
  if (view.texture == nullptr) return;
  if (!command.depth_stencil || command.clear_depth) {
    states_.use(view.texture.get(), subresources_of(view),
                command.depth_stencil ? ResourceStates::kDepthWrite : ResourceStates::kRenderTarget,
                "the view to clear", label);
  }
  if (command.depth_stencil && command.clear_stencil && rtapi::HasStencil(view.format)) {
    states_.use(view.texture.get(), subresources_of(view, 1), ResourceStates::kDepthWrite,
                "the view to clear", label);
  }
  const auto best = states_.optimized_clear(view.texture.get());
  if (!best) return;
  std::string given;
  std::string expected;
  if (command.depth_stencil) {
    if (!command.clear_depth || best->Depth == command.depth) return;
    given = float_name(command.depth);
    expected = float_name(best->Depth);
  } else {
    if (std::equal(std::begin(command.color), std::end(command.color), std::begin(best->Color))) {
      return;
    }
    for (int i = 0; i < 4; ++i) {
      given += (i == 0 ? "" : " ") + float_name(command.color[i]);
      expected += (i == 0 ? "" : " ") + float_name(best->Color[i]);
    }
  }
  reporter_.report(Id::kClearValueDiffers,
                   states_.name_of(view.texture.get()) + " is cleared to " + given +
                       ", but its OptimizedClearValue is " + expected +
                       "; that is legal, and slower on many GPUs. Use one value for both.");
}

void Targets::note(const runtime::DrawCommand& command) {
  const runtime::DrawTargets& targets = command.state->targets;
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    const TargetView& view = targets.color[i];
    if (view.texture == nullptr) continue;
    written(view.texture);
    bound_before_.insert(view.texture.get());
  }
  if (!tests_depth(command) && !tests_stencil(command)) return;
  bound_before_.insert(targets.depth.texture.get());
  if (writes_depth(command) || writes_stencil(command)) written(targets.depth.texture);
  if (!writes_depth(command)) return;
  for (uint32_t slice = 0; slice < targets.depth.slice_count; ++slice) {
    cleared_.erase(
        {targets.depth.texture.get(), targets.depth.mip, targets.depth.first_slice + slice});
  }
}

void Targets::note(const runtime::ClearTargetCommand& command) {
  const TargetView& view = command.view;
  if (view.texture == nullptr) return;
  written(view.texture);
  if (!command.clear_depth || !command.whole) return;
  std::erase_if(cleared_, [](const auto& each) { return each.second.texture.expired(); });
  for (uint32_t slice = 0; slice < view.slice_count; ++slice) {
    cleared_[{view.texture.get(), view.mip, view.first_slice + slice}] = {
        view.texture, command.depth, "ClearDepthStencilView"};
  }
}

void Targets::written(const std::shared_ptr<runtime::BackendTexture>& texture) {
  if (texture == nullptr) return;
  written_[texture.get()] = texture;
}

std::string Targets::only_cleared(const TargetView& depth) const {
  if (depth.texture == nullptr) return "";
  const auto it = cleared_.find({depth.texture.get(), depth.mip, depth.first_slice});
  if (it == cleared_.end() || it->second.texture.expired()) return "";
  return "was cleared to " + float_name(it->second.depth) + " and not drawn to since";
}

}  // namespace kaamos::checks
