// SPDX-License-Identifier: MIT
// Stored messages, filters and callbacks of the debug layer.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class InfoQueueCalls : public D3d12Test {
 protected:
  void SetUp() override {
    D3d12Test::SetUp();
    ComPtr<ID3D12Debug> debug;
    ASSERT_EQ(D3D12GetDebugInterface(IID_PPV_ARGS(debug.GetAddressOf())), S_OK);
    debug->EnableDebugLayer();
    ASSERT_EQ(
        D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(checked_.GetAddressOf())),
        S_OK);
    ComPtr<ID3D12Debug4> off;
    debug.As(&off);
    off->DisableDebugLayer();
    ASSERT_EQ(checked_.As(&info_), S_OK);
  }

  // A heap of no descriptors: KA0620.
  static void make_error_happen(ID3D12Device* device) {
    D3D12_DESCRIPTOR_HEAP_DESC desc = {};
    ID3D12DescriptorHeap* heap = nullptr;
    EXPECT_EQ(device->CreateDescriptorHeap(&desc, IID_PPV_ARGS(&heap)), E_INVALIDARG);
  }
  void make_error_happen() { make_error_happen(checked_.Get()); }

  ComPtr<ID3D12Device> checked_;
  ComPtr<ID3D12InfoQueue1> info_;
};

TEST_F(InfoQueueCalls, AMessageHasD3D12sIdAndTheWholeText) {
  make_error_happen();
  ASSERT_EQ(info_->GetNumStoredMessages(), 1u);
  SIZE_T size = 0;
  ASSERT_EQ(info_->GetMessage(0, nullptr, &size), S_FALSE);
  std::vector<uint64_t> memory(size / 8 + 1);
  auto* message = reinterpret_cast<D3D12_MESSAGE*>(memory.data());
  ASSERT_EQ(info_->GetMessage(0, message, &size), S_OK);
  EXPECT_EQ(message->ID, D3D12_MESSAGE_ID_CREATE_DESCRIPTOR_HEAP_INVALID_DESC);
  EXPECT_EQ(message->Severity, D3D12_MESSAGE_SEVERITY_ERROR);
  EXPECT_EQ(message->Category, D3D12_MESSAGE_CATEGORY_STATE_CREATION);
  EXPECT_EQ(message->DescriptionByteLength, std::strlen(message->pDescription) + 1);
  EXPECT_EQ(std::string(message->pDescription).substr(0, 6), "KA0620");
  EXPECT_EQ(info_->GetMessage(1, message, &size), E_INVALIDARG);
}

TEST_F(InfoQueueCalls, DeniedMessagesAreNotStored) {
  D3D12_MESSAGE_ID ids[] = {D3D12_MESSAGE_ID_CREATE_DESCRIPTOR_HEAP_INVALID_DESC};
  D3D12_INFO_QUEUE_FILTER filter = {};
  filter.DenyList.NumIDs = 1;
  filter.DenyList.pIDList = ids;
  ASSERT_EQ(info_->PushStorageFilter(&filter), S_OK);
  make_error_happen();
  EXPECT_EQ(info_->GetNumStoredMessages(), 0u);
  EXPECT_EQ(info_->GetNumMessagesDeniedByStorageFilter(), 1u);
  SIZE_T size = 0;
  ASSERT_EQ(info_->GetStorageFilter(nullptr, &size), S_OK);
  EXPECT_EQ(size, sizeof(filter) + sizeof(ids));
  std::vector<uint64_t> memory(size / 8 + 1);
  auto* copy = reinterpret_cast<D3D12_INFO_QUEUE_FILTER*>(memory.data());
  ASSERT_EQ(info_->GetStorageFilter(copy, &size), S_OK);
  ASSERT_EQ(copy->DenyList.NumIDs, 1u);
  EXPECT_EQ(copy->DenyList.pIDList[0], ids[0]);
  info_->PopStorageFilter();
  make_error_happen();
  EXPECT_EQ(info_->GetNumStoredMessages(), 1u);
}

