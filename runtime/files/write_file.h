// SPDX-License-Identifier: MIT
//
// Output files. A regular file is replaced in one step: whoever reads it meanwhile, and whoever
// finds it after a full disk or an interrupted run, sees all of the old contents or all of the new
// ones. It keeps its permissions, and through a symbolic link it is the link's target that is
// replaced. A device, a pipe and what a process has open (/dev/stdout) are written to as they are,
// and so is a file in a folder that takes no new ones.
#pragma once

#include <string>
#include <string_view>

namespace kaamos::files {

// Writes `bytes` as the whole contents of `path`. Returns 0 or what errno says. Of two writers at a
// time one wins.
int write_file(const std::string& path, std::string_view bytes);

// Makes the finished file `from` the contents of `path`, by the same rules; `from` is gone
// afterwards. Returns 0 or what errno says, and `from` is still there then.
int place_file(const std::string& from, const std::string& path);

}  // namespace kaamos::files
