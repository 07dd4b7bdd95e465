// SPDX-License-Identifier: MIT
#include "d3d12/objects/state_object_desc.h"

#include "d3d12/com/errors.h"
#include "d3d12/com/text.h"
#include "d3d12/container/shader_bytecode.h"
#include "d3d12/objects/pipeline_objects.h"
#include "d3d12/objects/state_object.h"

namespace kaamos::d3d12 {

namespace {

std::vector<rtapi::ExportDesc> exports_of(const D3D12_EXPORT_DESC* exports, UINT count) {
  std::vector<rtapi::ExportDesc> out;
  for (UINT i = 0; i < count; ++i) {
    out.push_back({to_utf8(exports[i].Name), to_utf8(exports[i].ExportToRename)});
  }
  return out;
}

std::vector<std::string> names_of(const LPCWSTR* names, UINT count) {
  std::vector<std::string> out;
  for (UINT i = 0; i < count; ++i) out.push_back(to_utf8(names[i]));
  return out;
}

class Converter {
 public:
  Converter(const rtapi::Device& device, const D3D12_STATE_OBJECT_DESC& desc, Reporter& reporter)
      : device_(device), desc_(desc), reporter_(reporter) {}

  // A null global root signature, and an association with one: as if they were not there.
  bool is_left_out(UINT index) const {
    const D3D12_STATE_SUBOBJECT& subobject = desc_.pSubobjects[index];
    if (subobject.pDesc == nullptr) return false;
    if (subobject.Type == D3D12_STATE_SUBOBJECT_TYPE_GLOBAL_ROOT_SIGNATURE) {
      return static_cast<const D3D12_GLOBAL_ROOT_SIGNATURE*>(subobject.pDesc)
                 ->pGlobalRootSignature == nullptr;
    }
    if (subobject.Type != D3D12_STATE_SUBOBJECT_TYPE_SUBOBJECT_TO_EXPORTS_ASSOCIATION) return false;
    const auto* target = static_cast<const D3D12_SUBOBJECT_TO_EXPORTS_ASSOCIATION*>(subobject.pDesc)
                             ->pSubobjectToAssociate;
    return is_in_array(target) &&
           target->Type == D3D12_STATE_SUBOBJECT_TYPE_GLOBAL_ROOT_SIGNATURE &&
           is_left_out(static_cast<UINT>(target - desc_.pSubobjects));
  }

  rtapi::Result<rtapi::StateSubobject> convert(UINT index) const {
    const D3D12_STATE_SUBOBJECT& subobject = desc_.pSubobjects[index];
    const void* data = subobject.pDesc;
    if (data == nullptr) return bad(index, "pDesc is null.");
    const auto as = [data]<class T>(T*) -> const T& { return *static_cast<const T*>(data); };
    switch (subobject.Type) {
      case D3D12_STATE_SUBOBJECT_TYPE_STATE_OBJECT_CONFIG:
        return rtapi::StateSubobject(rtapi::StateObjectConfig{static_cast<rtapi::StateObjectFlags>(
            as(static_cast<D3D12_STATE_OBJECT_CONFIG*>(nullptr)).Flags)});
      case D3D12_STATE_SUBOBJECT_TYPE_GLOBAL_ROOT_SIGNATURE:
        return rtapi::StateSubobject(rtapi::GlobalRootSignature{rtapi_root_signature(
            as(static_cast<D3D12_GLOBAL_ROOT_SIGNATURE*>(nullptr)).pGlobalRootSignature)});
      case D3D12_STATE_SUBOBJECT_TYPE_LOCAL_ROOT_SIGNATURE:
        return local_root_signature(
            as(static_cast<D3D12_LOCAL_ROOT_SIGNATURE*>(nullptr)).pLocalRootSignature);
      case D3D12_STATE_SUBOBJECT_TYPE_NODE_MASK:
        return rtapi::StateSubobject(
            rtapi::NodeMask{as(static_cast<D3D12_NODE_MASK*>(nullptr)).NodeMask});
      case D3D12_STATE_SUBOBJECT_TYPE_DXIL_LIBRARY:
        return library(index, as(static_cast<D3D12_DXIL_LIBRARY_DESC*>(nullptr)));
      case D3D12_STATE_SUBOBJECT_TYPE_EXISTING_COLLECTION:
        return collection(index, as(static_cast<D3D12_EXISTING_COLLECTION_DESC*>(nullptr)));
      case D3D12_STATE_SUBOBJECT_TYPE_SUBOBJECT_TO_EXPORTS_ASSOCIATION:
        return association(index,
                           as(static_cast<D3D12_SUBOBJECT_TO_EXPORTS_ASSOCIATION*>(nullptr)));
      case D3D12_STATE_SUBOBJECT_TYPE_DXIL_SUBOBJECT_TO_EXPORTS_ASSOCIATION: {
        const auto& from = as(static_cast<D3D12_DXIL_SUBOBJECT_TO_EXPORTS_ASSOCIATION*>(nullptr));
        if (from.NumExports != 0 && from.pExports == nullptr)
          return bad(index, "pExports is null.");
        return rtapi::StateSubobject(rtapi::DxilSubobjectToExportsAssociation{
            to_utf8(from.SubobjectToAssociate), names_of(from.pExports, from.NumExports)});
      }
      case D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_SHADER_CONFIG: {
        const auto& from = as(static_cast<D3D12_RAYTRACING_SHADER_CONFIG*>(nullptr));
        return rtapi::StateSubobject(rtapi::RaytracingShaderConfig{from.MaxPayloadSizeInBytes,
                                                                   from.MaxAttributeSizeInBytes});
      }
      case D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_PIPELINE_CONFIG:
        return rtapi::StateSubobject(rtapi::RaytracingPipelineConfig{
            as(static_cast<D3D12_RAYTRACING_PIPELINE_CONFIG*>(nullptr)).MaxTraceRecursionDepth});
      case D3D12_STATE_SUBOBJECT_TYPE_RAYTRACING_PIPELINE_CONFIG1: {
        const auto& from = as(static_cast<D3D12_RAYTRACING_PIPELINE_CONFIG1*>(nullptr));
        return rtapi::StateSubobject(rtapi::RaytracingPipelineConfig1{
            from.MaxTraceRecursionDepth, static_cast<rtapi::RaytracingPipelineFlags>(from.Flags)});
      }
      case D3D12_STATE_SUBOBJECT_TYPE_HIT_GROUP: {
        const auto& from = as(static_cast<D3D12_HIT_GROUP_DESC*>(nullptr));
        return rtapi::StateSubobject(rtapi::HitGroupDesc{
            to_utf8(from.HitGroupExport), static_cast<rtapi::HitGroupType>(from.Type),
            to_utf8(from.AnyHitShaderImport), to_utf8(from.ClosestHitShaderImport),
            to_utf8(from.IntersectionShaderImport)});
      }
      default:
        return bad(index, "Type is " + std::to_string(subobject.Type) +
                              ", which this library does not know.");
    }
  }

