// SPDX-License-Identifier: MIT
// Files and folders.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <kaamos_crt.h>
#include <kaamos_stream_path.h>

#include "d3d12/com/text.h"
#include "d3d12/win32/not_found.h"
#include "d3d12/win32/open_file.h"
#include "d3d12/win32/text_out.h"

#undef fopen  // that of programs ends here

namespace kaamos::d3d12 {

namespace {

DWORD error_of(int code, const std::string& path) {
  std::error_code ignored;
  switch (code) {
    case ENOENT: {
      // Programs make the folders above and try again.
      const auto folder = std::filesystem::path(path).parent_path();
      return folder.empty() || std::filesystem::is_directory(folder, ignored)
                 ? ERROR_FILE_NOT_FOUND
                 : ERROR_PATH_NOT_FOUND;
    }
    case ENOTDIR:
      return ERROR_PATH_NOT_FOUND;
    case EEXIST:
      return ERROR_FILE_EXISTS;
    case ENAMETOOLONG:
      return ERROR_FILENAME_EXCED_RANGE;
    case EINVAL:
      return ERROR_INVALID_PARAMETER;
    default:
      return ERROR_ACCESS_DENIED;
  }
}

HANDLE open_file(const std::string& path, DWORD access, DWORD disposition) {
  int flags = O_CLOEXEC;
  const bool writes = (access & (GENERIC_WRITE | GENERIC_ALL)) != 0;
  const bool reads = (access & GENERIC_READ) != 0 || !writes || (access & GENERIC_ALL) != 0;
  flags |= writes ? (reads ? O_RDWR : O_WRONLY) : O_RDONLY;
  switch (disposition) {
    case CREATE_NEW:
      flags |= O_CREAT | O_EXCL;
      break;
    case CREATE_ALWAYS:
      flags |= O_CREAT | O_TRUNC;
      break;
    case OPEN_EXISTING:
      break;
    case OPEN_ALWAYS:
      flags |= O_CREAT;
      break;
    case TRUNCATE_EXISTING:
      flags |= O_TRUNC;
      break;
    default:
      succeed(false, ERROR_INVALID_PARAMETER, "CreateFile",
              "dwCreationDisposition is " + std::to_string(disposition) + "; allowed are 1 to 5.");
      return INVALID_HANDLE_VALUE;
  }
  std::error_code ignored;
  const bool existed = std::filesystem::exists(path, ignored);
  if (std::filesystem::is_directory(path, ignored)) {
    SetLastError(ERROR_ACCESS_DENIED);
    return INVALID_HANDLE_VALUE;
  }
  const int descriptor = ::open(path.c_str(), flags, 0666);
  if (!succeed_or_errno(descriptor >= 0, path)) {
    if (GetLastError() != ERROR_ACCESS_DENIED) tell_not_found("CreateFile", path);
    return INVALID_HANDLE_VALUE;
  }
  if (disposition == CREATE_ALWAYS || disposition == OPEN_ALWAYS) {
    SetLastError(existed ? ERROR_ALREADY_EXISTS : ERROR_SUCCESS);
  }
  return Handles::instance().add(std::make_shared<File>(descriptor));
}

DWORD attributes_of(const std::string& path) {
  struct stat info = {};
  if (!succeed_or_errno(::stat(path.c_str(), &info) == 0, path)) return INVALID_FILE_ATTRIBUTES;
  if (S_ISDIR(info.st_mode)) return FILE_ATTRIBUTE_DIRECTORY;
  return (info.st_mode & S_IWUSR) == 0 ? FILE_ATTRIBUTE_READONLY : FILE_ATTRIBUTE_NORMAL;
}

std::string current_directory() {
  std::error_code error;
  return std::filesystem::current_path(error).string();
}

}  // namespace

File::~File() {
  ::close(descriptor_);
}

std::shared_ptr<File> find_file(HANDLE handle, const char* call) {
  auto file = Handles::instance().find<File>(handle);
  succeed(file != nullptr, ERROR_INVALID_HANDLE, call, "the handle names no open file.");
  return file;
}

BOOL succeed_or_errno(bool done, const std::string& path) {
  if (!done) SetLastError(error_of(errno, path));
  return done ? TRUE : FALSE;
}

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

HANDLE WINAPI CreateFileA(LPCSTR path, DWORD access, DWORD, LPSECURITY_ATTRIBUTES,
                          DWORD disposition, DWORD, HANDLE) {
  return open_file(to_path(path != nullptr ? path : ""), access, disposition);
}

HANDLE WINAPI CreateFileW(LPCWSTR path, DWORD access, DWORD, LPSECURITY_ATTRIBUTES,
                          DWORD disposition, DWORD, HANDLE) {
  return open_file(to_path(path), access, disposition);
}

HANDLE WINAPI GetStdHandle(DWORD number) {
  if (number != STD_INPUT_HANDLE && number != STD_OUTPUT_HANDLE && number != STD_ERROR_HANDLE) {
    succeed(
        false, ERROR_INVALID_HANDLE, "GetStdHandle",
        "nStdHandle is " + std::to_string(static_cast<int>(number)) + "; allowed are -10 to -12.");
    return INVALID_HANDLE_VALUE;
  }
  // One handle for each stream, whatever the number of calls.
  static const std::array<HANDLE, 3> streams = [] {
    std::array<HANDLE, 3> made = {};
    for (int i = 0; i < 3; ++i) {
      made[static_cast<size_t>(i)] = Handles::instance().add(std::make_shared<File>(::dup(i)));
    }
    return made;
  }();
  return streams[STD_INPUT_HANDLE - number];
}

HANDLE WINAPI CreateFile2(LPCWSTR path, DWORD access, DWORD, DWORD disposition,
                          LPCREATEFILE2_EXTENDED_PARAMETERS) {
  return open_file(to_path(path), access, disposition);
}

BOOL WINAPI ReadFile(HANDLE handle, LPVOID buffer, DWORD size, LPDWORD read, LPOVERLAPPED) {
  if (read != nullptr) *read = 0;
  const auto file = find_file(handle, "ReadFile");
  if (file == nullptr) return FALSE;
  DWORD done = 0;
  while (done < size) {
    const ssize_t n = ::read(file->descriptor(), static_cast<char*>(buffer) + done, size - done);
    if (!succeed_or_errno(n >= 0)) return FALSE;
    if (n == 0) break;
    done += static_cast<DWORD>(n);
  }
  if (read != nullptr) *read = done;
  return TRUE;
}

BOOL WINAPI WriteFile(HANDLE handle, LPCVOID buffer, DWORD size, LPDWORD written, LPOVERLAPPED) {
  if (written != nullptr) *written = 0;
  const auto file = find_file(handle, "WriteFile");
  if (file == nullptr) return FALSE;
  DWORD done = 0;
  while (done < size) {
    const ssize_t n =
        ::write(file->descriptor(), static_cast<const char*>(buffer) + done, size - done);
    if (!succeed_or_errno(n >= 0)) return FALSE;
    done += static_cast<DWORD>(n);
  }
  if (written != nullptr) *written = done;
  return TRUE;
}

BOOL WINAPI GetFileSizeEx(HANDLE handle, PLARGE_INTEGER size) {
  const auto file = find_file(handle, "GetFileSizeEx");
  if (file == nullptr) return FALSE;
  struct stat info = {};
  if (!succeed_or_errno(::fstat(file->descriptor(), &info) == 0)) return FALSE;
  size->QuadPart = info.st_size;
  return TRUE;
}

DWORD WINAPI GetFileSize(HANDLE handle, LPDWORD high) {
  LARGE_INTEGER size = {};
  if (GetFileSizeEx(handle, &size) == FALSE) return INVALID_FILE_SIZE;
  if (high != nullptr) *high = static_cast<DWORD>(size.u.HighPart);
  return size.u.LowPart;
}

BOOL WINAPI SetFilePointerEx(HANDLE handle, LARGE_INTEGER distance, PLARGE_INTEGER position,
                             DWORD method) {
  const auto file = find_file(handle, "SetFilePointerEx");
  if (file == nullptr) return FALSE;
  const off_t at = ::lseek(file->descriptor(), distance.QuadPart, static_cast<int>(method));
  if (!succeed_or_errno(at >= 0)) return FALSE;
  if (position != nullptr) position->QuadPart = at;
  return TRUE;
}

DWORD WINAPI SetFilePointer(HANDLE handle, LONG distance, PLONG high, DWORD method) {
  LARGE_INTEGER offset = {};
  offset.QuadPart = distance;
  if (high != nullptr) {
    offset.u.LowPart = static_cast<DWORD>(distance);
    offset.u.HighPart = *high;
  }
  LARGE_INTEGER position = {};
  if (SetFilePointerEx(handle, offset, &position, method) == FALSE) return INVALID_SET_FILE_POINTER;
  if (high != nullptr) *high = position.u.HighPart;
  return position.u.LowPart;
}

BOOL WINAPI GetFileInformationByHandleEx(HANDLE handle, FILE_INFO_BY_HANDLE_CLASS kind, LPVOID info,
                                         DWORD size) {
  const auto file = find_file(handle, "GetFileInformationByHandleEx");
  if (file == nullptr) return FALSE;
  if (kind != FileStandardInfo || size < sizeof(FILE_STANDARD_INFO)) {
    return succeed(false, ERROR_INVALID_PARAMETER, "GetFileInformationByHandleEx",
                   "only FileStandardInfo is there, of 24 bytes.");
  }
  struct stat status = {};
  if (!succeed_or_errno(::fstat(file->descriptor(), &status) == 0)) return FALSE;
  FILE_STANDARD_INFO out = {};
  out.AllocationSize.QuadPart = status.st_blocks * 512;
  out.EndOfFile.QuadPart = status.st_size;
  out.NumberOfLinks = static_cast<DWORD>(status.st_nlink);
  out.Directory = S_ISDIR(status.st_mode) ? TRUE : FALSE;
  std::memcpy(info, &out, sizeof(out));
  return TRUE;
}

DWORD WINAPI GetFileAttributesA(LPCSTR path) {
  return attributes_of(to_path(path));
}
DWORD WINAPI GetFileAttributesW(LPCWSTR path) {
  return attributes_of(to_path(path));
}

BOOL WINAPI CreateDirectoryA(LPCSTR path, LPSECURITY_ATTRIBUTES) {
  const std::string folder = to_path(path);
  const bool made = ::mkdir(folder.c_str(), 0777) == 0;
  if (!made && errno == EEXIST) {
    SetLastError(ERROR_ALREADY_EXISTS);
    return FALSE;
  }
  return succeed_or_errno(made, folder);
}
BOOL WINAPI CreateDirectoryW(LPCWSTR path, LPSECURITY_ATTRIBUTES attributes) {
  return CreateDirectoryA(to_utf8(path).c_str(), attributes);
}

BOOL WINAPI DeleteFileA(LPCSTR path) {
  return succeed_or_errno(::unlink(to_path(path).c_str()) == 0, to_path(path));
}
BOOL WINAPI DeleteFileW(LPCWSTR path) {
  return DeleteFileA(to_utf8(path).c_str());
}

BOOL WINAPI SetCurrentDirectoryA(LPCSTR path) {
  return succeed_or_errno(::chdir(to_path(path).c_str()) == 0, to_path(path));
}
BOOL WINAPI SetCurrentDirectoryW(LPCWSTR path) {
  return SetCurrentDirectoryA(to_utf8(path).c_str());
}

DWORD WINAPI GetCurrentDirectoryA(DWORD size, LPSTR path) {
  return hand_out_text(current_directory(), path, size);
}
DWORD WINAPI GetCurrentDirectoryW(DWORD size, LPWSTR path) {
  return hand_out_text(to_wide(current_directory()), path, size);
}

FILE* _wfopen(const wchar_t* path, const wchar_t* mode) {
  // "t" and "b" are MSVC's; text is not translated here.
  std::string how = to_utf8(mode);
  how = how.substr(0, how.find(','));
  std::erase(how, 't');
  FILE* const file = std::fopen(to_path(path).c_str(), how.c_str());
  if (file == nullptr && errno == ENOENT) tell_not_found("fopen", to_path(path));
  return file;
}

const char* kaamos_stream_path_narrow(const char* path) {
  thread_local std::string text;
  if (path == nullptr) return nullptr;
  text = to_path(path);
  return text.c_str();
}

const char* kaamos_stream_path_wide(const wchar_t* path) {
  return path != nullptr ? kaamos_stream_path_narrow(to_utf8(path).c_str()) : nullptr;
}

const char* kaamos_input_path_of(const char* path) {
  if (path != nullptr && ::access(path, F_OK) != 0) tell_not_found("ifstream", path);
  return path;
}

FILE* kaamos_fopen(const char* path, const char* mode) {
  return path != nullptr && mode != nullptr ? _wfopen(to_wide(path).c_str(), to_wide(mode).c_str())
                                            : nullptr;
}

int _mkdir(const char* path) {
  return ::mkdir(to_path(path).c_str(), 0777);
}

int _chdir(const char* path) {
  return ::chdir(to_path(path).c_str());
}

}  // extern "C"
