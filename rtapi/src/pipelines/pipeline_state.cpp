// SPDX-License-Identifier: MIT
#include <rtapi/pipeline_state.h>

#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/bindings.h"
#include "rtapi/src/pipelines/pipeline_state_impl.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi {

using namespace detail;

namespace {

const std::string kEmptyName;

Result<const shader::ExportDesc*> find_kernel(const ComputePipelineStateDesc& desc) {
  const auto& table = *desc.CS.impl()->desc;
  const shader::ExportDesc* found = nullptr;
  std::string known;
  for (uint32_t i = 0; i < table.export_count; ++i) {
    const auto& e = table.exports[i];
    if (e.stage != shader::Stage::kCompute) continue;
    known += concat(known.empty() ? "" : ", ", in_quotes(e.name));
    if (!desc.EntryPoint.empty() && desc.EntryPoint != e.name) continue;
    if (found) {
      return make_error(Id::kComputeEntryPoint, "EntryPoint is ", in_quotes(desc.EntryPoint),
                        ", but ", in_quotes(desc.CS.name()),
                        " has several compute shaders; name one of them");
    }
    found = &e;
  }
  if (found && found->import_count != 0) {
    return make_error(
        Id::kComputeUnlinked, in_quotes(found->name), " of ", in_quotes(desc.CS.name()), " calls ",
        in_quotes(table.imports[found->imports[0]].signature), ", which has no body there");
  }
  if (found) return found;
  return make_error(Id::kComputeEntryPoint, in_quotes(desc.CS.name()), " has no compute shader ",
                    in_quotes(desc.EntryPoint), "; it has ", known.empty() ? "none" : known);
}

Status check_thread_group(const shader::ExportDesc& kernel) {
  const uint32_t* n = kernel.compute->thread_group;
  const bool ok = n[0] >= 1 && n[1] >= 1 && n[2] >= 1 && n[0] <= 1024 && n[1] <= 1024 &&
                  n[2] <= 64 && uint64_t{n[0]} * n[1] * n[2] <= 1024;
  if (ok) return {};
  return make_error(Id::kComputeEntryPoint, in_quotes(kernel.name), " has [numthreads(", n[0], ", ",
                    n[1], ", ", n[2],
                    ")]; x and y may be 1 to 1024, z 1 to 64, and their product at most 1024");
}

}  // namespace

const std::string& PipelineState::name() const {
  return impl_ ? impl_->name : kEmptyName;
}

Result<PipelineState> Device::CreateComputePipelineState(
    const ComputePipelineStateDesc& given) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateComputePipelineState on an empty device");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  ComputePipelineStateDesc desc = given;
  if (desc.CS) desc.CS = impl_->library_to_run(desc.CS);
  if (!desc.CS) return make_error(Id::kNullHandle, "CS is an empty shader library handle");
  if (Status s = check_shader_model(*impl_, desc.CS); !s.ok()) return s.error();
  if (Status s = CheckHandle(impl_, desc.pRootSignature, "pRootSignature"); !s.ok()) {
    return s.error();
  }
  if (desc.pRootSignature.is_local()) {
    return make_error(Id::kRootSignatureKind,
                      "a compute pipeline needs a global root signature, but this one is local");
  }
  auto kernel = find_kernel(desc);
  if (!kernel.ok()) return kernel.error();
  if (Status s = check_thread_group(**kernel); !s.ok()) return s.error();
  const std::string where = concat("compute shader ", in_quotes((*kernel)->name));
  if (Status s = check_shader_tier(*impl_, **kernel, where); !s.ok()) return s.error();
  const auto& table = *desc.CS.impl()->desc;
  auto slots = resolve_bindings(table, **kernel, desc.pRootSignature, RootSignature(), where);
  if (!slots.ok()) return slots.error();
  auto linked = std::make_shared<runtime::LinkedCompute>();
  linked->shader.name = (*kernel)->name;
  linked->shader.stage = shader::Stage::kCompute;
  linked->shader.code = *kernel;
  linked->shader.library = &table;
  linked->shader.slots = std::move(*slots);
  linked->shader.stack_bytes = (*kernel)->stack_bytes;
  linked->shader.library_owner = desc.CS;
  linked->shader.global_root_signature = desc.pRootSignature;
  if (Status s = impl_->provide_prints(runtime::printing_libraries(*linked)); !s.ok()) {
    return s.error();
  }
  auto pipeline = impl_->backend->create_compute_pipeline(linked);
  if (!pipeline.ok()) return pipeline.error();
  auto impl = std::make_shared<PipelineStateImpl>();
  impl->device = impl_;
  impl->name = desc.Name.empty() ? linked->shader.name : desc.Name;
  impl->root_signature = desc.pRootSignature;
  impl->pipeline = std::move(*pipeline);
  impl->linked = std::move(linked);
  return PipelineState(std::move(impl));
}

}  // namespace rtapi
