// See count_allocations.h. Through the sanitizer's hooks where one owns the allocator, else by taking the place of all
// of malloc's entries in the C library.
#include "tests/support/count_allocations.h"

#include <cerrno>
#include <cstdlib>

#include "tests/support/sanitized.h"

namespace rung::test {
namespace {

// Volatile, as compilers assume that malloc reads no variable of the program.
thread_local volatile bool counting = false;
thread_local volatile int allocations = 0; // and releases

void countOne() {
  if (counting) allocations = allocations + 1;
}

} // namespace

void beginCountingAllocations() { counting = true; }
void endCountingAllocations() { counting = false; }
int countedAllocations() { return allocations; }

} // namespace rung::test

#ifdef RUNG_TEST_SANITIZED
#include <sanitizer/allocator_interface.h>

namespace rung::test {
namespace {
const int hooksInstalled = __sanitizer_install_malloc_and_free_hooks([](const volatile void*, size_t) { countOne(); },
                                                                     [](const volatile void*) { countOne(); });
} // namespace
} // namespace rung::test
#else
using rung::test::countOne;

// Taking the place of malloc is what this file is for, by the C library's names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void* __libc_valloc(size_t size);
void* __libc_pvalloc(size_t size);
void __libc_free(void* block);

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
void* reallocarray(void* old, size_t count, size_t size) {
  countOne();
  size_t bytes = 0;
  if (!__builtin_mul_overflow(count, size, &bytes)) return __libc_realloc(old, bytes);
  errno = ENOMEM;
  return nullptr;
}
void* memalign(size_t alignment, size_t size) {
  countOne();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  countOne();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, size_t alignment, size_t size) {
  countOne();
  void* const made = __libc_memalign(alignment, size);
  if (made == nullptr) return ENOMEM;
  *block = made;
  return 0;
}
void* valloc(size_t size) {
  countOne();
  return __libc_valloc(size);
}
void* pvalloc(size_t size) {
  countOne();
  return __libc_pvalloc(size);
}
void free(void* block) {
  if (block != nullptr) countOne();
  __libc_free(block);
}
}
// NOLINTEND(readability-identifier-naming)
#endif
