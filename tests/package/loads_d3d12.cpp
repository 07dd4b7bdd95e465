// SPDX-License-Identifier: MIT
// loads_d3d12: a program that knows Kaamos by the names of its libraries only, as those do that
// were written for the Windows Subsystem for Linux. Makes a factory, a device and a compiler.
#include <dlfcn.h>

#include <cstdint>
#include <cstdio>

namespace {

struct Id {
  uint32_t a;
  uint16_t b, c;
  uint8_t d[8];
};
constexpr Id kFactory4 = {
    0x1bc6ea02, 0xef36, 0x464f, {0xbf, 0x0c, 0x21, 0xca, 0x39, 0xe5, 0x16, 0x8a}};
constexpr Id kDevice = {
    0x189819f1, 0x1db6, 0x4b57, {0xbe, 0x54, 0x18, 0x21, 0x33, 0x9b, 0x85, 0xf7}};
constexpr Id kCompiler3 = {
    0x228b4687, 0x5a6a, 0x4730, {0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54}};
constexpr Id kCompiler = {
    0x73e22d93, 0xe6ce, 0x47f3, {0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0}};
constexpr int kFeatureLevel12_1 = 0xc100;

template <class Function>
Function* find(const char* library, const char* name) {
  void* handle = dlopen(library, RTLD_NOW);
  void* function = handle == nullptr ? nullptr : dlsym(handle, name);
  if (function == nullptr) std::fprintf(stderr, "%s: %s\n", library, dlerror());
  return reinterpret_cast<Function*>(function);
}

bool made(const char* what, int32_t result, void* const& object) {
  if (result == 0 && object != nullptr) return true;
  std::fprintf(stderr, "no %s: 0x%08x\n", what, static_cast<unsigned>(result));
  return false;
}

}  // namespace

int main() {
  const auto create_factory = find<int32_t(const Id*, void**)>("libdxgi.so", "CreateDXGIFactory1");
  const auto create_device =
      find<int32_t(void*, int, const Id*, void**)>("libd3d12.so", "D3D12CreateDevice");
  const auto create_compiler =
      find<int32_t(const Id*, const Id*, void**)>("libdxcompiler.so", "DxcCreateInstance");
  const auto create_core =
      find<int32_t(const Id*, void**)>("libdxcore.so", "DXCoreCreateAdapterFactory");
  if (!create_factory || !create_device || !create_compiler || !create_core) return 1;
  void *factory = nullptr, *device = nullptr, *compiler = nullptr;
  if (!made("factory", create_factory(&kFactory4, &factory), factory)) return 1;
  if (!made("device", create_device(nullptr, kFeatureLevel12_1, &kDevice, &device), device))
    return 1;
  if (!made("compiler", create_compiler(&kCompiler, &kCompiler3, &compiler), compiler)) return 1;
  std::printf("a factory, a device and a compiler\n");
  return 0;
}