TEST_F(InfoQueueCalls, ARetrievalFilterHidesWhatIsStored) {
  make_error_happen();
  ASSERT_EQ(info_->AddApplicationMessage(D3D12_MESSAGE_SEVERITY_INFO, "frame 1"), S_OK);
  D3D12_MESSAGE_SEVERITY severities[] = {D3D12_MESSAGE_SEVERITY_INFO};
  D3D12_INFO_QUEUE_FILTER filter = {};
  filter.AllowList.NumSeverities = 1;
  filter.AllowList.pSeverityList = severities;
  ASSERT_EQ(info_->PushRetrievalFilter(&filter), S_OK);
  EXPECT_EQ(info_->GetNumStoredMessages(), 2u);
  EXPECT_EQ(info_->GetNumStoredMessagesAllowedByRetrievalFilter(), 1u);
  SIZE_T size = 1024;
  std::vector<uint64_t> memory(128);
  auto* message = reinterpret_cast<D3D12_MESSAGE*>(memory.data());
  ASSERT_EQ(info_->GetMessage(0, message, &size), S_OK);
  EXPECT_STREQ(message->pDescription, "frame 1");
}

TEST_F(InfoQueueCalls, TheOldestMessagesGoWhenTheLimitIsReached) {
  ASSERT_EQ(info_->SetMessageCountLimit(2), S_OK);
  for (const char* text : {"one", "two", "three"}) {
    info_->AddApplicationMessage(D3D12_MESSAGE_SEVERITY_INFO, text);
  }
  EXPECT_EQ(info_->GetNumStoredMessages(), 2u);
  EXPECT_EQ(info_->GetNumMessagesDiscardedByMessageCountLimit(), 1u);
  info_->ClearStoredMessages();
  EXPECT_EQ(info_->GetNumStoredMessages(), 0u);
}

TEST_F(InfoQueueCalls, ACallbackGetsEveryMessageUntilItIsTakenBack) {
  std::vector<std::string> texts;
  DWORD cookie = 0;
  ASSERT_EQ(info_->RegisterMessageCallback(
                [](D3D12_MESSAGE_CATEGORY, D3D12_MESSAGE_SEVERITY, D3D12_MESSAGE_ID, LPCSTR text,
                   void* context) {
                  static_cast<std::vector<std::string>*>(context)->emplace_back(text);
                },
                D3D12_MESSAGE_CALLBACK_FLAG_NONE, &texts, &cookie),
            S_OK);
  make_error_happen();
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts[0].substr(0, 6), "KA0620");
  ASSERT_EQ(info_->UnregisterMessageCallback(cookie), S_OK);
  make_error_happen();
  EXPECT_EQ(texts.size(), 1u);
  EXPECT_EQ(info_->UnregisterMessageCallback(cookie), E_INVALIDARG);
}

TEST_F(InfoQueueCalls, LiveObjectsAreListedByInterfaceNameAndReferences) {
  ComPtr<ID3D12DebugDevice> debug_device;
  ASSERT_EQ(checked_.As(&debug_device), S_OK);
  ComPtr<ID3D12Fence> named, other, freed;
  for (ID3D12Fence** fence : {named.GetAddressOf(), freed.GetAddressOf(), other.GetAddressOf()}) {
    ASSERT_EQ(checked_->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(fence)), S_OK);
  }
  ASSERT_EQ(named->SetName(L"frame \u00e4"), S_OK);
  const std::string narrow = "other";
  ASSERT_EQ(other->SetPrivateData(WKPDID_D3DDebugObjectName, 5, narrow.data()), S_OK);
  const ComPtr<ID3D12Fence> twice = other;
  freed.Reset();
  ASSERT_EQ(debug_device->ReportLiveDeviceObjects(D3D12_RLDO_SUMMARY | D3D12_RLDO_DETAIL), S_OK);
  std::vector<std::string> texts;
  std::vector<D3D12_MESSAGE_ID> ids;
  for (UINT64 i = 0; i < info_->GetNumStoredMessages(); ++i) {
    SIZE_T size = 0;
    ASSERT_EQ(info_->GetMessage(i, nullptr, &size), S_FALSE);
    std::vector<char> bytes(size);
    auto* message = reinterpret_cast<D3D12_MESSAGE*>(bytes.data());
    ASSERT_EQ(info_->GetMessage(i, message, &size), S_OK);
    texts.emplace_back(message->pDescription);
    ids.push_back(message->ID);
    EXPECT_EQ(message->Severity, D3D12_MESSAGE_SEVERITY_WARNING);
  }
  ASSERT_EQ(texts.size(), 4u);
  EXPECT_EQ(ids, (std::vector<D3D12_MESSAGE_ID>{
                     D3D12_MESSAGE_ID_LIVE_DEVICE, D3D12_MESSAGE_ID_LIVE_OBJECT_SUMMARY,
                     D3D12_MESSAGE_ID_LIVE_MONITOREDFENCE, D3D12_MESSAGE_ID_LIVE_MONITOREDFENCE}));
  EXPECT_EQ(texts[0].find("Live ID3D12Device at 0x"), 0u) << texts[0];
  EXPECT_EQ(texts[1], "Live ID3D12Fence: 2");
  EXPECT_EQ(texts[2].find("Live ID3D12Fence at 0x"), 0u) << texts[2];
  EXPECT_NE(texts[2].find(", Name: frame \u00e4, Refcount: 1"), std::string::npos) << texts[2];
  EXPECT_NE(texts[3].find(", Name: other, Refcount: 2"), std::string::npos) << texts[3];
}

