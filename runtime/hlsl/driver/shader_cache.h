// SPDX-License-Identifier: MIT
//
// The folder of built libraries. They are code that runs as this user, so nothing is loaded that
// another user may have put there.
#pragma once

#include <filesystem>
#include <string>

namespace kaamos::hlsl {

// $KAAMOS_CACHE_DIR, else $XDG_CACHE_HOME/kaamos, else ~/.cache/kaamos, else a per-user folder in
// /tmp.
std::filesystem::path cache_folder();

// Makes the folder, writable by this user alone, unless it exists. Returns why it cannot be used,
// and what to do; empty if all is well. Refused are links, and folders that belong to another user
// or that others can write to.
std::string open_cache(const std::filesystem::path& folder);

// False unless `object` is a file of this user, no link, that nobody else can write to.
bool may_load(const std::filesystem::path& object);

// The error of a call that could not write `path` in the cache and left its reason in errno.
std::string cannot_write(const std::filesystem::path& path);

}  // namespace kaamos::hlsl
