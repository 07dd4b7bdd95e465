// SPDX-License-Identifier: MIT
// Interfaces and flags that the included d3d12.h is too old for, as in Agility SDK 1.619: devices
// up to ID3D12Device14, lists up to ID3D12GraphicsCommandList9.
#pragma once

#include <directx/d3d12.h>

#ifndef __ID3D12Device12_INTERFACE_DEFINED__
#define __ID3D12Device12_INTERFACE_DEFINED__
EXTERN_C const IID IID_ID3D12Device12;
MIDL_INTERFACE("5af5c532-4c91-4cd0-b541-15a405395fc5")
ID3D12Device12 : public ID3D12Device11 {
 public:
  virtual D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE GetResourceAllocationInfo3(
      UINT visibleMask, UINT numResourceDescs, const D3D12_RESOURCE_DESC1* pResourceDescs,
      const UINT32* pNumCastableFormats, const DXGI_FORMAT* const* ppCastableFormats,
      D3D12_RESOURCE_ALLOCATION_INFO1* pResourceAllocationInfo1) = 0;
};
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(ID3D12Device12, 0x5af5c532, 0x4c91, 0x4cd0, 0xb5, 0x41, 0x15, 0xa4, 0x05, 0x39,
                0x5f, 0xc5)
#endif
#endif

#ifndef __ID3D12Device13_INTERFACE_DEFINED__
#define __ID3D12Device13_INTERFACE_DEFINED__
EXTERN_C const IID IID_ID3D12Device13;
MIDL_INTERFACE("14eecffc-4df8-40f7-a118-5c816f45695e")
ID3D12Device13 : public ID3D12Device12 {
 public:
  virtual HRESULT STDMETHODCALLTYPE OpenExistingHeapFromAddress1(const void* pAddress, SIZE_T size,
                                                                 REFIID riid, void** ppvHeap) = 0;
};
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(ID3D12Device13, 0x14eecffc, 0x4df8, 0x40f7, 0xa1, 0x18, 0x5c, 0x81, 0x6f, 0x45,
                0x69, 0x5e)
#endif
#endif

#ifndef __ID3D12Device14_INTERFACE_DEFINED__
#define __ID3D12Device14_INTERFACE_DEFINED__
EXTERN_C const IID IID_ID3D12Device14;
MIDL_INTERFACE("5f6e592d-d895-44c2-8e4a-88ad4926d323")
ID3D12Device14 : public ID3D12Device13 {
 public:
  virtual HRESULT STDMETHODCALLTYPE CreateRootSignatureFromSubobjectInLibrary(
      UINT nodeMask, const void* pLibraryBlob, SIZE_T blobLengthInBytes, LPCWSTR subobjectName,
      REFIID riid, void** ppvRootSignature) = 0;
};
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(ID3D12Device14, 0x5f6e592d, 0xd895, 0x44c2, 0x8e, 0x4a, 0x88, 0xad, 0x49, 0x26,
                0xd3, 0x23)
#endif
#endif

#ifndef __ID3D12GraphicsCommandList9_INTERFACE_DEFINED__
#define __ID3D12GraphicsCommandList9_INTERFACE_DEFINED__
EXTERN_C const IID IID_ID3D12GraphicsCommandList9;
MIDL_INTERFACE("34ed2808-ffe6-4c2b-b11a-cabd2b0c59e1")
ID3D12GraphicsCommandList9 : public ID3D12GraphicsCommandList8 {
 public:
  virtual void STDMETHODCALLTYPE RSSetDepthBias(FLOAT DepthBias, FLOAT DepthBiasClamp,
                                                FLOAT SlopeScaledDepthBias) = 0;
  virtual void STDMETHODCALLTYPE IASetIndexBufferStripCutValue(
      D3D12_INDEX_BUFFER_STRIP_CUT_VALUE IBStripCutValue) = 0;
};
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(ID3D12GraphicsCommandList9, 0x34ed2808, 0xffe6, 0x4c2b, 0xb1, 0x1a, 0xca, 0xbd,
                0x2b, 0x0c, 0x59, 0xe1)
#endif
#endif
