// SPDX-License-Identifier: MIT
// DXGI 1.2. [DXGI: dxgi1_2.h]
#pragma once

#include <dxgi.h>

struct IDXGIOutputDuplication;

#define DXGI_ENUM_MODES_STEREO 0x4
#define DXGI_ENUM_MODES_DISABLED_STEREO 0x8
#define DXGI_SHARED_RESOURCE_READ 0x80000000
#define DXGI_SHARED_RESOURCE_WRITE 0x1

typedef enum DXGI_OFFER_RESOURCE_PRIORITY {
  DXGI_OFFER_RESOURCE_PRIORITY_LOW = 1,
  DXGI_OFFER_RESOURCE_PRIORITY_NORMAL = 2,
  DXGI_OFFER_RESOURCE_PRIORITY_HIGH = 3
} DXGI_OFFER_RESOURCE_PRIORITY;

typedef enum DXGI_ALPHA_MODE {
  DXGI_ALPHA_MODE_UNSPECIFIED = 0,
  DXGI_ALPHA_MODE_PREMULTIPLIED = 1,
  DXGI_ALPHA_MODE_STRAIGHT = 2,
  DXGI_ALPHA_MODE_IGNORE = 3,
  DXGI_ALPHA_MODE_FORCE_DWORD = 0xffffffff
} DXGI_ALPHA_MODE;

typedef struct DXGI_MODE_DESC1 {
  UINT Width;
  UINT Height;
  DXGI_RATIONAL RefreshRate;
  DXGI_FORMAT Format;
  DXGI_MODE_SCANLINE_ORDER ScanlineOrdering;
  DXGI_MODE_SCALING Scaling;
  BOOL Stereo;
} DXGI_MODE_DESC1;

MIDL_INTERFACE("aba496dd-b617-4cb8-a866-bc44d7eb1fa2")
IDXGISurface2 : public IDXGISurface1 {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetResource(REFIID iid, void** parentResource,
                                                UINT* subresourceIdx) = 0;
};

MIDL_INTERFACE("30961379-4609-4a41-998e-54fe567ee0c1")
IDXGIResource1 : public IDXGIResource {
 public:
  virtual HRESULT STDMETHODCALLTYPE CreateSubresourceSurface(UINT index,
                                                             IDXGISurface2 * *surface) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSharedHandle(
      const SECURITY_ATTRIBUTES* attributes, DWORD access, const WCHAR* name, HANDLE* handle) = 0;
};

MIDL_INTERFACE("05008617-fbfd-4051-a790-144884b4f6a9")
IDXGIDevice2 : public IDXGIDevice1 {
 public:
  virtual HRESULT STDMETHODCALLTYPE OfferResources(UINT NumResources,
                                                   IDXGIResource* const* ppResources,
                                                   DXGI_OFFER_RESOURCE_PRIORITY Priority) = 0;
  virtual HRESULT STDMETHODCALLTYPE ReclaimResources(
      UINT NumResources, IDXGIResource* const* ppResources, BOOL* pDiscarded) = 0;
  virtual HRESULT STDMETHODCALLTYPE EnqueueSetEvent(HANDLE hEvent) = 0;
};

typedef enum DXGI_SCALING {
  DXGI_SCALING_STRETCH = 0,
  DXGI_SCALING_NONE = 1,
  DXGI_SCALING_ASPECT_RATIO_STRETCH = 2
} DXGI_SCALING;

typedef struct DXGI_SWAP_CHAIN_DESC1 {
  UINT Width;
  UINT Height;
  DXGI_FORMAT Format;
  BOOL Stereo;
  DXGI_SAMPLE_DESC SampleDesc;
  DXGI_USAGE BufferUsage;
  UINT BufferCount;
  DXGI_SCALING Scaling;
  DXGI_SWAP_EFFECT SwapEffect;
  DXGI_ALPHA_MODE AlphaMode;
  UINT Flags;
} DXGI_SWAP_CHAIN_DESC1;

typedef struct DXGI_SWAP_CHAIN_FULLSCREEN_DESC {
  DXGI_RATIONAL RefreshRate;
  DXGI_MODE_SCANLINE_ORDER ScanlineOrdering;
  DXGI_MODE_SCALING Scaling;
  BOOL Windowed;
} DXGI_SWAP_CHAIN_FULLSCREEN_DESC;

