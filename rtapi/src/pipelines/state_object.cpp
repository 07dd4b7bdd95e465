// SPDX-License-Identifier: MIT
#include <rtapi/device.h>
#include <rtapi/state_object.h>

#include <set>
#include <string_view>

#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/state_object_impl.h"

namespace rtapi {

using namespace detail;

StateObjectType StateObject::GetType() const {
  return impl_ ? impl_->type : StateObjectType::kRaytracingPipeline;
}

const ShaderIdentifier* StateObject::GetShaderIdentifier(std::string_view name) const {
  const auto* record = impl_ ? impl_->find_record(name) : nullptr;
  return record ? &record->identifier : nullptr;
}

uint64_t StateObject::GetShaderStackSize(std::string_view name) const {
  if (!impl_) return kNoShaderStackSize;
  const size_t colons = name.rfind("::");
  if (colons == std::string_view::npos) {
    const auto* record = impl_->find_record(name);
    return record && record->shader ? record->shader->stack_bytes : kNoShaderStackSize;
  }
  const auto* group = impl_->find_record(name.substr(0, colons));
  if (!group || group->kind != runtime::RecordKind::kHitGroup) return kNoShaderStackSize;
  const std::string_view part = name.substr(colons + 2);
  const runtime::LinkedShader* member = part == "intersection" ? group->intersection
                                        : part == "anyhit"     ? group->any_hit
                                        : part == "closesthit" ? group->closest_hit
                                                               : nullptr;
  return member ? member->stack_bytes : kNoShaderStackSize;
}

uint64_t StateObject::GetPipelineStackSize() const {
  return impl_ ? impl_->stack_bytes.load() : 0;
}

Status StateObject::SetPipelineStackSize(uint64_t bytes) {
  if (!impl_) return make_error(Id::kNullHandle, "SetPipelineStackSize on an empty state object");
  if (impl_->type == StateObjectType::kCollection) {
    return make_error(Id::kPipelineStackSize, "a collection has no pipeline stack");
  }
  if (bytes >= 0xFFFFFFFFu) {
    return make_error(Id::kPipelineStackSize, bytes,
                      " bytes is too large; it must be below 0xFFFFFFFF. The stack stays at ",
                      impl_->stack_bytes.load(), " bytes");
  }
  impl_->stack_bytes = bytes;
  return {};
}

RootSignature StateObject::GetLocalRootSignature(std::string_view name) const {
  const auto* record = impl_ ? impl_->find_record(name) : nullptr;
  return record ? record->local_root_signature : RootSignature();
}

std::vector<std::string> StateObject::GetIdentifiableExports() const {
  std::vector<std::string> names;
  if (!impl_) return names;
  for (const auto& record : impl_->linked->records) names.push_back(record->name);
  return names;
}

namespace {

Result<std::shared_ptr<StateObjectImpl>> make_state_object(
    const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc, bool for_backend) {
  if (Status s = device->removed(); !s.ok()) return s.error();
  if (Status s = check_has_raytracing(*device, "a state object"); !s.ok()) return s.error();
  auto parts = gather_parts(device, desc);
  if (!parts.ok()) return parts.error();
  if (Status s = link_functions(*parts); !s.ok()) return s.error();
  if (Status s = associate_all(*parts); !s.ok()) return s.error();
  return link_state_object(std::move(*parts), for_backend);
}

// [DXR: AddToStateObject]
Status check_addition(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& addition,
                      const StateObject& parent) {
  if (device->desc.Tier < RaytracingTier::kTier1_1) {
    return make_error(Id::kAdditionNotAllowed, "AddToStateObject needs tier 1.1, ",
                      but_tier(*device));
  }
  if (Status s = CheckHandle(device, parent, "the parent"); !s.ok()) return s;
  if (parent.impl()->type != StateObjectType::kRaytracingPipeline ||
      addition.Type != StateObjectType::kRaytracingPipeline) {
    return make_error(Id::kAdditionNotAllowed, "parent and addition must be pipelines, but the ",
                      parent.impl()->type == StateObjectType::kCollection ? "parent" : "addition",
                      " is a collection");
  }
  if (!HasAny(parent.impl()->flags, StateObjectFlags::kAllowStateObjectAdditions)) {
    return make_error(Id::kAdditionNotAllowed,
                      "the parent lacks flag 0x4 "
                      "(kAllowStateObjectAdditions) in its state object config");
  }
  return {};
}

// Names of entry points and hit groups must be unique; library functions may be added again.
Status check_added_names(const StateObjectImpl& added, const StateObjectImpl& parent) {
  const auto counts = [](const Subject& s) {
    return !s.hidden && (s.is_group() || s.code->stage != shader::Stage::kLibrary);
  };
  std::set<std::string_view> taken;
  for (const SubjectPtr& s : parent.subjects) {
    if (counts(*s)) taken.insert(s->name);
  }
  for (const SubjectPtr& s : added.subjects) {
    if (!counts(*s) || taken.count(s->name) == 0) continue;
    return make_error(Id::kAdditionDuplicate, "the parent already exports ", in_quotes(s->name),
                      "; rename it, or leave it out of the export list");
  }
  return {};
}

Status check_added(const StateObjectImpl& added, const StateObjectImpl& parent) {
  if (!HasAny(added.flags, StateObjectFlags::kAllowStateObjectAdditions)) {
    return make_error(Id::kAdditionNotAllowed,
                      "the addition lacks flag 0x4 "
                      "(kAllowStateObjectAdditions) in its state object config");
  }
  const runtime::LinkedPipeline& a = *added.linked;
  const runtime::LinkedPipeline& p = *parent.linked;
  if (!a.records.empty() &&
      (a.max_payload_bytes != p.max_payload_bytes ||
       a.max_attribute_bytes != p.max_attribute_bytes ||
       a.max_recursion_depth != p.max_recursion_depth || a.flags != p.flags)) {
    return make_error(Id::kAdditionConfigsDiffer, "the addition has payload ", a.max_payload_bytes,
                      ", attributes ", a.max_attribute_bytes, ", recursion ", a.max_recursion_depth,
                      ", but the parent has ", p.max_payload_bytes, ", ", p.max_attribute_bytes,
                      ", ", p.max_recursion_depth);
  }
  return check_added_names(added, parent);
}

}  // namespace

Result<StateObject> Device::CreateStateObject(const StateObjectDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateStateObject on an empty device handle");
  auto made = make_state_object(impl_, desc, true);
  if (!made.ok()) return made.error();
  return StateObject(std::move(*made));
}

Result<StateObject> Device::AddToStateObject(const StateObjectDesc& addition,
                                             const StateObject& parent) const {
  if (!impl_) return make_error(Id::kNullHandle, "AddToStateObject on an empty device handle");
  if (Status s = check_addition(impl_, addition, parent); !s.ok()) return s.error();
  // The addition must be valid by itself, since it sees nothing of the parent.
  auto added = make_state_object(impl_, addition, false);
  if (!added.ok()) return added.error();
  if (Status s = check_added(**added, *parent.impl()); !s.ok()) return s.error();
  Parts merged;
  merged.device = impl_;
  merged.flags = parent.impl()->flags;
  for (const StateObjectImpl* source : {parent.impl().get(), added->get()}) {
    merged.subjects.insert(merged.subjects.end(), source->subjects.begin(), source->subjects.end());
  }
  auto made = link_state_object(std::move(merged), true);
  if (!made.ok()) return made.error();
  (*made)->stack_bytes = parent.impl()->stack_bytes.load();
  (*made)->ancestors = parent.impl()->ancestors;
  (*made)->ancestors.push_back(parent.impl()->linked);
  return StateObject(std::move(*made));
}

}  // namespace rtapi