 private:
  static rtapi::Error bad(UINT index, const std::string& detail) {
    return make_error(ErrorId::kStateObject,
                      "pSubobjects[" + std::to_string(index) + "]: " + detail);
  }

  // Null is that of shaders without arguments.
  rtapi::Result<rtapi::StateSubobject> local_root_signature(ID3D12RootSignature* from) const {
    if (from != nullptr) {
      return rtapi::StateSubobject(rtapi::LocalRootSignature{rtapi_root_signature(from)});
    }
    auto empty =
        device_.CreateRootSignature({.Flags = rtapi::RootSignatureFlags::kLocalRootSignature});
    if (!empty) return empty.error();
    return rtapi::StateSubobject(rtapi::LocalRootSignature{*empty});
  }

  rtapi::Result<rtapi::StateSubobject> library(UINT index,
                                               const D3D12_DXIL_LIBRARY_DESC& from) const {
    if (from.NumExports != 0 && from.pExports == nullptr) return bad(index, "pExports is null.");
    auto library =
        load_shader(from.DXILLibrary.pShaderBytecode, from.DXILLibrary.BytecodeLength, reporter_);
    if (!library) return library.error();
    return rtapi::StateSubobject(
        rtapi::DxilLibraryDesc{*library, exports_of(from.pExports, from.NumExports)});
  }

  static rtapi::Result<rtapi::StateSubobject> collection(
      UINT index, const D3D12_EXISTING_COLLECTION_DESC& from) {
    if (from.pExistingCollection == nullptr) return bad(index, "pExistingCollection is null.");
    if (from.NumExports != 0 && from.pExports == nullptr) return bad(index, "pExports is null.");
    return rtapi::StateSubobject(rtapi::ExistingCollectionDesc::Of(
        static_cast<StateObject*>(from.pExistingCollection)->rtapi_state_object(),
        exports_of(from.pExports, from.NumExports)));
  }

  rtapi::Result<rtapi::StateSubobject> association(
      UINT index, const D3D12_SUBOBJECT_TO_EXPORTS_ASSOCIATION& from) const {
    if (from.NumExports != 0 && from.pExports == nullptr) return bad(index, "pExports is null.");
    const D3D12_STATE_SUBOBJECT* target = from.pSubobjectToAssociate;
    if (!is_in_array(target)) {
      return bad(index, "pSubobjectToAssociate is not in the array of " +
                            std::to_string(desc_.NumSubobjects) +
                            " subobjects. Did the array move after the pointer was taken?");
    }
    return rtapi::StateSubobject(rtapi::SubobjectToExportsAssociation{
        kept_before(static_cast<UINT>(target - desc_.pSubobjects)),
        names_of(from.pExports, from.NumExports)});
  }

  bool is_in_array(const D3D12_STATE_SUBOBJECT* subobject) const {
    return !std::less<>()(subobject, desc_.pSubobjects) &&
           std::less<>()(subobject, desc_.pSubobjects + desc_.NumSubobjects);
  }

  uint32_t kept_before(UINT index) const {
    uint32_t count = 0;
    for (UINT i = 0; i < index; ++i) count += is_left_out(i) ? 0 : 1;
    return count;
  }

  const rtapi::Device& device_;
  const D3D12_STATE_OBJECT_DESC& desc_;
  Reporter& reporter_;
};

}  // namespace

rtapi::Result<rtapi::StateObjectDesc> state_object_desc(const rtapi::Device& device,
                                                        const D3D12_STATE_OBJECT_DESC& desc,
                                                        Reporter& reporter) {
  if (desc.NumSubobjects != 0 && desc.pSubobjects == nullptr) {
    return make_error(ErrorId::kStateObject, "pSubobjects is null.");
  }
  if (desc.Type != D3D12_STATE_OBJECT_TYPE_COLLECTION &&
      desc.Type != D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE) {
    return make_error(ErrorId::kStateObject,
                      "Type is " + std::to_string(desc.Type) +
                          "; it is COLLECTION (0) or RAYTRACING_PIPELINE (3).");
  }
  rtapi::StateObjectDesc out;
  out.Type = static_cast<rtapi::StateObjectType>(desc.Type);
  const Converter converter(device, desc, reporter);
  for (UINT i = 0; i < desc.NumSubobjects; ++i) {
    if (converter.is_left_out(i)) continue;
    auto subobject = converter.convert(i);
    if (!subobject) return subobject.error();
    out.Subobjects.push_back(*std::move(subobject));
  }
  return out;
}

}  // namespace kaamos::d3d12
