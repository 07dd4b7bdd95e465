// SPDX-License-Identifier: MIT
// DXGI 1.5. [DXGI: dxgi1_5.h]
#pragma once

#include <dxgi1_4.h>

typedef enum DXGI_HDR_METADATA_TYPE {
  DXGI_HDR_METADATA_TYPE_NONE = 0x0,
  DXGI_HDR_METADATA_TYPE_HDR10 = 0x1,
  DXGI_HDR_METADATA_TYPE_HDR10PLUS = 0x2
} DXGI_HDR_METADATA_TYPE;

typedef enum DXGI_OFFER_RESOURCE_FLAGS {
  DXGI_OFFER_RESOURCE_FLAG_ALLOW_DECOMMIT = 0x1
} DXGI_OFFER_RESOURCE_FLAGS;

typedef enum DXGI_RECLAIM_RESOURCE_RESULTS {
  DXGI_RECLAIM_RESOURCE_RESULT_OK = 0x0,
  DXGI_RECLAIM_RESOURCE_RESULT_DISCARDED = 0x1,
  DXGI_RECLAIM_RESOURCE_RESULT_NOT_COMMITTED = 0x2
} DXGI_RECLAIM_RESOURCE_RESULTS;

typedef enum DXGI_FEATURE { DXGI_FEATURE_PRESENT_ALLOW_TEARING = 0x0 } DXGI_FEATURE;

typedef struct DXGI_HDR_METADATA_HDR10 {
  UINT16 RedPrimary[2];
  UINT16 GreenPrimary[2];
  UINT16 BluePrimary[2];
  UINT16 WhitePoint[2];
  UINT MaxMasteringLuminance;
  UINT MinMasteringLuminance;
  UINT16 MaxContentLightLevel;
  UINT16 MaxFrameAverageLightLevel;
} DXGI_HDR_METADATA_HDR10;

typedef struct DXGI_HDR_METADATA_HDR10PLUS {
  BYTE Data[72];
} DXGI_HDR_METADATA_HDR10PLUS;

MIDL_INTERFACE("80a07424-ab52-42eb-833c-0c42fd282d98")
IDXGIOutput5 : public IDXGIOutput4 {
 public:
  virtual HRESULT STDMETHODCALLTYPE DuplicateOutput1(IUnknown * device, UINT flags,
                                                     UINT formatCount, const DXGI_FORMAT* formats,
                                                     IDXGIOutputDuplication** duplication) = 0;
};

MIDL_INTERFACE("3d585d5a-bd4a-489e-b1f4-3dbcb6452ffb")
IDXGISwapChain4 : public IDXGISwapChain3 {
 public:
  virtual HRESULT STDMETHODCALLTYPE SetHDRMetaData(DXGI_HDR_METADATA_TYPE type, UINT size,
                                                   void* metadata) = 0;
};

MIDL_INTERFACE("95b4f95f-d8da-4ca4-9ee6-3b76d5968a10")
IDXGIDevice4 : public IDXGIDevice3 {
 public:
  virtual HRESULT STDMETHODCALLTYPE OfferResources1(
      UINT resourceCount, IDXGIResource* const* resources, DXGI_OFFER_RESOURCE_PRIORITY priority,
      UINT flags) = 0;
  virtual HRESULT STDMETHODCALLTYPE ReclaimResources1(UINT resourceCount,
                                                      IDXGIResource* const* resources,
                                                      DXGI_RECLAIM_RESOURCE_RESULTS* results) = 0;
};

MIDL_INTERFACE("7632e1f5-ee65-4dca-87fd-84cd75f8838d")
IDXGIFactory5 : public IDXGIFactory4 {
 public:
  virtual HRESULT STDMETHODCALLTYPE CheckFeatureSupport(DXGI_FEATURE feature, void* supportData,
                                                        UINT supportDataSize) = 0;
};

EXTERN_C const IID IID_IDXGIOutput5;
EXTERN_C const IID IID_IDXGISwapChain4;
EXTERN_C const IID IID_IDXGIDevice4;
EXTERN_C const IID IID_IDXGIFactory5;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDXGIOutput5, 0x80a07424, 0xab52, 0x42eb, 0x83, 0x3c, 0x0c, 0x42, 0xfd, 0x28, 0x2d,
                0x98)
__CRT_UUID_DECL(IDXGISwapChain4, 0x3d585d5a, 0xbd4a, 0x489e, 0xb1, 0xf4, 0x3d, 0xbc, 0xb6, 0x45,
                0x2f, 0xfb)
__CRT_UUID_DECL(IDXGIDevice4, 0x95b4f95f, 0xd8da, 0x4ca4, 0x9e, 0xe6, 0x3b, 0x76, 0xd5, 0x96, 0x8a,
                0x10)
__CRT_UUID_DECL(IDXGIFactory5, 0x7632e1f5, 0xee65, 0x4dca, 0x87, 0xfd, 0x84, 0xcd, 0x75, 0xf8, 0x83,
                0x8d)
#endif
