// SPDX-License-Identifier: MIT
// DXGI: factories, adapters, outputs, swap chains. [DXGI: dxgi.h]
#pragma once

#include <dxgitype.h>
#include <objbase.h>
#include <windef.h>

typedef UINT DXGI_USAGE;

typedef struct DXGI_SHARED_RESOURCE {
  HANDLE Handle;
} DXGI_SHARED_RESOURCE;

#define DXGI_CPU_ACCESS_NONE 0
#define DXGI_CPU_ACCESS_DYNAMIC 1
#define DXGI_CPU_ACCESS_READ_WRITE 2
#define DXGI_CPU_ACCESS_SCRATCH 3
#define DXGI_CPU_ACCESS_FIELD 15
#define DXGI_USAGE_SHADER_INPUT 0x10
#define DXGI_USAGE_RENDER_TARGET_OUTPUT 0x20
#define DXGI_USAGE_BACK_BUFFER 0x40
#define DXGI_USAGE_SHARED 0x80
#define DXGI_USAGE_READ_ONLY 0x100
#define DXGI_USAGE_DISCARD_ON_PRESENT 0x200
#define DXGI_USAGE_UNORDERED_ACCESS 0x400
#define DXGI_ENUM_MODES_INTERLACED 1
#define DXGI_ENUM_MODES_SCALING 2
#define DXGI_RESOURCE_PRIORITY_MINIMUM 0x28000000
#define DXGI_RESOURCE_PRIORITY_LOW 0x50000000
#define DXGI_RESOURCE_PRIORITY_NORMAL 0x78000000
#define DXGI_RESOURCE_PRIORITY_HIGH 0xA0000000
#define DXGI_RESOURCE_PRIORITY_MAXIMUM 0xC8000000
#define DXGI_MAP_READ 0x1
#define DXGI_MAP_WRITE 0x2
#define DXGI_MAP_DISCARD 0x4

typedef enum DXGI_SWAP_EFFECT {
  DXGI_SWAP_EFFECT_DISCARD = 0,
  DXGI_SWAP_EFFECT_SEQUENTIAL = 1,
  DXGI_SWAP_EFFECT_FLIP_SEQUENTIAL = 3,
  DXGI_SWAP_EFFECT_FLIP_DISCARD = 4
} DXGI_SWAP_EFFECT;

typedef enum DXGI_RESIDENCY {
  DXGI_RESIDENCY_FULLY_RESIDENT = 1,
  DXGI_RESIDENCY_RESIDENT_IN_SHARED_MEMORY = 2,
  DXGI_RESIDENCY_EVICTED_TO_DISK = 3
} DXGI_RESIDENCY;

typedef struct DXGI_SURFACE_DESC {
  UINT Width;
  UINT Height;
  DXGI_FORMAT Format;
  DXGI_SAMPLE_DESC SampleDesc;
} DXGI_SURFACE_DESC;

typedef struct DXGI_MAPPED_RECT {
  INT Pitch;
  BYTE* pBits;
} DXGI_MAPPED_RECT;

typedef struct DXGI_OUTPUT_DESC {
  WCHAR DeviceName[32];
  RECT DesktopCoordinates;
  BOOL AttachedToDesktop;
  DXGI_MODE_ROTATION Rotation;
  HMONITOR Monitor;
} DXGI_OUTPUT_DESC;

typedef struct DXGI_FRAME_STATISTICS {
  UINT PresentCount;
  UINT PresentRefreshCount;
  UINT SyncRefreshCount;
  LARGE_INTEGER SyncQPCTime;
  LARGE_INTEGER SyncGPUTime;
} DXGI_FRAME_STATISTICS;

typedef struct DXGI_ADAPTER_DESC {
  WCHAR Description[128];
  UINT VendorId;
  UINT DeviceId;
  UINT SubSysId;
  UINT Revision;
  SIZE_T DedicatedVideoMemory;
  SIZE_T DedicatedSystemMemory;
  SIZE_T SharedSystemMemory;
  LUID AdapterLuid;
} DXGI_ADAPTER_DESC;

