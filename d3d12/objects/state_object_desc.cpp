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
  Converter(const D3D12_STATE_OBJECT_DESC& desc, Reporter& reporter)
      : desc_(desc), reporter_(reporter) {}

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
        return rtapi::StateSubobject(rtapi::LocalRootSignature{rtapi_root_signature(
            as(static_cast<D3D12_LOCAL_ROOT_SIGNATURE*>(nullptr)).pLocalRootSignature)});
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
    const D3D12_STATE_SUBOBJECT* first = desc_.pSubobjects;
    const D3D12_STATE_SUBOBJECT* target = from.pSubobjectToAssociate;
    if (std::less<>()(target, first) || !std::less<>()(target, first + desc_.NumSubobjects)) {
      return bad(index, "pSubobjectToAssociate is not in the array of " +
                            std::to_string(desc_.NumSubobjects) +
                            " subobjects. Did the array move after the pointer was taken?");
    }
    return rtapi::StateSubobject(rtapi::SubobjectToExportsAssociation{
        static_cast<uint32_t>(target - first), names_of(from.pExports, from.NumExports)});
  }

  const D3D12_STATE_OBJECT_DESC& desc_;
  Reporter& reporter_;
};

}  // namespace

rtapi::Result<rtapi::StateObjectDesc> state_object_desc(const D3D12_STATE_OBJECT_DESC& desc,
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
  const Converter converter(desc, reporter);
  for (UINT i = 0; i < desc.NumSubobjects; ++i) {
    auto subobject = converter.convert(i);
    if (!subobject) return subobject.error();
    out.Subobjects.push_back(*std::move(subobject));
  }
  return out;
}

}  // namespace kaamos::d3d12
