// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {

class CommandListTest : public StateObjectTest {
 protected:
  CommandListTest() {
    list_ = device_.CreateCommandList().value();
    queue_ = device_.CreateCommandQueue().value();
  }
  // Records on a fresh list and returns the first error, or success.
  template <class F>
  Status Record(F&& record) {
    CommandList list = device_.CreateCommandList().value();
    record(list);
    return list.Close();
  }
  template <class Command>
  const Command& Executed(size_t i) {
    return std::get<Command>(null_log().executed.at(i));
  }
  Buffer MakeBuffer(uint64_t bytes, HeapType heap = HeapType::kDefault, std::string name = "b",
                    ResourceFlags flags = ResourceFlags::kNone) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes, .Heap = heap, .Flags = flags, .Name = std::move(name)})
        .value();
  }

  CommandList list_;
  CommandQueue queue_;
};

}  // namespace rtapi::testing