TEST_F(InfoQueueCalls, ACallbackMayTakeItselfBackAndMeetAnotherError) {
  struct Context {
    ID3D12InfoQueue1* info;
    ID3D12Device* device;
    DWORD cookie;
    int calls;
  } context = {info_.Get(), checked_.Get(), 0, 0};
  ASSERT_EQ(
      info_->RegisterMessageCallback(
          [](D3D12_MESSAGE_CATEGORY, D3D12_MESSAGE_SEVERITY, D3D12_MESSAGE_ID, LPCSTR, void* data) {
            auto& c = *static_cast<Context*>(data);
            ++c.calls;
            EXPECT_EQ(c.info->UnregisterMessageCallback(c.cookie), S_OK);
            D3D12_DESCRIPTOR_HEAP_DESC desc = {};
            ID3D12DescriptorHeap* heap = nullptr;
            EXPECT_EQ(c.device->CreateDescriptorHeap(&desc, IID_PPV_ARGS(&heap)), E_INVALIDARG);
          },
          D3D12_MESSAGE_CALLBACK_FLAG_NONE, &context, &context.cookie),
      S_OK);
  make_error_happen();
  EXPECT_EQ(context.calls, 1);
  EXPECT_EQ(info_->GetNumStoredMessages(), 2u);
}

// Errors on one thread while another mutes and unmutes, and a third device comes and goes.
TEST_F(InfoQueueCalls, ThreadsDoNotWaitForEachOther) {
  std::vector<std::thread> threads;
  threads.emplace_back([&] {
    for (int i = 0; i < 200; ++i) make_error_happen();
  });
  threads.emplace_back([&] {
    for (int i = 0; i < 200; ++i) info_->SetMuteDebugOutput(i % 2 == 0 ? TRUE : FALSE);
  });
  threads.emplace_back([&] {
    for (int i = 0; i < 5; ++i) {
      ComPtr<ID3D12Device> device;
      EXPECT_EQ(
          D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(device.GetAddressOf())),
          S_OK);
    }
  });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(info_->GetNumStoredMessages(), 200u);
}

