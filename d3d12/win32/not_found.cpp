// SPDX-License-Identifier: MIT
#include "d3d12/win32/not_found.h"

#include <mutex>
#include <set>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

namespace {

struct Names {
  std::mutex mutex;
  std::set<std::string> told;
  std::string unprinted;
};

Names& names() {
  static Names* const names = new Names;  // lives on: programs fail in destructors, too
  return *names;
}

}  // namespace

void tell_not_found(const std::string& call, const std::string& name) {
  {
    std::lock_guard lock(names().mutex);
    if (!names().told.insert(name).second) return;
    names().unprinted += (names().unprinted.empty() ? "\"" : ", \"") + name + "\"";
  }
  process_reporter().report(
      D3D12_MESSAGE_SEVERITY_WARNING,
      make_error(ErrorId::kNotFound, call + ": \"" + name + "\" is not there."));
}

void print_not_found() {
  std::string text;
  {
    std::lock_guard lock(names().mutex);
    text.swap(names().unprinted);
  }
  if (text.empty()) return;
  process_reporter().print(D3D12_MESSAGE_SEVERITY_WARNING,
                           "the program asked for names that are not there: " + text + ".");
}

}  // namespace kaamos::d3d12
