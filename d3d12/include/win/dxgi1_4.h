// SPDX-License-Identifier: MIT
// DXGI 1.4. [DXGI: dxgi1_4.h]
#pragma once

#include <dxgi1_3.h>

typedef enum DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG {
  DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG_PRESENT = 0x1,
  DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG_OVERLAY_PRESENT = 0x2
} DXGI_SWAP_CHAIN_COLOR_SPACE_SUPPORT_FLAG;

typedef enum DXGI_OVERLAY_COLOR_SPACE_SUPPORT_FLAG {
  DXGI_OVERLAY_COLOR_SPACE_SUPPORT_FLAG_PRESENT = 0x1
} DXGI_OVERLAY_COLOR_SPACE_SUPPORT_FLAG;

typedef enum DXGI_MEMORY_SEGMENT_GROUP {
  DXGI_MEMORY_SEGMENT_GROUP_LOCAL = 0x0,
  DXGI_MEMORY_SEGMENT_GROUP_NON_LOCAL = 0x1
} DXGI_MEMORY_SEGMENT_GROUP;

typedef struct DXGI_QUERY_VIDEO_MEMORY_INFO {
  UINT64 Budget;
  UINT64 CurrentUsage;
  UINT64 AvailableForReservation;
  UINT64 CurrentReservation;
} DXGI_QUERY_VIDEO_MEMORY_INFO;

MIDL_INTERFACE("94d99bdb-f1f8-4ab0-b236-7da0170edab1")
IDXGISwapChain3 : public IDXGISwapChain2 {
 public:
  virtual UINT STDMETHODCALLTYPE GetCurrentBackBufferIndex() = 0;
  virtual HRESULT STDMETHODCALLTYPE CheckColorSpaceSupport(DXGI_COLOR_SPACE_TYPE colourSpace,
                                                           UINT * colourSpaceSupport) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetColorSpace1(DXGI_COLOR_SPACE_TYPE colourSpace) = 0;
  virtual HRESULT STDMETHODCALLTYPE ResizeBuffers1(
      UINT bufferCount, UINT width, UINT height, DXGI_FORMAT format, UINT flags,
      const UINT* nodeMask, IUnknown* const* presentQueue) = 0;
};

MIDL_INTERFACE("dc7dca35-2196-414d-9f53-617884032a60")
IDXGIOutput4 : public IDXGIOutput3 {
 public:
  virtual HRESULT STDMETHODCALLTYPE CheckOverlayColorSpaceSupport(
      DXGI_FORMAT format, DXGI_COLOR_SPACE_TYPE colourSpace, IUnknown * device, UINT * flags) = 0;
};

MIDL_INTERFACE("1bc6ea02-ef36-464f-bf0c-21ca39e5168a")
IDXGIFactory4 : public IDXGIFactory3 {
 public:
  virtual HRESULT STDMETHODCALLTYPE EnumAdapterByLuid(LUID luid, REFIID iid, void** adapter) = 0;
  virtual HRESULT STDMETHODCALLTYPE EnumWarpAdapter(REFIID iid, void** adapter) = 0;
};

MIDL_INTERFACE("645967a4-1392-4310-a798-8053ce3e93fd")
IDXGIAdapter3 : public IDXGIAdapter2 {
 public:
  virtual HRESULT STDMETHODCALLTYPE RegisterHardwareContentProtectionTeardownStatusEvent(
      HANDLE event, DWORD * cookie) = 0;
  virtual void STDMETHODCALLTYPE UnregisterHardwareContentProtectionTeardownStatus(
      DWORD cookie) = 0;
  virtual HRESULT STDMETHODCALLTYPE QueryVideoMemoryInfo(
      UINT nodeIndex, DXGI_MEMORY_SEGMENT_GROUP segmentGroup,
      DXGI_QUERY_VIDEO_MEMORY_INFO * memoryInfo) = 0;
  virtual HRESULT STDMETHODCALLTYPE SetVideoMemoryReservation(
      UINT nodeIndex, DXGI_MEMORY_SEGMENT_GROUP segmentGroup, UINT64 reservation) = 0;
  virtual HRESULT STDMETHODCALLTYPE RegisterVideoMemoryBudgetChangeNotificationEvent(
      HANDLE event, DWORD * cookie) = 0;
  virtual void STDMETHODCALLTYPE UnregisterVideoMemoryBudgetChangeNotification(DWORD cookie) = 0;
};

EXTERN_C const IID IID_IDXGISwapChain3;
EXTERN_C const IID IID_IDXGIOutput4;
EXTERN_C const IID IID_IDXGIFactory4;
EXTERN_C const IID IID_IDXGIAdapter3;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGISwapChain3, 0x94d99bdb, 0xf1f8, 0x4ab0, 0xb2, 0x36, 0x7d, 0xa0, 0x17, 0x0e,
                0xda, 0xb1)
__CRT_UUID_DECL(IDXGIOutput4, 0xdc7dca35, 0x2196, 0x414d, 0x9f, 0x53, 0x61, 0x78, 0x84, 0x03, 0x2a,
                0x60)
__CRT_UUID_DECL(IDXGIFactory4, 0x1bc6ea02, 0xef36, 0x464f, 0xbf, 0x0c, 0x21, 0xca, 0x39, 0xe5, 0x16,
                0x8a)
__CRT_UUID_DECL(IDXGIAdapter3, 0x645967a4, 0x1392, 0x4310, 0xa7, 0x98, 0x80, 0x53, 0xce, 0x3e, 0x93,
                0xfd)
#endif