typedef enum DXGI_SWAP_CHAIN_FLAG {
  DXGI_SWAP_CHAIN_FLAG_NONPREROTATED = 0x1,
  DXGI_SWAP_CHAIN_FLAG_ALLOW_MODE_SWITCH = 0x2,
  DXGI_SWAP_CHAIN_FLAG_GDI_COMPATIBLE = 0x4,
  DXGI_SWAP_CHAIN_FLAG_RESTRICTED_CONTENT = 0x8,
  DXGI_SWAP_CHAIN_FLAG_RESTRICT_SHARED_RESOURCE_DRIVER = 0x10,
  DXGI_SWAP_CHAIN_FLAG_DISPLAY_ONLY = 0x20,
  DXGI_SWAP_CHAIN_FLAG_FRAME_LATENCY_WAITABLE_OBJECT = 0x40,
  DXGI_SWAP_CHAIN_FLAG_FOREGROUND_LAYER = 0x80,
  DXGI_SWAP_CHAIN_FLAG_FULLSCREEN_VIDEO = 0x100,
  DXGI_SWAP_CHAIN_FLAG_YUV_VIDEO = 0x200,
  DXGI_SWAP_CHAIN_FLAG_HW_PROTECTED = 0x400,
  DXGI_SWAP_CHAIN_FLAG_ALLOW_TEARING = 0x800,
  DXGI_SWAP_CHAIN_FLAG_RESTRICTED_TO_ALL_HOLOGRAPHIC_DISPLAYS = 0x1000
} DXGI_SWAP_CHAIN_FLAG;

typedef struct DXGI_SWAP_CHAIN_DESC {
  DXGI_MODE_DESC BufferDesc;
  DXGI_SAMPLE_DESC SampleDesc;
  DXGI_USAGE BufferUsage;
  UINT BufferCount;
  HWND OutputWindow;
  BOOL Windowed;
  DXGI_SWAP_EFFECT SwapEffect;
  UINT Flags;
} DXGI_SWAP_CHAIN_DESC;

MIDL_INTERFACE("aec22fb8-76f3-4639-9be0-28eb43a67a2e")
IDXGIObject : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE SetPrivateData(REFGUID guid, UINT dataSize,
                                                   const void* data) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetPrivateDataInterface(REFGUID guid,
                                                            const IUnknown* object) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPrivateData(REFGUID guid, UINT * dataSize, void* data) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetParent(REFIID riid, void** parent) = 0;
};

MIDL_INTERFACE("3d3e0379-f9de-4d58-bb6c-18d62992f1a6")
IDXGIDeviceSubObject : public IDXGIObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDevice(REFIID riid, void** device) = 0;
};

MIDL_INTERFACE("035f3ab4-482e-4e50-b41f-8a7f8bd8960b")
IDXGIResource : public IDXGIDeviceSubObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetSharedHandle(HANDLE * pSharedHandle) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetUsage(DXGI_USAGE * pUsage) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetEvictionPriority(UINT EvictionPriority) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetEvictionPriority(UINT * pEvictionPriority) = 0;
};

MIDL_INTERFACE("cafcb56c-6ac3-4889-bf47-9e23bbd260ec")
IDXGISurface : public IDXGIDeviceSubObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc(DXGI_SURFACE_DESC * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE Map(DXGI_MAPPED_RECT * mappedRect, UINT flags) = 0;
  virtual HRESULT STDMETHODCALLTYPE Unmap() = 0;
};

MIDL_INTERFACE("4ae63092-6327-4c1b-80ae-bfe12ea32b86")
IDXGISurface1 : public IDXGISurface {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDC(BOOL discard, HDC * hdc) = 0;
  virtual HRESULT STDMETHODCALLTYPE ReleaseDC(RECT * dirtyRect) = 0;
};

