// SPDX-License-Identifier: MIT
// DXGI 1.3. [DXGI: dxgi1_3.h]
#pragma once

#include <dxgi1_2.h>

typedef struct DXGI_MATRIX_3X2_F {
  float _11;
  float _12;
  float _21;
  float _22;
  float _31;
  float _32;
} DXGI_MATRIX_3X2_F;

typedef enum DXGI_OVERLAY_SUPPORT_FLAG {
  DXGI_OVERLAY_SUPPORT_FLAG_DIRECT = 0x1,
  DXGI_OVERLAY_SUPPORT_FLAG_SCALING = 0x2
} DXGI_OVERLAY_SUPPORT_FLAG;

MIDL_INTERFACE("6007896c-3244-4afd-bf18-a6d3beda5023")
IDXGIDevice3 : public IDXGIDevice2 {
 public:
  virtual void STDMETHODCALLTYPE Trim() = 0;
};

MIDL_INTERFACE("a8be2ac4-199f-4946-b331-79599fb98de7")
IDXGISwapChain2 : public IDXGISwapChain1 {
 public:
  virtual HRESULT STDMETHODCALLTYPE SetSourceSize(UINT width, UINT height) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetSourceSize(UINT * width, UINT * height) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetMaximumFrameLatency(UINT maxLatency) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetMaximumFrameLatency(UINT * maxLatency) = 0;
  virtual HANDLE STDMETHODCALLTYPE GetFrameLatencyWaitableObject() = 0;
  virtual HRESULT STDMETHODCALLTYPE SetMatrixTransform(const DXGI_MATRIX_3X2_F* matrix) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetMatrixTransform(DXGI_MATRIX_3X2_F * matrix) = 0;
};

MIDL_INTERFACE("595e39d1-2724-4663-99b1-da969de28364")
IDXGIOutput2 : public IDXGIOutput1 {
 public:
  virtual BOOL STDMETHODCALLTYPE SupportsOverlays() = 0;
};

MIDL_INTERFACE("25483823-cd46-4c7d-86ca-47aa95b837bd")
IDXGIFactory3 : public IDXGIFactory2 {
 public:
  virtual UINT STDMETHODCALLTYPE GetCreationFlags() = 0;
};

MIDL_INTERFACE("8a6bb301-7e7e-41f4-a8e0-5b32f7f99b18")
IDXGIOutput3 : public IDXGIOutput2 {
 public:
  virtual HRESULT STDMETHODCALLTYPE CheckOverlaySupport(
      DXGI_FORMAT enumFormat, IUnknown * concernedDevice, UINT * flags) = 0;
};

#define DXGI_CREATE_FACTORY_DEBUG 0x1

STDAPI CreateDXGIFactory2(UINT flags, REFIID riid, void** factory);
STDAPI DXGIGetDebugInterface1(UINT flags, REFIID riid, void** debug);

EXTERN_C const IID IID_IDXGIDevice3;
EXTERN_C const IID IID_IDXGISwapChain2;
EXTERN_C const IID IID_IDXGIOutput2;
EXTERN_C const IID IID_IDXGIFactory3;
EXTERN_C const IID IID_IDXGIOutput3;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGIDevice3, 0x6007896c, 0x3244, 0x4afd, 0xbf, 0x18, 0xa6, 0xd3, 0xbe, 0xda, 0x50,
                0x23)
__CRT_UUID_DECL(IDXGISwapChain2, 0xa8be2ac4, 0x199f, 0x4946, 0xb3, 0x31, 0x79, 0x59, 0x9f, 0xb9,
                0x8d, 0xe7)
__CRT_UUID_DECL(IDXGIOutput2, 0x595e39d1, 0x2724, 0x4663, 0x99, 0xb1, 0xda, 0x96, 0x9d, 0xe2, 0x83,
                0x64)
__CRT_UUID_DECL(IDXGIFactory3, 0x25483823, 0xcd46, 0x4c7d, 0x86, 0xca, 0x47, 0xaa, 0x95, 0xb8, 0x37,
                0xbd)
__CRT_UUID_DECL(IDXGIOutput3, 0x8a6bb301, 0x7e7e, 0x41f4, 0xa8, 0xe0, 0x5b, 0x32, 0xf7, 0xf9, 0x9b,
                0x18)
#endif
