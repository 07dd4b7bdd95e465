// SPDX-License-Identifier: MIT
#include <rtapi/graphics_pipeline.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <rtapi/device.h>

#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/bindings.h"
#include "rtapi/src/pipelines/graphics_link.h"
#include "rtapi/src/pipelines/hit_attributes.h"
#include "rtapi/src/pipelines/pipeline_state_impl.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/backend/linked_graphics.h"

namespace rtapi {

namespace detail {

namespace {

using runtime::LinkedGraphics;

constexpr const char* kZeroed = "; was the description zeroed? Begin with a default one";

Status check_rasterizer(const RasterizerDesc& desc) {
  if (desc.FillMode != FillMode::kSolid && desc.FillMode != FillMode::kWireframe) {
    return make_error(Id::kGraphicsDesc, "FillMode is ", static_cast<uint32_t>(desc.FillMode),
                      "; it must be kWireframe (2) or kSolid (3)", kZeroed);
  }
  if (desc.CullMode < CullMode::kNone || desc.CullMode > CullMode::kBack) {
    return make_error(Id::kGraphicsDesc, "CullMode is ", static_cast<uint32_t>(desc.CullMode),
                      "; it must be 1 to 3", kZeroed);
  }
  if (!std::isfinite(desc.DepthBiasClamp) || !std::isfinite(desc.SlopeScaledDepthBias)) {
    return make_error(Id::kGraphicsDesc, "DepthBiasClamp is ", desc.DepthBiasClamp,
                      " and SlopeScaledDepthBias ", desc.SlopeScaledDepthBias,
                      "; both must be finite");
  }
  return {};
}

Status check_depth(const DepthStencilDesc& desc) {
  if (!desc.DepthEnable) return {};
  if (desc.DepthFunc < ComparisonFunc::kNever || desc.DepthFunc > ComparisonFunc::kAlways) {
    return make_error(Id::kGraphicsDesc, "DepthFunc is ", static_cast<uint32_t>(desc.DepthFunc),
                      "; it must be 1 to 8", kZeroed);
  }
  if (desc.DepthWriteMask > DepthWriteMask::kAll) {
    return make_error(Id::kGraphicsDesc, "DepthWriteMask is ",
                      static_cast<uint32_t>(desc.DepthWriteMask), "; it must be 0 or 1");
  }
  return {};
}

Status check_stencil_face(const DepthStencilOpDesc& desc, const char* face) {
  const std::pair<const char*, StencilOp> ops[] = {{"StencilFailOp", desc.StencilFailOp},
                                                   {"StencilDepthFailOp", desc.StencilDepthFailOp},
                                                   {"StencilPassOp", desc.StencilPassOp}};
  for (const auto& [name, op] : ops) {
    if (op >= StencilOp::kKeep && op <= StencilOp::kDecr) continue;
    return make_error(Id::kGraphicsDesc, face, ".", name, " is ", static_cast<uint32_t>(op),
                      "; it must be 1 to 8", kZeroed);
  }
  if (desc.StencilFunc < ComparisonFunc::kNever || desc.StencilFunc > ComparisonFunc::kAlways) {
    return make_error(Id::kGraphicsDesc, face, ".StencilFunc is ",
                      static_cast<uint32_t>(desc.StencilFunc), "; it must be 1 to 8", kZeroed);
  }
  return {};
}

Status check_stencil(const DepthStencilDesc& desc) {
  if (!desc.StencilEnable) return {};
  if (Status s = check_stencil_face(desc.FrontFace, "FrontFace"); !s.ok()) return s;
  return check_stencil_face(desc.BackFace, "BackFace");
}

bool reads_second_source(Blend blend) {
  return blend >= Blend::kSrc1Color && blend <= Blend::kInvSrc1Alpha;
}
bool is_blend(Blend blend) {
  return (blend >= Blend::kZero && blend <= Blend::kSrcAlphaSat) ||
         (blend >= Blend::kBlendFactor && blend <= Blend::kInvSrc1Alpha);
}
bool is_color_blend(Blend blend) {
  return blend == Blend::kSrcColor || blend == Blend::kInvSrcColor || blend == Blend::kDestColor ||
         blend == Blend::kInvDestColor || blend == Blend::kSrc1Color ||
         blend == Blend::kInvSrc1Color;
}
bool reads_second_source(const RenderTargetBlendDesc& desc) {
  return desc.BlendEnable &&
         (reads_second_source(desc.SrcBlend) || reads_second_source(desc.DestBlend) ||
          reads_second_source(desc.SrcBlendAlpha) || reads_second_source(desc.DestBlendAlpha));
}

// [D3D12: D3D12_BLEND_DESC]
Status check_logic_op(const GraphicsPipelineStateDesc& desc, const RenderTargetBlendDesc& target,
                      const std::string& where) {
  if (!target.LogicOpEnable) return {};
  if (target.BlendEnable || desc.BlendState.IndependentBlendEnable) {
    return make_error(Id::kGraphicsDesc, where, " has LogicOpEnable with ",
                      target.BlendEnable ? "BlendEnable" : "IndependentBlendEnable",
                      "; set that to false");
  }
  if (target.LogicOp <= LogicOp::kOrInverted) return {};
  return make_error(Id::kGraphicsDesc, where, ".LogicOp is ", static_cast<uint32_t>(target.LogicOp),
                    "; it must be 0 to 15");
}

// Only target 0 is blended with a second source, and nothing is blended beside it, not even where
// there is no target. [D3D11.3: 17.6]
Status check_second_source(const BlendDesc& desc, const LinkedGraphics& linked) {
  if (!linked.blends_two_sources || !desc.IndependentBlendEnable) return {};
  for (uint32_t i = 1; i < kSimultaneousRenderTargetCount; ++i) {
    if (!desc.RenderTarget[i].BlendEnable) continue;
    return make_error(Id::kGraphicsDesc, "RenderTarget[", i,
                      "] has BlendEnable, and another one blends with SV_Target1; only "
                      "RenderTarget[0] may blend then");
  }
  return {};
}

Status check_blend(const RenderTargetBlendDesc& desc, const std::string& where) {
  if (static_cast<uint32_t>(desc.RenderTargetWriteMask) > 15) {
    return make_error(Id::kGraphicsDesc, where, ".RenderTargetWriteMask is ",
                      static_cast<uint32_t>(desc.RenderTargetWriteMask), "; it must be 0 to 15");
  }
  if (!desc.BlendEnable) return {};
  const std::pair<const char*, Blend> factors[] = {{"SrcBlend", desc.SrcBlend},
                                                   {"DestBlend", desc.DestBlend},
                                                   {"SrcBlendAlpha", desc.SrcBlendAlpha},
                                                   {"DestBlendAlpha", desc.DestBlendAlpha}};
  for (const auto& [name, factor] : factors) {
    if (!is_blend(factor)) {
      return make_error(Id::kGraphicsDesc, where, ".", name, " is ", static_cast<uint32_t>(factor),
                        "; it must be 1 to 11 or 14 to 19", kZeroed);
    }
    const bool of_alpha = std::string_view(name).ends_with("Alpha");
    if (of_alpha && is_color_blend(factor)) {
      return make_error(Id::kGraphicsDesc, where, ".", name, " is ", static_cast<uint32_t>(factor),
                        ", a colour; alpha takes the factor of the same name with Alpha");
    }
  }
  const auto is_op = [](BlendOp op) { return op >= BlendOp::kAdd && op <= BlendOp::kMax; };
  if (is_op(desc.BlendOp) && is_op(desc.BlendOpAlpha)) return {};
  return make_error(Id::kGraphicsDesc, where, " has BlendOp ", static_cast<uint32_t>(desc.BlendOp),
                    " and BlendOpAlpha ", static_cast<uint32_t>(desc.BlendOpAlpha),
                    "; they must be 1 to 5", kZeroed);
}

Status check_topology(const GraphicsPipelineStateDesc& desc) {
  const auto type = desc.PrimitiveTopologyType;
  if (type == PrimitiveTopologyType::kUndefined || type > PrimitiveTopologyType::kPatch) {
    return make_error(Id::kGraphicsDesc, "PrimitiveTopologyType is ", static_cast<uint32_t>(type),
                      "; it must be 1 to 3");
  }
  if (type == PrimitiveTopologyType::kPatch) {
    return make_error(Id::kGraphicsUnsupported,
                      "PrimitiveTopologyType is kPatch (4); kPoint (1), kLine (2) and kTriangle "
                      "(3) are drawn");
  }
  if (desc.IBStripCutValue > IndexBufferStripCutValue::k0xFFFFFFFF) {
    return make_error(Id::kGraphicsDesc, "IBStripCutValue is ",
                      static_cast<uint32_t>(desc.IBStripCutValue), "; it must be 0 to 2");
  }
  return {};
}

// Formats of targets, and what is blended into them.
Status take_targets(const DeviceImpl& device, const GraphicsPipelineStateDesc& desc,
                    LinkedGraphics& linked) {
  if (desc.RTVFormats.size() > kSimultaneousRenderTargetCount) {
    return make_error(Id::kGraphicsDesc, "RTVFormats has ", desc.RTVFormats.size(),
                      " formats; at most 8");
  }
  linked.target_count = static_cast<uint32_t>(desc.RTVFormats.size());
  for (uint32_t i = 0; i < kSimultaneousRenderTargetCount; ++i) {
    linked.blend[i] = desc.BlendState.RenderTarget[desc.BlendState.IndependentBlendEnable ? i : 0];
    if (i >= linked.target_count) continue;
    const std::string where = concat("RenderTarget[", i, "]");
    if (Status s = check_logic_op(desc, linked.blend[i], where); !s.ok()) return s;
    if (Status s = check_blend(linked.blend[i], where); !s.ok()) return s;
    const Format format = desc.RTVFormats[i];
    linked.target_formats[i] = format;
    linked.blends_two_sources = linked.blends_two_sources || reads_second_source(linked.blend[i]);
    if (format == Format::kUnknown) continue;
    if (!device.backend->supports_target(format, false)) {
      return make_error(Id::kTargetFormat, "RTVFormats[", i, "] is DXGI format ",
                        static_cast<uint32_t>(format), ", which this backend cannot draw to");
    }
  }
  if (Status s = check_second_source(desc.BlendState, linked); !s.ok()) return s;
  linked.depth_format = desc.DSVFormat;
  if (desc.DSVFormat != Format::kUnknown &&
      (!IsDepthFormat(desc.DSVFormat) || !device.backend->supports_target(desc.DSVFormat, false))) {
    return make_error(Id::kTargetFormat, "DSVFormat is DXGI format ",
                      static_cast<uint32_t>(desc.DSVFormat), "; it must be a depth format");
  }
  return {};
}

// The only export of a stage, or that of the name.
Result<const shader::ExportDesc*> find_shader(const ShaderLibrary& library, const std::string& name,
                                              shader::Stage stage, const char* kind) {
  const auto& table = *library.impl()->desc;
  const shader::ExportDesc* found = nullptr;
  std::string known;
  for (uint32_t i = 0; i < table.export_count; ++i) {
    const auto& e = table.exports[i];
    if (e.stage != stage || !e.graphics) continue;
    known += concat(known.empty() ? "" : ", ", in_quotes(e.name));
    if (!name.empty() && name != e.name) continue;
    if (found) {
      return make_error(Id::kGraphicsShader, in_quotes(library.name()), " has several ", kind,
                        " shaders; name one of ", known, " in EntryPoint");
    }
    found = &e;
  }
  if (found) return found;
  return make_error(Id::kGraphicsShader, in_quotes(library.name()), " has no ", kind, " shader ",
                    in_quotes(name), "; it has ", known.empty() ? "none" : known);
}

struct GraphicsStage {
  shader::Stage stage;
  ShaderVisibility visibility;
  RootSignatureFlags denied;
  const char* denied_name;
};
constexpr GraphicsStage kGraphicsStages[] = {
    {shader::Stage::kVertex, ShaderVisibility::kVertex,
     RootSignatureFlags::kDenyVertexShaderRootAccess, "kDenyVertexShaderRootAccess"},
    {shader::Stage::kGeometry, ShaderVisibility::kGeometry,
     RootSignatureFlags::kDenyGeometryShaderRootAccess, "kDenyGeometryShaderRootAccess"},
    {shader::Stage::kPixel, ShaderVisibility::kPixel,
     RootSignatureFlags::kDenyPixelShaderRootAccess, "kDenyPixelShaderRootAccess"}};

const GraphicsStage& rules_of(shader::Stage stage) {
  return *std::find_if(std::begin(kGraphicsStages), std::end(kGraphicsStages),
                       [&](const GraphicsStage& one) { return one.stage == stage; });
}

Status link_shader(const DeviceImpl& device, const RootSignature& signature,
                   const GraphicsShader& given, shader::Stage stage,
                   runtime::LinkedShader& linked) {
  const GraphicsStage& rules = rules_of(stage);
  const ShaderLibrary library = device.library_to_run(given.Library);
  if (Status s = check_shader_model(device, library); !s.ok()) return s;
  auto code = find_shader(library, given.EntryPoint, stage, stage_name(stage));
  if (!code.ok()) return code.error();
  const std::string where = concat(stage_name(stage), " shader ", in_quotes((*code)->name));
  if (Status s = check_shader_tier(device, **code, where); !s.ok()) return s;
  if ((*code)->binding_count > 0 && HasAny(signature.GetDesc().Flags, rules.denied)) {
    return make_error(Id::kStageRootAccess, where, " has ", (*code)->binding_count,
                      " resources, but the root signature has ", rules.denied_name);
  }
  const auto& table = *library.impl()->desc;
  auto slots = resolve_bindings(table, **code, signature, RootSignature(), where, rules.visibility);
  if (!slots.ok()) return slots.error();
  linked.name = (*code)->name;
  linked.stage = stage;
  linked.code = *code;
  linked.library = &table;
  linked.slots = std::move(*slots);
  linked.stack_bytes = (*code)->stack_bytes;
  linked.library_owner = library;
  linked.global_root_signature = signature;
  return {};
}

Status link_shaders(const DeviceImpl& device, const GraphicsPipelineStateDesc& desc,
                    LinkedGraphics& linked) {
  if (!desc.VS.Library) return make_error(Id::kNullHandle, "VS.Library is an empty library handle");
  if (Status s =
          link_shader(device, desc.pRootSignature, desc.VS, shader::Stage::kVertex, linked.vertex);
      !s.ok()) {
    return s;
  }
  linked.name = desc.Name.empty() ? linked.vertex.name : desc.Name;
  if (desc.GS.Library) {
    if (Status s = link_shader(device, desc.pRootSignature, desc.GS, shader::Stage::kGeometry,
                               linked.geometry);
        !s.ok()) {
      return s;
    }
  }
  if (desc.PS.Library) {
    if (Status s =
            link_shader(device, desc.pRootSignature, desc.PS, shader::Stage::kPixel, linked.pixel);
        !s.ok()) {
      return s;
    }
  }
  if (!desc.InputLayout.empty() && !HasAny(desc.pRootSignature.GetDesc().Flags,
                                           RootSignatureFlags::kAllowInputAssemblerInputLayout)) {
    return make_error(Id::kStageRootAccess, "InputLayout has ", desc.InputLayout.size(),
                      " elements, but the root signature lacks kAllowInputAssemblerInputLayout");
  }
  if (Status s = link_input_layout(desc, linked); !s.ok()) return s;
  if (Status s = link_stages(device, linked); !s.ok()) return s;
  return link_targets(device, linked);
}

void warn_of_sample_mask(const DeviceImpl& device, const LinkedGraphics& linked) {
  if ((linked.sample_mask & ((uint64_t{1} << linked.samples) - 1)) != 0) return;
  device.report(
      MessageSeverity::kWarning,
      make_error(Id::kGraphicsWarning, named("graphics pipeline", linked.name), ": SampleMask is ",
                 hex(linked.sample_mask), ", so that nothing is drawn; set it to 0xFFFFFFFF"));
}

Status check_samples(const DeviceImpl& device, const GraphicsPipelineStateDesc& desc) {
  const std::string name = named("graphics pipeline", desc.Name);
  if (Status s = check_sample_desc(desc.SampleDesc, name); !s.ok()) return s;
  const uint32_t count = desc.SampleDesc.Count;
  for (const Format format : desc.RTVFormats) {
    if (format == Format::kUnknown) continue;
    if (Status s = check_sample_support(device, format, count, name); !s.ok()) return s;
  }
  return check_sample_support(device, desc.DSVFormat, count, name);
}

}  // namespace

}  // namespace detail

using namespace detail;

Result<PipelineState> Device::CreateGraphicsPipelineState(
    const GraphicsPipelineStateDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateGraphicsPipelineState on an empty device");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  if (Status s = CheckHandle(impl_, desc.pRootSignature, "pRootSignature"); !s.ok()) {
    return s.error();
  }
  if (desc.pRootSignature.is_local()) {
    return make_error(Id::kRootSignatureKind,
                      "a graphics pipeline needs a global root signature, but this one is local");
  }
  if (Status s = check_rasterizer(desc.RasterizerState); !s.ok()) return s.error();
  if (Status s = check_depth(desc.DepthStencilState); !s.ok()) return s.error();
  if (Status s = check_stencil(desc.DepthStencilState); !s.ok()) return s.error();
  if (Status s = check_topology(desc); !s.ok()) return s.error();
  auto linked = std::make_shared<runtime::LinkedGraphics>();
  linked->rasterizer = desc.RasterizerState;
  linked->depth_stencil = desc.DepthStencilState;
  linked->sample_mask = desc.SampleMask;
  linked->samples = desc.SampleDesc.Count;
  linked->alpha_to_coverage = desc.BlendState.AlphaToCoverageEnable;
  linked->strip_cut = desc.IBStripCutValue;
  linked->topology = desc.PrimitiveTopologyType;
  if (Status s = take_targets(*impl_, desc, *linked); !s.ok()) return s.error();
  if (Status s = check_samples(*impl_, desc); !s.ok()) return s.error();
  if (Status s = link_shaders(*impl_, desc, *linked); !s.ok()) return s.error();
  warn_of_sample_mask(*impl_, *linked);
  if (impl_->checks) impl_->checks->created(*linked);
  if (Status s = impl_->provide_prints(runtime::printing_libraries(*linked)); !s.ok()) {
    return s.error();
  }
  auto pipeline = impl_->backend->create_graphics_pipeline(linked);
  if (!pipeline.ok()) return pipeline.error();
  auto impl = std::make_shared<PipelineStateImpl>();
  impl->device = impl_;
  impl->name = linked->name;
  impl->root_signature = desc.pRootSignature;
  impl->pipeline = std::move(*pipeline);
  impl->graphics = std::move(linked);
  return PipelineState(std::move(impl));
}

}  // namespace rtapi
