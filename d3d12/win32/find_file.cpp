// SPDX-License-Identifier: MIT
// The files of a folder, by a pattern. [Win32: FindFirstFile]
#include <fnmatch.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "d3d12/com/text.h"
#include "d3d12/win32/handles.h"
#include "d3d12/win32/not_found.h"

namespace kaamos::d3d12 {

namespace {

// What is found, in the order of names.
struct Search final : HandleObject {
  std::filesystem::path folder;
  std::vector<std::string> names;
  size_t next = 0;
};

template <class C>
void hand_out_name(const std::basic_string<C>& name, C (&out)[MAX_PATH]) {
  const size_t length = std::min<size_t>(name.size(), MAX_PATH - 1);
  std::copy_n(name.begin(), length, out);
  out[length] = C();
}
void hand_out_name(const std::string& name, WCHAR (&out)[MAX_PATH]) {
  hand_out_name(to_wide(name), out);
}

template <class Data>
BOOL give_next(Search& search, Data* data) {
  if (search.next == search.names.size()) {
    SetLastError(ERROR_NO_MORE_FILES);
    return FALSE;
  }
  const std::string& name = search.names[search.next++];
  struct stat info = {};
  ::stat((search.folder / name).c_str(), &info);
  *data = {};
  data->dwFileAttributes = S_ISDIR(info.st_mode) ? FILE_ATTRIBUTE_DIRECTORY : FILE_ATTRIBUTE_NORMAL;
  data->nFileSizeHigh = static_cast<DWORD>(static_cast<uint64_t>(info.st_size) >> 32);
  data->nFileSizeLow = static_cast<DWORD>(info.st_size);
  // Units of 100 ns since 1601.
  const auto time = (static_cast<uint64_t>(info.st_mtim.tv_sec) + 11644473600u) * 10000000u +
                    static_cast<uint64_t>(info.st_mtim.tv_nsec) / 100;
  data->ftLastWriteTime = {static_cast<DWORD>(time), static_cast<DWORD>(time >> 32)};
  data->ftCreationTime = data->ftLastAccessTime = data->ftLastWriteTime;
  hand_out_name(name, data->cFileName);
  return TRUE;
}

template <class Data>
HANDLE find_first(const std::string& path, Data* data) {
  const std::filesystem::path pattern(path);
  auto search = std::make_shared<Search>();
  search->folder = pattern.has_parent_path() ? pattern.parent_path() : ".";
  // As Windows has it, "*.*" is every name.
  const std::string name =
      pattern.filename() == "*.*" ? std::string("*") : pattern.filename().string();
  std::error_code error;
  if (name.find_first_of("*?") == std::string::npos) {
    if (std::filesystem::exists(pattern, error)) search->names.push_back(name);
  } else {
    for (const auto& entry : std::filesystem::directory_iterator(search->folder, error)) {
      const std::string found = entry.path().filename().string();
      if (::fnmatch(name.c_str(), found.c_str(), FNM_NOESCAPE | FNM_CASEFOLD) == 0) {
        search->names.push_back(found);
      }
    }
    std::sort(search->names.begin(), search->names.end());
  }
  if (search->names.empty()) {
    tell_not_found("FindFirstFile", path);
    SetLastError(std::filesystem::is_directory(search->folder, error) ? ERROR_FILE_NOT_FOUND
                                                                      : ERROR_PATH_NOT_FOUND);
    return INVALID_HANDLE_VALUE;
  }
  give_next(*search, data);
  return Handles::instance().add(std::move(search));
}

template <class Data>
BOOL find_next(HANDLE handle, Data* data) {
  const auto search = Handles::instance().find<Search>(handle);
  if (search == nullptr) {
    return succeed(false, ERROR_INVALID_HANDLE, "FindNextFile", "the handle names no search.");
  }
  return give_next(*search, data);
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

HANDLE WINAPI FindFirstFileA(LPCSTR pattern, WIN32_FIND_DATAA* data) {
  return find_first(to_path(pattern), data);
}
HANDLE WINAPI FindFirstFileW(LPCWSTR pattern, WIN32_FIND_DATAW* data) {
  return find_first(to_path(pattern), data);
}
HANDLE WINAPI FindFirstFileExA(LPCSTR pattern, FINDEX_INFO_LEVELS, LPVOID data, FINDEX_SEARCH_OPS,
                               LPVOID, DWORD) {
  return FindFirstFileA(pattern, static_cast<WIN32_FIND_DATAA*>(data));
}
HANDLE WINAPI FindFirstFileExW(LPCWSTR pattern, FINDEX_INFO_LEVELS, LPVOID data, FINDEX_SEARCH_OPS,
                               LPVOID, DWORD) {
  return FindFirstFileW(pattern, static_cast<WIN32_FIND_DATAW*>(data));
}
BOOL WINAPI FindNextFileA(HANDLE search, WIN32_FIND_DATAA* data) {
  return find_next(search, data);
}
BOOL WINAPI FindNextFileW(HANDLE search, WIN32_FIND_DATAW* data) {
  return find_next(search, data);
}
BOOL WINAPI FindClose(HANDLE search) {
  return CloseHandle(search);
}

}  // extern "C"