typedef struct DXGI_PRESENT_PARAMETERS {
  UINT DirtyRectsCount;
  RECT* pDirtyRects;
  RECT* pScrollRect;
  POINT* pScrollOffset;
} DXGI_PRESENT_PARAMETERS;

MIDL_INTERFACE("790a45f7-0d42-4876-983a-0a55cfe6f4aa")
IDXGISwapChain1 : public IDXGISwapChain {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_SWAP_CHAIN_DESC1 * pDesc) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetFullscreenDesc(DXGI_SWAP_CHAIN_FULLSCREEN_DESC * pDesc) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetHwnd(HWND * pHwnd) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetCoreWindow(REFIID refiid, void** ppUnk) = 0;
  virtual HRESULT STDMETHODCALLTYPE Present1(UINT SyncInterval, UINT PresentFlags,
                                             const DXGI_PRESENT_PARAMETERS* pPresentParameters) = 0;
  virtual BOOL STDMETHODCALLTYPE IsTemporaryMonoSupported() = 0;
  virtual HRESULT STDMETHODCALLTYPE GetRestrictToOutput(IDXGIOutput * *ppRestrictToOutput) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetBackgroundColor(const DXGI_RGBA* pColor) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBackgroundColor(DXGI_RGBA * pColor) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetRotation(DXGI_MODE_ROTATION Rotation) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetRotation(DXGI_MODE_ROTATION * pRotation) = 0;
};

