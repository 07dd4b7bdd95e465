// SPDX-License-Identifier: MIT
#include <directx/d3d12.h>
#include <directx/dxcore.h>
#include <dxgi1_6.h>
#include <dxgidebug.h>
#include <dxguids/dxguids.h>
#include <gtest/gtest.h>
#include <windows.h>

#include <rtapi/rtapi.h>

#include <cstdlib>
#include <string>

#include <wrl/client.h>

#include "d3d12/com/text.h"

namespace kaamos::d3d12 {
namespace {

using Microsoft::WRL::ComPtr;

class DxgiFactory : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("KAAMOS_BACKEND");
    ASSERT_EQ(CreateDXGIFactory2(DXGI_CREATE_FACTORY_DEBUG, __uuidof(IDXGIFactory6),
                                 reinterpret_cast<void**>(factory_.GetAddressOf())),
              S_OK);
  }
  void TearDown() override { unsetenv("KAAMOS_BACKEND"); }

  ComPtr<IDXGIAdapter4> adapter(UINT index) {
    ComPtr<IDXGIAdapter4> out;
    factory_->EnumAdapterByGpuPreference(index, DXGI_GPU_PREFERENCE_HIGH_PERFORMANCE,
                                         __uuidof(IDXGIAdapter4),
                                         reinterpret_cast<void**>(out.GetAddressOf()));
    return out;
  }

  ComPtr<IDXGIFactory6> factory_;
};

TEST_F(DxgiFactory, HasAnAdapterForEachBackend) {
  const auto devices = rtapi::EnumerateDevices();
  for (UINT i = 0; i < devices.size(); ++i) {
    DXGI_ADAPTER_DESC3 desc;
    ASSERT_EQ(adapter(i)->GetDesc3(&desc), S_OK);
    EXPECT_EQ(to_utf8(desc.Description), devices[i].Name);
    EXPECT_EQ(desc.Flags & DXGI_ADAPTER_FLAG3_SOFTWARE, 0);
    EXPECT_GT(desc.DedicatedVideoMemory, SIZE_T{1} << 28);
  }
  ComPtr<IDXGIAdapter1> none;
  EXPECT_EQ(factory_->EnumAdapters1(static_cast<UINT>(devices.size()), none.GetAddressOf()),
            DXGI_ERROR_NOT_FOUND);
  EXPECT_EQ(none.Get(), nullptr);
}

TEST_F(DxgiFactory, TheChosenBackendComesFirst) {
  const auto devices = rtapi::EnumerateDevices();
  setenv("KAAMOS_BACKEND", devices.back().Backend.c_str(), 1);
  DXGI_ADAPTER_DESC1 desc;
  ASSERT_EQ(adapter(0)->GetDesc1(&desc), S_OK);
  EXPECT_EQ(to_utf8(desc.Description), devices.back().Name);
}

TEST_F(DxgiFactory, ADeviceHasTheLuidOfItsAdapter) {
  DXGI_ADAPTER_DESC desc;
  ASSERT_EQ(adapter(0)->GetDesc(&desc), S_OK);
  ComPtr<ID3D12Device> device;
  ASSERT_EQ(D3D12CreateDevice(adapter(0).Get(), D3D_FEATURE_LEVEL_12_0, __uuidof(ID3D12Device),
                              reinterpret_cast<void**>(device.GetAddressOf())),
            S_OK);
  const LUID luid = device->GetAdapterLuid();
  EXPECT_EQ(luid.LowPart, desc.AdapterLuid.LowPart);
  ComPtr<IDXGIAdapter> found;
  EXPECT_EQ(factory_->EnumAdapterByLuid(luid, __uuidof(IDXGIAdapter),
                                        reinterpret_cast<void**>(found.GetAddressOf())),
            S_OK);
  EXPECT_EQ(factory_->EnumAdapterByLuid({77, 0}, __uuidof(IDXGIAdapter),
                                        reinterpret_cast<void**>(found.ReleaseAndGetAddressOf())),
            DXGI_ERROR_NOT_FOUND);
}

TEST_F(DxgiFactory, AnAdapterKnowsItsFactoryAndKeepsData) {
  const auto one = adapter(0);
  ComPtr<IDXGIFactory> parent;
  ASSERT_EQ(one->GetParent(__uuidof(IDXGIFactory), reinterpret_cast<void**>(parent.GetAddressOf())),
            S_OK);
  ComPtr<IUnknown> a, b;
  parent.As(&a);
  factory_.As(&b);
  EXPECT_EQ(a.Get(), b.Get());
  const GUID key = {1, 2, 3, {4}};
  const int value = 41;
  EXPECT_EQ(one->SetPrivateData(key, sizeof(value), &value), S_OK);
  int read = 0;
  UINT size = sizeof(read);
  EXPECT_EQ(one->GetPrivateData(key, &size, &read), S_OK);
  EXPECT_EQ(read, 41);
}

