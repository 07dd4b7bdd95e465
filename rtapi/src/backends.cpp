// SPDX-License-Identifier: MIT
#include "rtapi/src/backends.h"

//
// The list of backends. It names those of this build itself, because the linker would drop a static
// initialiser in a static library if nothing else in its file were used.
#include <algorithm>
#include <cstring>
#include <mutex>

namespace kaamos::embree {
const runtime::BackendFactory& backend_factory();  // with KAAMOS_HAVE_EMBREE
}
namespace kaamos::vulkan {
const runtime::BackendFactory& backend_factory();  // with KAAMOS_HAVE_VULKAN
}

namespace rtapi::detail {
namespace {

using kaamos::runtime::BackendFactory;

struct Registry {
  Registry() {
#ifdef KAAMOS_HAVE_EMBREE
    factories.push_back(&kaamos::embree::backend_factory());
#endif
#ifdef KAAMOS_HAVE_VULKAN
    factories.push_back(&kaamos::vulkan::backend_factory());
#endif
  }
  std::mutex mutex;
  std::vector<const BackendFactory*> factories;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

}  // namespace

std::vector<const BackendFactory*> backends() {
  Registry& r = registry();
  std::lock_guard lock(r.mutex);
  return r.factories;
}

void register_backend(const BackendFactory* factory) {
  Registry& r = registry();
  std::lock_guard lock(r.mutex);
  auto it = std::find_if(r.factories.begin(), r.factories.end(), [&](const BackendFactory* f) {
    return std::strcmp(f->name, factory->name) == 0;
  });
  if (it != r.factories.end()) {
    *it = factory;
  } else {
    r.factories.push_back(factory);
  }
}

}  // namespace rtapi::detail