MIDL_INTERFACE("ae02eedb-c735-4690-8d52-5a8dc20213aa")
IDXGIOutput : public IDXGIObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc(DXGI_OUTPUT_DESC * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDisplayModeList(DXGI_FORMAT format, UINT flags,
                                                       UINT * modeCount, DXGI_MODE_DESC * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE FindClosestMatchingMode(
      const DXGI_MODE_DESC* mode, DXGI_MODE_DESC* closestMatch, IUnknown* device) = 0;
  virtual HRESULT STDMETHODCALLTYPE WaitForVBlank() = 0;
  virtual HRESULT STDMETHODCALLTYPE TakeOwnership(IUnknown * device, BOOL exclusive) = 0;
  virtual void STDMETHODCALLTYPE ReleaseOwnership() = 0;
  virtual HRESULT STDMETHODCALLTYPE GetGammaControlCapabilities(DXGI_GAMMA_CONTROL_CAPABILITIES *
                                                                gammaCaps) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetGammaControl(const DXGI_GAMMA_CONTROL* gammaControl) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetGammaControl(DXGI_GAMMA_CONTROL * gammaControl) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetDisplaySurface(IDXGISurface * surface) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDisplaySurfaceData(IDXGISurface * surface) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetFrameStatistics(DXGI_FRAME_STATISTICS * stats) = 0;
};

MIDL_INTERFACE("2411e7e1-12ac-4ccf-bd14-9798e8534dc0")
IDXGIAdapter : public IDXGIObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE EnumOutputs(UINT outputIdx, IDXGIOutput * *output) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDesc(DXGI_ADAPTER_DESC * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE CheckInterfaceSupport(REFGUID guid,
                                                          LARGE_INTEGER * umdVersion) = 0;
};

#define DXGI_MAX_SWAP_CHAIN_BUFFERS 16
#define DXGI_PRESENT_TEST 0x1
#define DXGI_PRESENT_DO_NOT_SEQUENCE 0x2
#define DXGI_PRESENT_RESTART 0x4
#define DXGI_PRESENT_DO_NOT_WAIT 0x8
#define DXGI_PRESENT_STEREO_PREFER_RIGHT 0x10
#define DXGI_PRESENT_STEREO_TEMPORARY_MONO 0x20
#define DXGI_PRESENT_RESTRICT_TO_OUTPUT 0x40
#define DXGI_PRESENT_USE_DURATION 0x100
#define DXGI_PRESENT_ALLOW_TEARING 0x200

MIDL_INTERFACE("310d36a0-d2e7-4c0a-aa04-6a9d23b8886a")
IDXGISwapChain : public IDXGIDeviceSubObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE Present(UINT syncInterval, UINT flags) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBuffer(UINT bufferIdx, REFIID riid, void** surface) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetFullscreenState(BOOL fullscreen, IDXGIOutput * target) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetFullscreenState(BOOL * fullscreen,
                                                       IDXGIOutput * *target) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDesc(DXGI_SWAP_CHAIN_DESC * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE ResizeBuffers(UINT bufferCount, UINT width, UINT height,
                                                  DXGI_FORMAT format, UINT flags) = 0;
  virtual HRESULT STDMETHODCALLTYPE ResizeTarget(const DXGI_MODE_DESC* targetModeDesc) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetContainingOutput(IDXGIOutput * *output) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetFrameStatistics(DXGI_FRAME_STATISTICS * stats) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetLastPresentCount(UINT * lastPresentCount) = 0;
};

#define DXGI_MWA_NO_WINDOW_CHANGES 0x1
#define DXGI_MWA_NO_ALT_ENTER 0x2
#define DXGI_MWA_NO_PRINT_SCREEN 0x4
#define DXGI_MWA_VALID 0x7

MIDL_INTERFACE("7b7166ec-21c7-44ae-b21a-c9ae321ae369")
IDXGIFactory : public IDXGIObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE EnumAdapters(UINT adapterIdx, IDXGIAdapter * *adapter) = 0;
  virtual HRESULT STDMETHODCALLTYPE MakeWindowAssociation(HWND window, UINT flags) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetWindowAssociation(HWND * window) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSwapChain(IUnknown * device, DXGI_SWAP_CHAIN_DESC * desc,
                                                    IDXGISwapChain * *swapchain) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSoftwareAdapter(HMODULE swrast,
                                                          IDXGIAdapter * *adapter) = 0;
};

MIDL_INTERFACE("54ec77fa-1377-44e6-8c32-88fd5f44c84c")
IDXGIDevice : public IDXGIObject {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetAdapter(IDXGIAdapter * *adapter) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateSurface(
      const DXGI_SURFACE_DESC* desc, UINT surfaceCount, DXGI_USAGE usage,
      const DXGI_SHARED_RESOURCE* sharedResource, IDXGISurface** surface) = 0;
  virtual HRESULT STDMETHODCALLTYPE QueryResourceResidency(
      IUnknown* const* resources, DXGI_RESIDENCY* residency, UINT resourceCount) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetGPUThreadPriority(INT priority) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetGPUThreadPriority(INT * priority) = 0;
};

typedef enum DXGI_ADAPTER_FLAG {
  DXGI_ADAPTER_FLAG_NONE = 0,
  DXGI_ADAPTER_FLAG_REMOTE = 1,
  DXGI_ADAPTER_FLAG_SOFTWARE = 2,
  DXGI_ADAPTER_FLAG_FORCE_DWORD = 0xffffffff
} DXGI_ADAPTER_FLAG;

typedef struct DXGI_ADAPTER_DESC1 {
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
} DXGI_ADAPTER_DESC1;

MIDL_INTERFACE("29038f61-3839-4626-91fd-086879011a05")
IDXGIAdapter1 : public IDXGIAdapter {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_ADAPTER_DESC1 * pDesc) = 0;
};

