// SPDX-License-Identifier: MIT
//
// Work in another process, so that a driver that crashes or hangs ends only that.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace kaamos::conformance {

struct End {
  size_t done = 0;  // texts that arrived
  int status = 0;   // waitpid's
};

// Runs works 0 to `count` - 1 in a forked process, each for at most 120 s. `on_text` gets what each
// returned, in this process. The caller has made no device yet: a fork copies no threads.
End fork_and_run(size_t count, const std::function<std::string(size_t)>& work,
                 const std::function<void(size_t, const std::string&)>& on_text);

// "ended by Segmentation fault", as a line.
std::string describe_end(int status);

}  // namespace kaamos::conformance
