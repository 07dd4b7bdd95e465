// SPDX-License-Identifier: MIT
// kaamos-d3d12-support: prints SUPPORT.md's table, from which methods the objects override.
#include <iostream>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "d3d12/com/blob.h"
#include "d3d12/dxgi/factory.h"
#include "d3d12/dxgi/output.h"
#include "d3d12/dxgi/swap_chain.h"
#include "d3d12/objects/command_allocator.h"
#include "d3d12/objects/command_queue.h"
#include "d3d12/objects/debug.h"
#include "d3d12/objects/descriptor_heap.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/fence.h"
#include "d3d12/objects/graphics_command_list.h"
#include "d3d12/objects/heap.h"
#include "d3d12/objects/pipeline_library.h"
#include "d3d12/objects/pipeline_objects.h"
#include "d3d12/objects/resource.h"
#include "d3d12/objects/state_object.h"

namespace kaamos::d3d12 {

namespace {

using Objects = std::tuple<Device*, GraphicsCommandList*, CommandQueue*, Fence*, Resource*, Heap*,
                           DescriptorHeap*, CommandAllocator*, RootSignature*, PipelineState*,
                           PipelineLibrary*, QueryHeap*, CommandSignature*, StateObject*,
                           InfoQueue*, Factory*, Adapter*, Output*, SwapChain*>;

// The first object that has an interface; void without one.
template <class Interface, class... Rest>
struct Find {
  using type = void;
};
template <class Interface, class First, class... Rest>
struct Find<Interface, First, Rest...> {
  using type = std::conditional_t<std::is_base_of_v<Interface, First>, First,
                                  typename Find<Interface, Rest...>::type>;
};
template <class Interface, class Tuple>
struct FindIn;
template <class Interface, class... Classes>
struct FindIn<Interface, std::tuple<Classes*...>> : Find<Interface, Classes...> {};

// A method is declared by an object's class, or by the generated one that says it is missing.
template <class Method>
struct DeclaredBy;
template <class Method, class Class>
struct DeclaredBy<Method Class::*> {
  using type = Class;
};
template <class Class>
constexpr bool is_generated() {
  if constexpr (requires { typename Class::EntriesClass; }) {
    return std::is_same_v<typename Class::EntriesClass, Class>;
  } else {
    return false;
  }
}

struct Row {
  int working = 0;
  std::vector<std::string> missing;
};

// "ID3D12Device" of "ID3D12Device11".
std::string without_version(std::string name) {
  while (std::isdigit(static_cast<unsigned char>(name.back())) != 0) name.pop_back();
  return name;
}

template <class Interface, class Declarer>
void add(std::map<std::string, Row>& rows, const char* name, const char* method,
         Declarer declarer) {
  using Object = typename FindIn<Interface, Objects>::type;
  if constexpr (!std::is_void_v<Object>) {
    using Class = typename DeclaredBy<decltype(declarer(static_cast<Object*>(nullptr)))>::type;
    Row& row = rows[without_version(name)];
    if (is_generated<Class>()) {
      row.missing.push_back(method);
    } else {
      ++row.working;
    }
  }
}

std::map<std::string, Row> make_rows() {
  std::map<std::string, Row> rows;
#define KAAMOS_METHOD(type, method) \
  add<type>(rows, #type, #method,   \
            [](auto* object) { return &std::remove_pointer_t<decltype(object)>::method; });
#include "d3d12/generated/d3d12_methods.inc"
#undef KAAMOS_METHOD
  rows.erase("IKaamosAdapter");
  rows.erase("IUnknown");
  return rows;
}

}  // namespace

}  // namespace kaamos::d3d12

int main() {
  std::cout
      << "| interface, all versions | methods that work | not implemented (`E_NOTIMPL`, KA4000) |\n"
         "|---|---|---|\n";
  for (const auto& [name, row] : kaamos::d3d12::make_rows()) {
    std::cout << "| `" << name << "` | " << row.working << " of "
              << row.working + static_cast<int>(row.missing.size()) << " | ";
    for (size_t i = 0; i < row.missing.size(); ++i) {
      std::cout << (i > 0 ? ", `" : "`") << row.missing[i] << '`';
    }
    std::cout << (row.missing.empty() ? "|\n" : " |\n");
  }
  return 0;
}
