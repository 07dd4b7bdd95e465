// SPDX-License-Identifier: MIT
//
// The list of backends. It names those of this build itself, because the linker would drop a static
// initialiser in a static library if nothing else in its file were used.
#include <algorithm>
#include <cstring>
#include <mutex>

#include "runtime/backend.h"

namespace kaamos::runtime {

namespace {

struct Registry {
  Registry() {
#ifdef KAAMOS_HAVE_EMBREE
    factories.push_back(&embree::backend_factory());
#endif
#ifdef KAAMOS_HAVE_VULKAN
    factories.push_back(&vulkan::backend_factory());
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

}  // namespace kaamos::runtime