MIDL_INTERFACE("77db970f-6276-48ba-ba28-070143b4392c")
IDXGIDevice1 : public IDXGIDevice {
 public:
  virtual HRESULT STDMETHODCALLTYPE SetMaximumFrameLatency(UINT MaxLatency) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetMaximumFrameLatency(UINT * pMaxLatency) = 0;
};

MIDL_INTERFACE("770aae78-f26f-4dba-a829-253c83d1b387")
IDXGIFactory1 : public IDXGIFactory {
 public:
  virtual HRESULT STDMETHODCALLTYPE EnumAdapters1(UINT Adapter, IDXGIAdapter1 * *ppAdapter) = 0;
  virtual BOOL STDMETHODCALLTYPE IsCurrent() = 0;
};

STDAPI CreateDXGIFactory(REFIID riid, void** factory);
STDAPI CreateDXGIFactory1(REFIID riid, void** factory);

EXTERN_C const IID IID_IDXGIObject;
EXTERN_C const IID IID_IDXGIDeviceSubObject;
EXTERN_C const IID IID_IDXGIResource;
EXTERN_C const IID IID_IDXGISurface;
EXTERN_C const IID IID_IDXGISurface1;
EXTERN_C const IID IID_IDXGIOutput;
EXTERN_C const IID IID_IDXGIAdapter;
EXTERN_C const IID IID_IDXGISwapChain;
EXTERN_C const IID IID_IDXGIFactory;
EXTERN_C const IID IID_IDXGIDevice;
EXTERN_C const IID IID_IDXGIAdapter1;
EXTERN_C const IID IID_IDXGIDevice1;
EXTERN_C const IID IID_IDXGIFactory1;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGIObject, 0xaec22fb8, 0x76f3, 0x4639, 0x9b, 0xe0, 0x28, 0xeb, 0x43, 0xa6, 0x7a,
                0x2e)
__CRT_UUID_DECL(IDXGIDeviceSubObject, 0x3d3e0379, 0xf9de, 0x4d58, 0xbb, 0x6c, 0x18, 0xd6, 0x29,
                0x92, 0xf1, 0xa6)
__CRT_UUID_DECL(IDXGIResource, 0x035f3ab4, 0x482e, 0x4e50, 0xb4, 0x1f, 0x8a, 0x7f, 0x8b, 0xd8, 0x96,
                0x0b)
__CRT_UUID_DECL(IDXGISurface, 0xcafcb56c, 0x6ac3, 0x4889, 0xbf, 0x47, 0x9e, 0x23, 0xbb, 0xd2, 0x60,
                0xec)
__CRT_UUID_DECL(IDXGISurface1, 0x4ae63092, 0x6327, 0x4c1b, 0x80, 0xae, 0xbf, 0xe1, 0x2e, 0xa3, 0x2b,
                0x86)
__CRT_UUID_DECL(IDXGIOutput, 0xae02eedb, 0xc735, 0x4690, 0x8d, 0x52, 0x5a, 0x8d, 0xc2, 0x02, 0x13,
                0xaa)
__CRT_UUID_DECL(IDXGIAdapter, 0x2411e7e1, 0x12ac, 0x4ccf, 0xbd, 0x14, 0x97, 0x98, 0xe8, 0x53, 0x4d,
                0xc0)
__CRT_UUID_DECL(IDXGISwapChain, 0x310d36a0, 0xd2e7, 0x4c0a, 0xaa, 0x04, 0x6a, 0x9d, 0x23, 0xb8,
                0x88, 0x6a)
__CRT_UUID_DECL(IDXGIFactory, 0x7b7166ec, 0x21c7, 0x44ae, 0xb2, 0x1a, 0xc9, 0xae, 0x32, 0x1a, 0xe3,
                0x69)
__CRT_UUID_DECL(IDXGIDevice, 0x54ec77fa, 0x1377, 0x44e6, 0x8c, 0x32, 0x88, 0xfd, 0x5f, 0x44, 0xc8,
                0x4c)
__CRT_UUID_DECL(IDXGIAdapter1, 0x29038f61, 0x3839, 0x4626, 0x91, 0xfd, 0x08, 0x68, 0x79, 0x01, 0x1a,
                0x05)
__CRT_UUID_DECL(IDXGIDevice1, 0x77db970f, 0x6276, 0x48ba, 0xba, 0x28, 0x07, 0x01, 0x43, 0xb4, 0x39,
                0x2c)
__CRT_UUID_DECL(IDXGIFactory1, 0x770aae78, 0xf26f, 0x4dba, 0xa8, 0x29, 0x25, 0x3c, 0x83, 0xd1, 0xb3,
                0x87)
#endif
