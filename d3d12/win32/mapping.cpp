// SPDX-License-Identifier: MIT
// Files that are mapped to memory. [Win32: memoryapi.h]
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <map>
#include <mutex>

#include "d3d12/win32/open_file.h"

namespace kaamos::d3d12 {

namespace {

// What CreateFileMapping returns. It keeps the file open.
struct Mapping final : HandleObject {
  std::shared_ptr<File> file;
  bool writes = false;
};

// The size of every view, which UnmapViewOfFile does not tell.
struct Views {
  std::mutex mutex;
  std::map<const void*, size_t> sizes;
};
Views& views() {
  static Views* const all = new Views;  // lives on: views may outlast the program's statics
  return *all;
}

// 0 where there is no such view.
size_t size_of_view(const void* address) {
  std::lock_guard lock(views().mutex);
  const auto found = views().sizes.find(address);
  return found != views().sizes.end() ? found->second : 0;
}

uint64_t join(DWORD high, DWORD low) {
  return static_cast<uint64_t>(high) << 32 | low;
}

HANDLE make_mapping(HANDLE handle, DWORD protection, uint64_t size) {
  auto mapping = std::make_shared<Mapping>();
  mapping->writes = protection == PAGE_READWRITE;
  if (!mapping->writes && protection != PAGE_READONLY) {
    succeed(false, ERROR_INVALID_PARAMETER, "CreateFileMapping",
            "flProtect is " + std::to_string(protection) +
                "; allowed are PAGE_READONLY (2) and PAGE_READWRITE (4).");
    return nullptr;
  }
  mapping->file = handle == INVALID_HANDLE_VALUE
                      ? std::make_shared<File>(::memfd_create("kaamos", MFD_CLOEXEC))
                      : find_file(handle, "CreateFileMapping");
  if (mapping->file == nullptr) return nullptr;
  struct stat info = {};
  if (!succeed_or_errno(::fstat(mapping->file->descriptor(), &info) == 0)) return nullptr;
  if (size == 0 && info.st_size == 0) {
    SetLastError(ERROR_FILE_INVALID);
    return nullptr;
  }
  if (size > static_cast<uint64_t>(info.st_size) &&
      !succeed_or_errno(::ftruncate(mapping->file->descriptor(), static_cast<off_t>(size)) == 0)) {
    return nullptr;
  }
  SetLastError(ERROR_SUCCESS);
  return Handles::instance().add(std::move(mapping));
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

HANDLE WINAPI CreateFileMappingA(HANDLE file, LPSECURITY_ATTRIBUTES, DWORD protection, DWORD high,
                                 DWORD low, LPCSTR) {
  return make_mapping(file, protection, join(high, low));
}
HANDLE WINAPI CreateFileMappingW(HANDLE file, LPSECURITY_ATTRIBUTES, DWORD protection, DWORD high,
                                 DWORD low, LPCWSTR) {
  return make_mapping(file, protection, join(high, low));
}

LPVOID WINAPI MapViewOfFile(HANDLE handle, DWORD access, DWORD high, DWORD low, SIZE_T bytes) {
  const auto mapping = Handles::instance().find<Mapping>(handle);
  if (mapping == nullptr) {
    succeed(false, ERROR_INVALID_HANDLE, "MapViewOfFile", "the handle names no file mapping.");
    return nullptr;
  }
  const int file = mapping->file->descriptor();
  struct stat info = {};
  if (!succeed_or_errno(::fstat(file, &info) == 0)) return nullptr;
  const uint64_t offset = join(high, low);
  const auto size = static_cast<uint64_t>(info.st_size);
  const bool writes = (access & FILE_MAP_WRITE) != 0;
  if (offset % 65536 != 0 || offset >= size || bytes > size - offset ||
      (writes && !mapping->writes)) {
    SetLastError(ERROR_ACCESS_DENIED);
    return nullptr;
  }
  const size_t length = bytes != 0 ? bytes : size - offset;
  void* const address = ::mmap(nullptr, length, writes ? PROT_READ | PROT_WRITE : PROT_READ,
                               MAP_SHARED, file, static_cast<off_t>(offset));
  if (!succeed_or_errno(address != MAP_FAILED)) return nullptr;
  std::lock_guard lock(views().mutex);
  views().sizes[address] = length;
  return address;
}

BOOL WINAPI UnmapViewOfFile(LPCVOID address) {
  const size_t size = size_of_view(address);
  if (size == 0) {
    return succeed(false, ERROR_INVALID_ADDRESS, "UnmapViewOfFile",
                   "lpBaseAddress is no view that MapViewOfFile gave.");
  }
  std::lock_guard lock(views().mutex);
  views().sizes.erase(address);
  return succeed_or_errno(::munmap(const_cast<void*>(address), size) == 0);
}

BOOL WINAPI FlushViewOfFile(LPCVOID address, SIZE_T) {
  const size_t size = size_of_view(address);
  if (size == 0) {
    return succeed(false, ERROR_INVALID_ADDRESS, "FlushViewOfFile",
                   "lpBaseAddress is no view that MapViewOfFile gave.");
  }
  return succeed_or_errno(::msync(const_cast<void*>(address), size, MS_SYNC) == 0);
}

}  // extern "C"
