// SPDX-License-Identifier: MIT
// DXGI 1.6. [DXGI: dxgi1_6.h]
#pragma once

#include <dxgi1_5.h>

typedef enum DXGI_ADAPTER_FLAG3 {
  DXGI_ADAPTER_FLAG3_NONE = 0x0,
  DXGI_ADAPTER_FLAG3_REMOTE = 0x1,
  DXGI_ADAPTER_FLAG3_SOFTWARE = 0x2,
  DXGI_ADAPTER_FLAG3_ACG_COMPATIBLE = 0x4,
  DXGI_ADAPTER_FLAG3_SUPPORT_MONITORED_FENCES = 0x8,
  DXGI_ADAPTER_FLAG3_SUPPORT_NON_MONITORED_FENCES = 0x10,
  DXGI_ADAPTER_FLAG3_KEYED_MUTEX_CONFORMANCE = 0x20,
  DXGI_ADAPTER_FLAG3_FORCE_DWORD = 0xffffffff
} DXGI_ADAPTER_FLAG3;

typedef enum DXGI_HARDWARE_COMPOSITION_SUPPORT_FLAGS {
  DXGI_HARDWARE_COMPOSITION_SUPPORT_FLAG_FULLSCREEN = 0x1,
  DXGI_HARDWARE_COMPOSITION_SUPPORT_FLAG_WINDOWED = 0x2,
  DXGI_HARDWARE_COMPOSITION_SUPPORT_FLAG_CURSOR_STRETCHED = 0x4
} DXGI_HARDWARE_COMPOSITION_SUPPORT_FLAGS;

typedef enum DXGI_GPU_PREFERENCE {
  DXGI_GPU_PREFERENCE_UNSPECIFIED = 0x0,
  DXGI_GPU_PREFERENCE_MINIMUM_POWER = 0x1,
  DXGI_GPU_PREFERENCE_HIGH_PERFORMANCE = 0x2
} DXGI_GPU_PREFERENCE;

typedef struct DXGI_ADAPTER_DESC3 {
  WCHAR Description[128];
  UINT VendorId;
  UINT DeviceId;
  UINT SubSysId;
  UINT Revision;
  SIZE_T DedicatedVideoMemory;
  SIZE_T DedicatedSystemMemory;
  SIZE_T SharedSystemMemory;
  LUID AdapterLuid;
  DXGI_ADAPTER_FLAG3 Flags;
  DXGI_GRAPHICS_PREEMPTION_GRANULARITY GraphicsPreemptionGranularity;
  DXGI_COMPUTE_PREEMPTION_GRANULARITY ComputePreemptionGranularity;
} DXGI_ADAPTER_DESC3;

typedef struct DXGI_OUTPUT_DESC1 {
  WCHAR DeviceName[32];
  RECT DesktopCoordinates;
  BOOL AttachedToDesktop;
  DXGI_MODE_ROTATION Rotation;
  HMONITOR Monitor;
  UINT BitsPerColor;
  DXGI_COLOR_SPACE_TYPE ColorSpace;
  FLOAT RedPrimary[2];
  FLOAT GreenPrimary[2];
  FLOAT BluePrimary[2];
  FLOAT WhitePoint[2];
  FLOAT MinLuminance;
  FLOAT MaxLuminance;
  FLOAT MaxFullFrameLuminance;
} DXGI_OUTPUT_DESC1;

MIDL_INTERFACE("3c8d99d1-4fbf-4181-a82c-af66bf7bd24e")
IDXGIAdapter4 : public IDXGIAdapter3 {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc3(DXGI_ADAPTER_DESC3 * desc) = 0;
};

MIDL_INTERFACE("068346e8-aaec-4b84-add7-137f513f77a1")
IDXGIOutput6 : public IDXGIOutput5 {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_OUTPUT_DESC1 * desc) = 0;
  virtual HRESULT STDMETHODCALLTYPE CheckHardwareCompositionSupport(UINT * flags) = 0;
};

MIDL_INTERFACE("c1b6694f-ff09-44a9-b03c-77900a0a1d17")
IDXGIFactory6 : public IDXGIFactory5 {
 public:
  virtual HRESULT STDMETHODCALLTYPE EnumAdapterByGpuPreference(
      UINT adapterIdx, DXGI_GPU_PREFERENCE gpuPreference, REFIID iid, void** adapter) = 0;
};

MIDL_INTERFACE("a4966eed-76db-44da-84c1-ee9a7afb20a8")
IDXGIFactory7 : public IDXGIFactory6 {
 public:
  virtual HRESULT STDMETHODCALLTYPE RegisterAdaptersChangedEvent(HANDLE event, DWORD * cookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE UnregisterAdaptersChangedEvent(DWORD cookie) = 0;
};

STDAPI DXGIDeclareAdapterRemovalSupport();

EXTERN_C const IID IID_IDXGIAdapter4;
EXTERN_C const IID IID_IDXGIOutput6;
EXTERN_C const IID IID_IDXGIFactory6;
EXTERN_C const IID IID_IDXGIFactory7;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGIAdapter4, 0x3c8d99d1, 0x4fbf, 0x4181, 0xa8, 0x2c, 0xaf, 0x66, 0xbf, 0x7b, 0xd2,
                0x4e)
__CRT_UUID_DECL(IDXGIOutput6, 0x068346e8, 0xaaec, 0x4b84, 0xad, 0xd7, 0x13, 0x7f, 0x51, 0x3f, 0x77,
                0xa1)
__CRT_UUID_DECL(IDXGIFactory6, 0xc1b6694f, 0xff09, 0x44a9, 0xb0, 0x3c, 0x77, 0x90, 0x0a, 0x0a, 0x1d,
                0x17)
__CRT_UUID_DECL(IDXGIFactory7, 0xa4966eed, 0x76db, 0x44da, 0x84, 0xc1, 0xee, 0x9a, 0x7a, 0xfb, 0x20,
                0xa8)
#endif
