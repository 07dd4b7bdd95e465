// SPDX-License-Identifier: MIT
//
// Suppressions of the thread sanitizer, for every program of a sanitized build. Weak, because each
// linked library brings them along.
#if defined(__has_feature)
#define KAAMOS_HAS_FEATURE(feature) __has_feature(feature)
#else
#define KAAMOS_HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_THREAD__) || KAAMOS_HAS_FEATURE(thread_sanitizer)

// oneTBB and Embree are not instrumented, so the sanitizer does not see the order that their locks
// and atomics impose. runtime/embree/parallel.cpp tells it the order of our own tasks and of what
// Embree's builders call, so everything those read and write is checked. Suppressed is only what
// the two libraries share with themselves:
// - allocations, copies and locks that they make;
// - words in Embree's settings, which its builders look up;
// - the bookkeeping of tasks in oneTBB's headers, which our files include;
// - Embree's report of the memory it took, from its own threads: one atomic addition in a device
//   that Embree's locks hand over.
extern "C" __attribute__((weak)) const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\n"
         "called_from_lib:libembree\n"
         "race:std::__cxx11::basic_string<*>::compare(char const*) const\n"
         "race_top:oneapi/tbb/\n"
         "race:tbb::detail::d1::fold_tree\n"
         "race:tbb::detail::d1::wait_context\n"
         "race:tbb::detail::d1::*check_being_stolen\n"
         "race:kaamos::embree::Device::count_bytes\n";
}

#endif
