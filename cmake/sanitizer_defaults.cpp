// SPDX-License-Identifier: MIT
//
// What the thread sanitizer is told in every program of a sanitized build. Weak, because each
// library that is linked brings it along.
#if defined(__has_feature)
#define KAAMOS_HAS_FEATURE(feature) __has_feature(feature)
#else
#define KAAMOS_HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_THREAD__) || KAAMOS_HAS_FEATURE(thread_sanitizer)

// oneTBB and Embree are not instrumented: locks and atomics inside them order nothing that the
// sanitizer can see. What our own tasks read and write is ordered by runtime/embree/parallel.h, and
// so it is checked. Left out are
// - the task objects of oneTBB's headers, where the access itself is in them (race_top);
// - allocations, copies and locks that the two libraries make themselves;
// - Embree's report of memory it took, from its own threads: one atomic addition, in a device that
//   Embree's locks hand over.
extern "C" __attribute__((weak)) const char* __tsan_default_suppressions() {
  return "race_top:tbb::detail\n"
         "called_from_lib:libtbb.so\n"
         "called_from_lib:libembree\n"
         "race:kaamos::embree::Device::count_bytes\n";
}

#endif
