#include "stack/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <vector>

namespace mocha {
namespace {

constexpr std::size_t kBlock_bytes = 8 << 20;

/// Pages that were handed out by the system while a block was filled, then freed.
long pages_for_a_block() {
  const auto pages = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = pages();
  const std::vector<char> block(kBlock_bytes, 1);
  return pages() - before + (block.back() == 1 ? 0 : 1);
}

TEST(FreedMemory, IsThereAgainWithoutNewPages) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers have an allocator of their own";
#endif
  keep_freed_memory();
  pages_for_a_block();
  EXPECT_LT(pages_for_a_block(), static_cast<long>(kBlock_bytes) / sysconf(_SC_PAGESIZE) / 10);
}

}  // namespace
}  // namespace mocha