// Two devices with the debug layer, and their queues.
class TwoInfoQueues : public InfoQueueCalls {
 protected:
  void SetUp() override {
    InfoQueueCalls::SetUp();
    setenv("KAAMOS_D3D12_DEBUG", "1", 1);
    ASSERT_EQ(
        D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(other_.GetAddressOf())),
        S_OK);
    unsetenv("KAAMOS_D3D12_DEBUG");
    ASSERT_EQ(other_.As(&other_info_), S_OK);
    const D3D12_COMMAND_QUEUE_DESC desc = {};
    ASSERT_EQ(other_->CreateCommandQueue(&desc, IID_PPV_ARGS(other_queue_.GetAddressOf())), S_OK);
    ASSERT_EQ(other_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT,
                                             IID_PPV_ARGS(other_allocator_.GetAddressOf())),
              S_OK);
    ASSERT_EQ(other_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, other_allocator_.Get(),
                                        nullptr, IID_PPV_ARGS(other_list_.GetAddressOf())),
              S_OK);
  }

  // Returns how many messages the queues have, and forgets them.
  std::pair<UINT64, UINT64> counts() {
    const std::pair out{info_->GetNumStoredMessages(), other_info_->GetNumStoredMessages()};
    info_->ClearStoredMessages();
    other_info_->ClearStoredMessages();
    return out;
  }

  ComPtr<ID3D12Device> other_;
  ComPtr<ID3D12InfoQueue1> other_info_;
  ComPtr<ID3D12CommandQueue> other_queue_;
  ComPtr<ID3D12CommandAllocator> other_allocator_;
  ComPtr<ID3D12GraphicsCommandList> other_list_;
};

using Counts = std::pair<UINT64, UINT64>;

TEST_F(TwoInfoQueues, HaveTheMessagesOfTheirDevice) {
  make_error_happen();
  EXPECT_EQ(counts(), Counts(1, 0));
  make_error_happen(other_.Get());
  EXPECT_EQ(counts(), Counts(0, 1));
}

// An object, a method that this library lacks, a command list that rtapi refuses.
TEST_F(TwoInfoQueues, HaveTheMessagesOfTheirDevicesObjects) {
  EXPECT_EQ(other_queue_->Signal(nullptr, 1), E_INVALIDARG);
  EXPECT_EQ(counts(), Counts(0, 1));
  for (int i = 0; i < 2; ++i) {
    other_queue_->CopyTileMappings(nullptr, nullptr, nullptr, nullptr, nullptr,
                                   D3D12_TILE_MAPPING_FLAG_NONE);
  }
  EXPECT_EQ(counts(), Counts(0, 1));
  other_list_->CopyBufferRegion(nullptr, 0, nullptr, 0, 4);
  EXPECT_TRUE(FAILED(other_list_->Close()));
  EXPECT_EQ(counts(), Counts(0, 1));
}

// KA0452, of a barrier that executes.
TEST_F(TwoInfoQueues, HaveWhatCheckedModeSaysOfTheirDevice) {
  const auto buffer = buffer_of(other_.Get(), 256, D3D12_HEAP_TYPE_DEFAULT);
  D3D12_RESOURCE_BARRIER barrier = {};
  barrier.Transition = {buffer.Get(), 0, D3D12_RESOURCE_STATE_COPY_SOURCE,
                        D3D12_RESOURCE_STATE_COPY_DEST};
  other_list_->ResourceBarrier(1, &barrier);
  barrier.Transition.StateBefore = D3D12_RESOURCE_STATE_UNORDERED_ACCESS;
  other_list_->ResourceBarrier(1, &barrier);
  ASSERT_EQ(other_list_->Close(), S_OK);
  EXPECT_EQ(counts(), Counts(0, 0));
  ID3D12CommandList* lists[] = {other_list_.Get()};
  other_queue_->ExecuteCommandLists(1, lists);
  const Counts said = counts();
  EXPECT_EQ(said.first, 0u);
  EXPECT_GE(said.second, 1u);
}

TEST_F(TwoInfoQueues, HaveNoMessageOfACallWithoutADevice) {
  const Listener process;
  ComPtr<ID3DBlob> blob;
  EXPECT_EQ(D3D12SerializeRootSignature(nullptr, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                        nullptr),
            E_INVALIDARG);
  EXPECT_EQ(process.messages.size(), 1u);
  EXPECT_EQ(counts(), Counts(0, 0));
}

