// SPDX-License-Identifier: MIT
#include "d3d12/objects/live_objects.h"

#include <cstdio>
#include <string_view>
#include <utility>

#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

void LiveObjects::add(const void* object, Describe describe) {
  std::lock_guard lock(mutex_);
  entries_.emplace(next_, Entry{object, describe});
  numbers_[object] = next_++;
}

void LiveObjects::remove(const void* object) {
  std::lock_guard lock(mutex_);
  const auto number = numbers_.find(object);
  if (number == numbers_.end()) return;
  entries_.erase(number->second);
  numbers_.erase(number);
}

std::vector<LiveObject> LiveObjects::list() const {
  std::lock_guard lock(mutex_);
  std::vector<LiveObject> out;
  for (const auto& [number, entry] : entries_) out.push_back(entry.describe(entry.object));
  return out;
}

LiveObjects& live_objects(ID3D12Device* device) {
  return device_of(device).live_objects();
}

namespace {

// "ID3D12Resource" of "ID3D12Resource2".
std::string without_version(std::string_view name) {
  return std::string(name.substr(0, name.find_last_not_of("0123456789") + 1));
}

D3D12_MESSAGE_ID live_id(std::string_view interface_name) {
  static constexpr std::pair<std::string_view, D3D12_MESSAGE_ID> kIds[] = {
      {"ID3D12CommandAllocator", D3D12_MESSAGE_ID_LIVE_COMMANDALLOCATOR},
      {"ID3D12CommandQueue", D3D12_MESSAGE_ID_LIVE_COMMANDQUEUE},
      {"ID3D12CommandSignature", D3D12_MESSAGE_ID_LIVE_COMMANDSIGNATURE},
      {"ID3D12DescriptorHeap", D3D12_MESSAGE_ID_LIVE_DESCRIPTORHEAP},
      {"ID3D12Fence", D3D12_MESSAGE_ID_LIVE_MONITOREDFENCE},
      {"ID3D12GraphicsCommandList", D3D12_MESSAGE_ID_LIVE_COMMANDLIST12},
      {"ID3D12Heap", D3D12_MESSAGE_ID_LIVE_HEAP},
      {"ID3D12PipelineState", D3D12_MESSAGE_ID_LIVE_PIPELINESTATE},
      {"ID3D12QueryHeap", D3D12_MESSAGE_ID_LIVE_QUERYHEAP},
      {"ID3D12Resource", D3D12_MESSAGE_ID_LIVE_RESOURCE},
      {"ID3D12RootSignature", D3D12_MESSAGE_ID_LIVE_ROOTSIGNATURE},
  };
  for (const auto& [name, id] : kIds) {
    if (name == interface_name) return id;
  }
  return D3D12_MESSAGE_ID_UNKNOWN;  // state objects have none
}

std::string text_of(const LiveObject& object) {
  char address[32];
  std::snprintf(address, sizeof(address), "%p", object.object);
  std::string text = "Live " + without_version(object.interface_name) + " at " + address;
  if (!object.name.empty()) text += ", Name: " + object.name;
  return text + ", Refcount: " + std::to_string(object.references);
}

}  // namespace

// Each object refers to the device, and the caller does.
HRESULT Device::ReportLiveDeviceObjects(D3D12_RLDO_FLAGS flags) {
  const auto say = [&](D3D12_MESSAGE_ID id, const std::string& text) {
    reporter_->print(D3D12_MESSAGE_SEVERITY_WARNING, text);
    AddMessage(D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_SEVERITY_WARNING, id,
               text.c_str());
  };
  say(D3D12_MESSAGE_ID_LIVE_DEVICE, text_of({"ID3D12Device", this, name(), references()}));
  const std::vector<LiveObject> objects = live_objects_.list();
  if ((flags & D3D12_RLDO_SUMMARY) != 0) {
    std::map<std::string, size_t> counts;
    for (const LiveObject& object : objects) ++counts[without_version(object.interface_name)];
    for (const auto& [name, count] : counts) {
      say(D3D12_MESSAGE_ID_LIVE_OBJECT_SUMMARY, "Live " + name + ": " + std::to_string(count));
    }
  }
  if ((flags & D3D12_RLDO_DETAIL) != 0) {
    for (const LiveObject& object : objects) {
      say(live_id(without_version(object.interface_name)), text_of(object));
    }
  }
  return S_OK;
}

}  // namespace kaamos::d3d12
