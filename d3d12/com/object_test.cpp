// SPDX-License-Identifier: MIT
// COM's rules of identity and reference counts, private data, and entries of missing methods.
#include "d3d12/com/object.h"

#include <windows.h>

#include <directx/d3d12.h>
#include <dxguids/dxguids.h>
#include <gtest/gtest.h>

#include <thread>

#include "d3d12/com/blob.h"
#include "d3d12/com/private_data.h"
#include "d3d12/com/report_fixture.h"

namespace kaamos::d3d12 {
namespace {

using Microsoft::WRL::ComPtr;

class Both final
    : public NamedObject<ID3D12StateObjectEntries, ID3D12StateObjectPropertiesEntries> {
 public:
  explicit Both(bool* gone = nullptr) : gone_(gone) {}
  HRESULT STDMETHODCALLTYPE GetDevice(REFIID, void**) override { return E_NOTIMPL; }

 protected:
  ~Both() override {
    if (gone_ != nullptr) *gone_ = true;
  }

 private:
  bool* gone_;
};

ULONG references(IUnknown* object) {
  object->AddRef();
  return object->Release();
}

TEST(ComObject, EveryInterfaceLeadsToOneIdentity) {
  ComPtr<Both> both;
  both.Attach(new Both);
  ComPtr<ID3D12StateObjectProperties> properties;
  ASSERT_EQ(both->QueryInterface(IID_PPV_ARGS(properties.GetAddressOf())), S_OK);
  ComPtr<ID3D12Object> object;
  ASSERT_EQ(properties->QueryInterface(IID_PPV_ARGS(object.GetAddressOf())), S_OK);
  ComPtr<IUnknown> from_first, from_second;
  ASSERT_EQ(object->QueryInterface(IID_PPV_ARGS(from_first.GetAddressOf())), S_OK);
  ASSERT_EQ(properties->QueryInterface(IID_PPV_ARGS(from_second.GetAddressOf())), S_OK);
  EXPECT_EQ(from_first.Get(), from_second.Get());
  EXPECT_NE(static_cast<void*>(object.Get()), static_cast<void*>(properties.Get()));
}

TEST(ComObject, AnInterfaceThatItLacksIsRefusedAndTheResultNull) {
  ComPtr<Both> both;
  both.Attach(new Both);
  void* result = &result;
  EXPECT_EQ(both->QueryInterface(__uuidof(ID3D12Fence), &result), E_NOINTERFACE);
  EXPECT_EQ(result, nullptr);
  EXPECT_EQ(both->QueryInterface(__uuidof(ID3D12Object), nullptr), E_POINTER);
  EXPECT_EQ(references(static_cast<ID3D12StateObject*>(both.Get())), 1u);
}

TEST(ComObject, TheLastReleaseFreesIt) {
  bool gone = false;
  ID3D12StateObject* object = new Both(&gone);
  EXPECT_EQ(object->AddRef(), 2u);
  EXPECT_EQ(object->Release(), 1u);
  EXPECT_FALSE(gone);
  EXPECT_EQ(object->Release(), 0u);
  EXPECT_TRUE(gone);
}

TEST(ComObject, ReferencesOfManyThreadsAreCounted) {
  bool gone = false;
  ID3D12StateObject* object = new Both(&gone);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([object] {
      for (int i = 0; i < 10000; ++i) {
        object->AddRef();
        ComPtr<ID3D12StateObjectProperties> properties;
        object->QueryInterface(IID_PPV_ARGS(properties.GetAddressOf()));
        object->Release();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(references(object), 1u);
  object->Release();
  EXPECT_TRUE(gone);
}

TEST(PrivateData, BytesComeBackAndSizesAreTold) {
  ComPtr<Both> both;
  both.Attach(new Both);
  const GUID id = {1, 2, 3, {4}};
  UINT size = 4;
  uint32_t value = 7;
  EXPECT_EQ(both->GetPrivateData(id, &size, &value), DXGI_ERROR_NOT_FOUND);
  EXPECT_EQ(size, 0u);
  const uint32_t stored[2] = {11, 12};
  ASSERT_EQ(both->SetPrivateData(id, sizeof(stored), stored), S_OK);
  size = 0;
  EXPECT_EQ(both->GetPrivateData(id, &size, nullptr), S_OK);
  EXPECT_EQ(size, sizeof(stored));
  size = 4;
  EXPECT_EQ(both->GetPrivateData(id, &size, &value), DXGI_ERROR_MORE_DATA);
  EXPECT_EQ(size, sizeof(stored));
  uint32_t read[2] = {};
  EXPECT_EQ(both->GetPrivateData(id, &size, read), S_OK);
  EXPECT_EQ(read[1], 12u);
  EXPECT_EQ(both->SetPrivateData(id, 0, nullptr), S_OK);
  EXPECT_EQ(both->GetPrivateData(id, &size, nullptr), DXGI_ERROR_NOT_FOUND);
}

TEST(PrivateData, AnObjectIsKeptUntilItIsReplacedOrItsOwnerFreed) {
  ID3D12StateObject* kept = new Both;
  const GUID id = {9, 9, 9, {}};
  {
    ComPtr<Both> owner;
    owner.Attach(new Both);
    ASSERT_EQ(owner->SetPrivateDataInterface(id, kept), S_OK);
    EXPECT_EQ(references(kept), 2u);
    IUnknown* got = nullptr;
    UINT size = sizeof(got);
    ASSERT_EQ(owner->GetPrivateData(id, &size, &got), S_OK);
    EXPECT_EQ(references(kept), 3u);  // the caller's own
    got->Release();
    ASSERT_EQ(owner->SetPrivateData(id, 1, "x"), S_OK);
    EXPECT_EQ(references(kept), 1u);
    ASSERT_EQ(owner->SetPrivateDataInterface(id, kept), S_OK);
  }
  EXPECT_EQ(references(kept), 1u);
  kept->Release();
}

TEST(PrivateData, ANameIsPrivateDataToo) {
  ComPtr<Both> both;
  both.Attach(new Both);
  ASSERT_EQ(both->SetName(L"pipeline"), S_OK);
  wchar_t name[16] = {};
  UINT size = sizeof(name);
  ASSERT_EQ(both->GetPrivateData(WKPDID_D3DDebugObjectNameW, &size, name), S_OK);
  EXPECT_STREQ(name, L"pipeline");
  EXPECT_EQ(size, 9 * sizeof(wchar_t));
}

TEST(Missing, AMethodSaysItsNameOnceAndReturnsENotImpl) {
  const Quiet quiet;
  const Listener listener;
  ComPtr<Both> both;
  both.Attach(new Both);
  EXPECT_EQ(both->GetShaderIdentifier(L"x"), nullptr);
  EXPECT_EQ(both->GetShaderIdentifier(L"x"), nullptr);
  EXPECT_EQ(process_reporter().missing("ID3D12Test::Method"), E_NOTIMPL);
  ASSERT_EQ(listener.messages.size(), 2u);
  EXPECT_EQ(listener.messages[0],
            "KA4000 method not implemented: ID3D12StateObjectProperties::GetShaderIdentifier is "
            "not implemented; the call did nothing.");
}

// The compiler is the test: a class with a method that has no entry could not be made.
template <class... Entries>
size_t make_all() {
  size_t made = 0;
  ((new ComObject<Entries>)->Release(), ...);
  ((made += std::size(Entries::kInterfaces)), ...);
  return made;
}

TEST(Entries, EveryMethodOfEveryVersionHasOne) {
  const size_t versions =
      make_all<ID3D12DeviceEntries, ID3D12GraphicsCommandListEntries, ID3D12CommandQueueEntries,
               ID3D12ResourceEntries, ID3D12HeapEntries, ID3D12FenceEntries,
               ID3D12PipelineLibraryEntries, ID3D12InfoQueueEntries, ID3D12DebugEntries,
               ID3D12DebugCommandListEntries, ID3D12DeviceRemovedExtendedDataEntries,
               ID3D12SDKConfigurationEntries, ID3D12DeviceFactoryEntries, ID3D12MetaCommandEntries,
               ID3D12ShaderCacheSessionEntries>();
  EXPECT_GE(versions, 60u);
  size_t methods = 0;
#define KAAMOS_METHOD(interface_, method) ++methods;
#include "d3d12/generated/d3d12_methods.inc"
#undef KAAMOS_METHOD
  EXPECT_GE(methods, 318u);  // of DirectX-Headers 1.606.4
}

TEST(Blob, ATextHasItsTerminatingZero) {
  ComPtr<ID3DBlob> blob;
  blob.Attach(new Blob(std::string_view("three")));
  ASSERT_EQ(blob->GetBufferSize(), 6u);
  EXPECT_STREQ(static_cast<const char*>(blob->GetBufferPointer()), "three");
}

// [D3D12: ID3DDestructionNotifier]
TEST(DestructionNotifierTest, CallsAreMadeWhenTheObjectIsDestroyed) {
  std::vector<int> made;
  struct Call {
    std::vector<int>* made;
    int number;
    static void make(void* data) {
      const auto* call = static_cast<const Call*>(data);
      call->made->push_back(call->number);
    }
  };
  Call calls[] = {{&made, 0}, {&made, 1}, {&made, 2}};
  ComPtr<ID3D12StateObject> object;
  object.Attach(new Both);
  ComPtr<ID3DDestructionNotifier> notifier;
  ASSERT_EQ(object->QueryInterface(ID3DDestructionNotifierEntries::kInterfaces[0].guid,
                                   reinterpret_cast<void**>(notifier.GetAddressOf())),
            S_OK);
  UINT ids[2] = {99, 99};
  EXPECT_EQ(notifier->RegisterDestructionCallback(nullptr, nullptr, &ids[0]),
            DXGI_ERROR_INVALID_CALL);
  EXPECT_EQ(ids[0], 99u);
  ASSERT_EQ(notifier->RegisterDestructionCallback(Call::make, &calls[0], &ids[0]), S_OK);
  ASSERT_EQ(notifier->RegisterDestructionCallback(Call::make, &calls[1], nullptr), S_OK);
  ASSERT_EQ(notifier->RegisterDestructionCallback(Call::make, &calls[2], &ids[1]), S_OK);
  EXPECT_NE(ids[0], ids[1]);
  EXPECT_EQ(notifier->UnregisterDestructionCallback(ids[0]), S_OK);
  EXPECT_EQ(notifier->UnregisterDestructionCallback(ids[0]), DXGI_ERROR_NOT_FOUND);
  ComPtr<IUnknown> one, other;
  ASSERT_EQ(object.As(&one), S_OK);
  ASSERT_EQ(notifier.As(&other), S_OK);
  EXPECT_EQ(one, other);
  one.Reset();
  other.Reset();
  EXPECT_EQ(references(object.Get()), 2u);
  object.Reset();
  EXPECT_TRUE(made.empty());
  notifier.Reset();
  EXPECT_EQ(made, (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace kaamos::d3d12
