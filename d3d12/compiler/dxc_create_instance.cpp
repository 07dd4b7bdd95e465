// SPDX-License-Identifier: MIT
//
// DxcCreateInstance: the classes of dxcompiler.
#include "d3d12/compiler/dxc_compiler.h"
#include "d3d12/compiler/dxc_container.h"
#include "d3d12/compiler/dxc_utils.h"

namespace kaamos::d3d12 {

namespace {

// Nothing is linked, assembled or optimised before a state object is made of it: their methods say
// that they are missing.
class DxcLinker final : public ComObject<IDxcLinkerEntries> {};
class DxcAssembler final : public ComObject<IDxcAssemblerEntries> {};
class DxcOptimizer final : public ComObject<IDxcOptimizerEntries> {};

template <class Object>
HRESULT make(REFIID riid, void** object) {
  return hand_out(new Object(), riid, object);
}

HRESULT create(REFCLSID class_id, REFIID riid, void** object) {
  if (object == nullptr) return E_POINTER;
  *object = nullptr;
  if (class_id == CLSID_DxcCompiler) return make<DxcCompiler>(riid, object);
  if (class_id == CLSID_DxcUtils) return make<DxcUtils>(riid, object);  // CLSID_DxcLibrary too
  if (class_id == CLSID_DxcCompilerArgs) return make<DxcCompilerArgs>(riid, object);
  if (class_id == CLSID_DxcValidator) return make<DxcValidator>(riid, object);
  if (class_id == CLSID_DxcContainerReflection) return make<DxcContainerReflection>(riid, object);
  if (class_id == CLSID_DxcContainerBuilder) return make<DxcContainerBuilder>(riid, object);
  if (class_id == CLSID_DxcLinker) return make<DxcLinker>(riid, object);
  if (class_id == CLSID_DxcAssembler) return make<DxcAssembler>(riid, object);
  if (class_id == CLSID_DxcOptimizer) return make<DxcOptimizer>(riid, object);
  return REGDB_E_CLASSNOTREG;
}

}  // namespace

}  // namespace kaamos::d3d12

STDAPI DxcCreateInstance(REFCLSID rclsid, REFIID riid, LPVOID* ppv) {
  return kaamos::d3d12::create(rclsid, riid, ppv);
}

STDAPI DxcCreateInstance2(IMalloc*, REFCLSID rclsid, REFIID riid, LPVOID* ppv) {
  return kaamos::d3d12::create(rclsid, riid, ppv);
}