TEST_F(TwoInfoQueues, HaveTheirDevicesMessagesOfTwoThreadsAtOnce) {
  std::atomic<int> calls[2] = {0, 0};
  DWORD cookies[2] = {0, 0};
  ID3D12InfoQueue1* queues[] = {info_.Get(), other_info_.Get()};
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(queues[i]->RegisterMessageCallback(
                  [](D3D12_MESSAGE_CATEGORY, D3D12_MESSAGE_SEVERITY, D3D12_MESSAGE_ID, LPCSTR,
                     void* context) { ++*static_cast<std::atomic<int>*>(context); },
                  D3D12_MESSAGE_CALLBACK_FLAG_NONE, &calls[i], &cookies[i]),
              S_OK);
  }
  std::thread one([&] {
    for (int i = 0; i < 300; ++i) make_error_happen();
  });
  std::thread two([&] {
    for (int i = 0; i < 200; ++i) make_error_happen(other_.Get());
  });
  one.join();
  two.join();
  EXPECT_EQ(calls[0], 300);
  EXPECT_EQ(calls[1], 200);
  EXPECT_EQ(counts(), Counts(300, 200));
}

TEST_F(TwoInfoQueues, AreMutedOneByOne) {
  info_->SetMuteDebugOutput(TRUE);
  EXPECT_TRUE(info_->GetMuteDebugOutput());
  EXPECT_FALSE(other_info_->GetMuteDebugOutput());
  unsetenv("KAAMOS_D3D12_MESSAGES");
  testing::internal::CaptureStderr();
  make_error_happen();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  make_error_happen(other_.Get());
  EXPECT_NE(testing::internal::GetCapturedStderr(), "");
}

// What shaders print, with the debug layer on, on each backend.
class PrintingShaders : public D3d12BackendTest {
 protected:
  void SetUp() override {
    ComPtr<ID3D12Debug4> debug;
    ASSERT_EQ(D3D12GetDebugInterface(IID_PPV_ARGS(debug.GetAddressOf())), S_OK);
    debug->EnableDebugLayer();
    D3d12BackendTest::SetUp();
    debug->DisableDebugLayer();
  }
};

TEST_P(PrintingShaders, LinesAreMessagesInTheOrderOfThreads) {
  const auto code = compile("cs_6_0",
                            "[RootSignature(\"\")] [numthreads(2, 1, 1)] void main(uint i : "
                            "SV_DispatchThreadID) { printf(\"half of %u is %v\", i, i * 0.5); "
                            "if (i == 1) errorf(\"odd\"); }");
  ComPtr<ID3D12RootSignature> signature;
  ASSERT_EQ(device_->CreateRootSignature(0, code->GetBufferPointer(), code->GetBufferSize(),
                                         IID_PPV_ARGS(signature.GetAddressOf())),
            S_OK);
  D3D12_COMPUTE_PIPELINE_STATE_DESC desc = {};
  desc.pRootSignature = signature.Get();
  desc.CS = {code->GetBufferPointer(), code->GetBufferSize()};
  ComPtr<ID3D12PipelineState> pipeline;
  ASSERT_EQ(device_->CreateComputePipelineState(&desc, IID_PPV_ARGS(pipeline.GetAddressOf())),
            S_OK);
  ComPtr<ID3D12InfoQueue> info;
  ASSERT_EQ(device_.As(&info), S_OK);
  info->ClearStoredMessages();
  list_->SetComputeRootSignature(signature.Get());
  list_->SetPipelineState(pipeline.Get());
  list_->Dispatch(1, 1, 1);
  run();
  std::vector<std::string> told;
  for (UINT64 i = 0; i < info->GetNumStoredMessages(); ++i) {
    SIZE_T size = 0;
    info->GetMessage(i, nullptr, &size);
    std::vector<uint64_t> memory(size / 8 + 1);
    auto* message = reinterpret_cast<D3D12_MESSAGE*>(memory.data());
    ASSERT_EQ(info->GetMessage(i, message, &size), S_OK);
    const std::string text = message->pDescription;
    const char* severity = message->Severity == D3D12_MESSAGE_SEVERITY_ERROR ? "error " : "";
    told.push_back(severity + text.substr(0, 6) + text.substr(text.find(": (") + 1));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"KA0845 (0,0,0): half of 0 is 0",
                                            "KA0845 (1,0,0): half of 1 is 0.5",
                                            "error KA0846 (1,0,0): odd"}));
}

INSTANTIATE_TEST_SUITE_P(Backends, PrintingShaders, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace kaamos::d3d12
