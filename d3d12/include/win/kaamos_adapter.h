// SPDX-License-Identifier: MIT
// The interface by which an adapter of DXGI or DXCore tells D3D12CreateDevice its backend.
#pragma once

#include <unknwn.h>

EXTERN_C const IID IID_IKaamosAdapter;
MIDL_INTERFACE("6b1f9a52-3f5e-4e0a-9a34-1f6a0c5b7a01")
IKaamosAdapter : public IUnknown {
 public:
  virtual const char* STDMETHODCALLTYPE GetBackend() = 0;
};
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IKaamosAdapter, 0x6b1f9a52, 0x3f5e, 0x4e0a, 0x9a, 0x34, 0x1f, 0x6a, 0x0c, 0x5b,
                0x7a, 0x01)
#endif
