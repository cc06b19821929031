#include "stack/freed_memory.h"

#include <malloc.h>

namespace mocha {

void keep_freed_memory() {
  constexpr int kLarge_bytes = 32 << 20;  // blocks from here on are mapped on their own, as ever
  constexpr int kKept_bytes = 64 << 20;   // free at the end of the heap
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
  mallopt(M_TRIM_THRESHOLD, kKept_bytes);
}

}  // namespace mocha