TEST_F(DxgiFactory, TearingIsAllowedAndMemoryHasABudget) {
  BOOL tearing = FALSE;
  EXPECT_EQ(
      factory_->CheckFeatureSupport(DXGI_FEATURE_PRESENT_ALLOW_TEARING, &tearing, sizeof(tearing)),
      S_OK);
  EXPECT_TRUE(tearing);
  EXPECT_EQ(factory_->CheckFeatureSupport(DXGI_FEATURE_PRESENT_ALLOW_TEARING, &tearing, 1),
            E_INVALIDARG);
  DXGI_QUERY_VIDEO_MEMORY_INFO info = {};
  EXPECT_EQ(adapter(0)->QueryVideoMemoryInfo(0, DXGI_MEMORY_SEGMENT_GROUP_LOCAL, &info), S_OK);
  EXPECT_GT(info.CurrentUsage, 0u);
  EXPECT_GT(info.Budget, info.CurrentUsage);
  EXPECT_EQ(factory_->GetCreationFlags(), UINT{DXGI_CREATE_FACTORY_DEBUG});
  ComPtr<IUnknown> debug;
  EXPECT_EQ(DXGIGetDebugInterface1(0, __uuidof(IDXGIInfoQueue),
                                   reinterpret_cast<void**>(debug.GetAddressOf())),
            DXGI_ERROR_SDK_COMPONENT_MISSING);
}

TEST_F(DxgiFactory, TheMonitorHasModes) {
  ComPtr<IDXGIOutput> output;
  ASSERT_EQ(adapter(0)->EnumOutputs(0, output.GetAddressOf()), S_OK);
  DXGI_OUTPUT_DESC desc;
  ASSERT_EQ(output->GetDesc(&desc), S_OK);
  EXPECT_EQ(desc.DesktopCoordinates.right, GetSystemMetrics(SM_CXSCREEN));
  UINT count = 0;
  ASSERT_EQ(output->GetDisplayModeList(DXGI_FORMAT_R8G8B8A8_UNORM, 0, &count, nullptr), S_OK);
  std::vector<DXGI_MODE_DESC> modes(count);
  ASSERT_EQ(output->GetDisplayModeList(DXGI_FORMAT_R8G8B8A8_UNORM, 0, &count, modes.data()), S_OK);
  EXPECT_EQ(modes.back().Width, 1920u);
  --count;
  EXPECT_EQ(output->GetDisplayModeList(DXGI_FORMAT_R8G8B8A8_UNORM, 0, &count, modes.data()),
            DXGI_ERROR_MORE_DATA);
  ASSERT_EQ(output->GetDisplayModeList(DXGI_FORMAT_D32_FLOAT, 0, &count, nullptr), S_OK);
  EXPECT_EQ(count, 0u);
  DXGI_MODE_DESC wanted = {}, closest = {};
  wanted.Width = 1300;
  wanted.Height = 700;
  ASSERT_EQ(output->FindClosestMatchingMode(&wanted, &closest, nullptr), S_OK);
  EXPECT_EQ(closest.Width, 1280u);
  wanted.Width = 0;
  ASSERT_EQ(output->FindClosestMatchingMode(&wanted, &closest, nullptr), S_OK);
  EXPECT_EQ(closest.Width, 1920u);
  EXPECT_EQ(adapter(0)->EnumOutputs(1, output.ReleaseAndGetAddressOf()), DXGI_ERROR_NOT_FOUND);
}

TEST(DxCore, HasTheSameAdapters) {
  ComPtr<IDXCoreAdapterFactory> factory;
  ASSERT_EQ(DXCoreCreateAdapterFactory(__uuidof(IDXCoreAdapterFactory),
                                       reinterpret_cast<void**>(factory.GetAddressOf())),
            S_OK);
  ComPtr<IDXCoreAdapterList> list;
  const GUID graphics[] = {DXCORE_ADAPTER_ATTRIBUTE_D3D12_GRAPHICS};
  ASSERT_EQ(factory->CreateAdapterList(1, graphics, __uuidof(IDXCoreAdapterList),
                                       reinterpret_cast<void**>(list.GetAddressOf())),
            S_OK);
  ASSERT_EQ(list->GetAdapterCount(), rtapi::EnumerateDevices().size());
  ComPtr<IDXCoreAdapter> adapter;
  ASSERT_EQ(list->GetAdapter(0, __uuidof(IDXCoreAdapter),
                             reinterpret_cast<void**>(adapter.GetAddressOf())),
            S_OK);
  size_t size = 0;
  ASSERT_EQ(adapter->GetPropertySize(DXCoreAdapterProperty::DriverDescription, &size), S_OK);
  std::string name(size, ' ');
  ASSERT_EQ(adapter->GetProperty(DXCoreAdapterProperty::DriverDescription, size,
                                 static_cast<void*>(name.data())),
            S_OK);
  EXPECT_EQ(name.c_str(), rtapi::EnumerateDevices()[0].Name);
  EXPECT_EQ(adapter->GetProperty(DXCoreAdapterProperty::DriverDescription, 1,
                                 static_cast<void*>(name.data())),
            E_INVALIDARG);
  EXPECT_TRUE(adapter->IsAttributeSupported(graphics[0]));
  EXPECT_FALSE(adapter->IsPropertySupported(DXCoreAdapterProperty::KmdModelVersion));
  ComPtr<ID3D12Device> device;
  EXPECT_EQ(D3D12CreateDevice(adapter.Get(), D3D_FEATURE_LEVEL_12_0, __uuidof(ID3D12Device),
                              reinterpret_cast<void**>(device.GetAddressOf())),
            S_OK);
  const GUID older[] = {DXCORE_ADAPTER_ATTRIBUTE_D3D11_GRAPHICS};
  ASSERT_EQ(factory->CreateAdapterList(1, older, __uuidof(IDXCoreAdapterList),
                                       reinterpret_cast<void**>(list.ReleaseAndGetAddressOf())),
            S_OK);
  EXPECT_EQ(list->GetAdapterCount(), 0u);
}

}  // namespace
}  // namespace kaamos::d3d12
