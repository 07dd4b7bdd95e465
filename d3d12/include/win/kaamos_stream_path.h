// SPDX-License-Identifier: MIT
// Paths as std::ifstream and its like pass them on, for the <fstream> that kaamos_add_d3d12_program
// writes. The standard library alone must do here.
#pragma once

#include <string>

extern "C" {
/// The path with slashes, as UTF-8, until this thread's next call. Null stays null.
///@{
const char* kaamos_stream_path_narrow(const char* path);
const char* kaamos_stream_path_wide(const wchar_t* path);
///@}
/// Remembers the name of a file that is not there (KA4043), and returns it.
const char* kaamos_input_path_of(const char* path);
}

inline const char* kaamos_stream_path(const char* path) {
  return kaamos_stream_path_narrow(path);
}
inline const char* kaamos_stream_path(const wchar_t* path) {
  return kaamos_stream_path_wide(path);
}
inline const char* kaamos_stream_path(const std::string& path) {
  return kaamos_stream_path_narrow(path.c_str());
}
/// The type of a path that a stream takes besides text: std::filesystem::path, and std::wstring.
///@{
template <class Path>
auto kaamos_path_type(Path& path) -> decltype(path.make_preferred().filename());
std::wstring kaamos_path_type(std::wstring& path);
///@}
template <class Path>
const char* kaamos_input_path(const Path& path) {
  return kaamos_input_path_of(kaamos_stream_path(path));
}
