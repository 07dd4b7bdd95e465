// SPDX-License-Identifier: MIT
// The objects that a device made and programs still hold, for ReportLiveDeviceObjects.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <directx/d3d12.h>

namespace kaamos::d3d12 {

/// One object, as a report lists it.
struct LiveObject {
  const char* interface_name;  // of the newest version: "ID3D12Resource2"
  const void* object;
  std::string name;  // SetName's, UTF-8; empty without
  ULONG references;
};

/// The objects of one device. Thread-safe.
class LiveObjects {
 public:
  /// Reads an object that has been added. It runs while the object cannot be removed, so it may use
  /// what exists until remove() is called, and no virtual function.
  using Describe = LiveObject (*)(const void* object);

  void add(const void* object, Describe describe);
  void remove(const void* object);
  /// In the order of their creation.
  std::vector<LiveObject> list() const;

 private:
  struct Entry {
    const void* object;
    Describe describe;
  };
  mutable std::mutex mutex_;
  std::map<UINT64, Entry> entries_;  // by a number that counts up
  std::map<const void*, UINT64> numbers_;
  UINT64 next_ = 0;
};

/// Those of a device of this library.
LiveObjects& live_objects(ID3D12Device* device);

}  // namespace kaamos::d3d12