MIDL_INTERFACE("50c83a1c-e072-4c48-87b0-3630fa36a6d0")
IDXGIFactory2 : public IDXGIFactory1 {
 public:
  virtual BOOL STDMETHODCALLTYPE IsWindowedStereoEnabled() = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSwapChainForHwnd(
      IUnknown * pDevice, HWND hWnd, const DXGI_SWAP_CHAIN_DESC1* pDesc,
      const DXGI_SWAP_CHAIN_FULLSCREEN_DESC* pFullscreenDesc, IDXGIOutput* pRestrictToOutput,
      IDXGISwapChain1** ppSwapChain) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSwapChainForCoreWindow(
      IUnknown * pDevice, IUnknown * pWindow, const DXGI_SWAP_CHAIN_DESC1* pDesc,
      IDXGIOutput* pRestrictToOutput, IDXGISwapChain1** ppSwapChain) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetSharedResourceAdapterLuid(HANDLE hResource,
                                                                 LUID * pLuid) = 0;
  virtual HRESULT STDMETHODCALLTYPE RegisterStereoStatusWindow(HWND WindowHandle, UINT wMsg,
                                                               DWORD * pdwCookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE RegisterStereoStatusEvent(HANDLE hEvent, DWORD * pdwCookie) = 0;
  virtual void STDMETHODCALLTYPE UnregisterStereoStatus(DWORD dwCookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE RegisterOcclusionStatusWindow(HWND WindowHandle, UINT wMsg,
                                                                  DWORD * pdwCookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE RegisterOcclusionStatusEvent(HANDLE hEvent,
                                                                 DWORD * pdwCookie) = 0;
  virtual void STDMETHODCALLTYPE UnregisterOcclusionStatus(DWORD dwCookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSwapChainForComposition(
      IUnknown * pDevice, const DXGI_SWAP_CHAIN_DESC1* pDesc, IDXGIOutput* pRestrictToOutput,
      IDXGISwapChain1** ppSwapChain) = 0;
};

typedef enum DXGI_GRAPHICS_PREEMPTION_GRANULARITY {
  DXGI_GRAPHICS_PREEMPTION_DMA_BUFFER_BOUNDARY = 0,
  DXGI_GRAPHICS_PREEMPTION_PRIMITIVE_BOUNDARY = 1,
  DXGI_GRAPHICS_PREEMPTION_TRIANGLE_BOUNDARY = 2,
  DXGI_GRAPHICS_PREEMPTION_PIXEL_BOUNDARY = 3,
  DXGI_GRAPHICS_PREEMPTION_INSTRUCTION_BOUNDARY = 4
} DXGI_GRAPHICS_PREEMPTION_GRANULARITY;

typedef enum DXGI_COMPUTE_PREEMPTION_GRANULARITY {
  DXGI_COMPUTE_PREEMPTION_DMA_BUFFER_BOUNDARY = 0,
  DXGI_COMPUTE_PREEMPTION_DISPATCH_BOUNDARY = 1,
  DXGI_COMPUTE_PREEMPTION_THREAD_GROUP_BOUNDARY = 2,
  DXGI_COMPUTE_PREEMPTION_THREAD_BOUNDARY = 3,
  DXGI_COMPUTE_PREEMPTION_INSTRUCTION_BOUNDARY = 4
} DXGI_COMPUTE_PREEMPTION_GRANULARITY;

typedef struct DXGI_ADAPTER_DESC2 {
  WCHAR Description[128];
  UINT VendorId;
  UINT DeviceId;
  UINT SubSysId;
  UINT Revision;
  SIZE_T DedicatedVideoMemory;
  SIZE_T DedicatedSystemMemory;
  SIZE_T SharedSystemMemory;
  LUID AdapterLuid;
  UINT Flags;
  DXGI_GRAPHICS_PREEMPTION_GRANULARITY GraphicsPreemptionGranularity;
  DXGI_COMPUTE_PREEMPTION_GRANULARITY ComputePreemptionGranularity;
} DXGI_ADAPTER_DESC2;

MIDL_INTERFACE("0aa1ae0a-fa0e-4b84-8644-e05ff8e5acb5")
IDXGIAdapter2 : public IDXGIAdapter1 {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc2(DXGI_ADAPTER_DESC2 * pDesc) = 0;
};

MIDL_INTERFACE("00cddea8-939b-4b83-a340-a685226666cc")
IDXGIOutput1 : public IDXGIOutput {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDisplayModeList1(
      DXGI_FORMAT enumFormat, UINT flags, UINT * numModes, DXGI_MODE_DESC1 * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE FindClosestMatchingMode1(const DXGI_MODE_DESC1* modeToMatch,
                                                             DXGI_MODE_DESC1* closestMatch,
                                                             IUnknown* concernedDevice) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDisplaySurfaceData1(IDXGIResource * destination) = 0;
  virtual HRESULT STDMETHODCALLTYPE DuplicateOutput(
      IUnknown * device, IDXGIOutputDuplication * *outputDuplication) = 0;
};

EXTERN_C const IID IID_IDXGISurface2;
EXTERN_C const IID IID_IDXGIResource1;
EXTERN_C const IID IID_IDXGIDevice2;
EXTERN_C const IID IID_IDXGISwapChain1;
EXTERN_C const IID IID_IDXGIFactory2;
EXTERN_C const IID IID_IDXGIAdapter2;
EXTERN_C const IID IID_IDXGIOutput1;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGISurface2, 0xaba496dd, 0xb617, 0x4cb8, 0xa8, 0x66, 0xbc, 0x44, 0xd7, 0xeb, 0x1f,
                0xa2)
__CRT_UUID_DECL(IDXGIResource1, 0x30961379, 0x4609, 0x4a41, 0x99, 0x8e, 0x54, 0xfe, 0x56, 0x7e,
                0xe0, 0xc1)
__CRT_UUID_DECL(IDXGIDevice2, 0x05008617, 0xfbfd, 0x4051, 0xa7, 0x90, 0x14, 0x48, 0x84, 0xb4, 0xf6,
                0xa9)
__CRT_UUID_DECL(IDXGISwapChain1, 0x790a45f7, 0x0d42, 0x4876, 0x98, 0x3a, 0x0a, 0x55, 0xcf, 0xe6,
                0xf4, 0xaa)
__CRT_UUID_DECL(IDXGIFactory2, 0x50c83a1c, 0xe072, 0x4c48, 0x87, 0xb0, 0x36, 0x30, 0xfa, 0x36, 0xa6,
                0xd0)
__CRT_UUID_DECL(IDXGIAdapter2, 0x0aa1ae0a, 0xfa0e, 0x4b84, 0x86, 0x44, 0xe0, 0x5f, 0xf8, 0xe5, 0xac,
                0xb5)
__CRT_UUID_DECL(IDXGIOutput1, 0x00cddea8, 0x939b, 0x4b83, 0xa3, 0x40, 0xa6, 0x85, 0x22, 0x66, 0x66,
                0xcc)
#endif
