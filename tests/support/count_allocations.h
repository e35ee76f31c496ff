// What a thread asks of the heap, releases too, in a program that has rung_count_allocations among its libraries.
// Nothing is counted but what is between begin and end, so that such a program has other tests as well.
#pragma once

namespace rung::test {

// Of the thread that calls them; they do not nest.
void beginCountingAllocations();
void endCountingAllocations();
// All that has been counted so far.
int countedAllocations();

template <class F>
int allocationsOf(F&& work) {
  const int before = countedAllocations();
  beginCountingAllocations();
  work();
  endCountingAllocations();
  return countedAllocations() - before;
}

} // namespace rung::test
