// Counts the allocations of a thread: through the sanitizer's hooks where one owns the allocator, else by standing in
// front of the C library's malloc. For one source of a test program: it defines malloc.
#pragma once
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define RUNG_TEST_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RUNG_TEST_SANITIZED 1
#endif

namespace {

thread_local bool counting = false;
thread_local int allocations = 0;

void countOne() {
  if (counting) ++allocations;
}

} // namespace

#ifdef RUNG_TEST_SANITIZED
#include <sanitizer/allocator_interface.h>

namespace {
const int hooksInstalled = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, size_t) { countOne(); },
                                                                     [](const volatile void*) {});
} // namespace
#else
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* malloc(size_t size) {
  countOne();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  countOne();
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  countOne();
  return __libc_realloc(old, size);
}
}
#endif

namespace {

template <class F>
int allocationsOf(F&& work) {
  allocations = 0;
  counting = true;
  work();
  counting = false;
  return allocations;
}

} // namespace
