#include "planning/candidates/fallback.h"

#include <gtest/gtest.h>

#include <set>

namespace mocha {
namespace {

TEST(Fallback, EachKindHasItsOwnWordsAndSaysWhere) {
  std::set<std::string> words;
  for (const FallbackKind kind : kFallbackKinds) {
    const std::string text = describe(Fallback{kind, {1.234, -0.5}});
    EXPECT_EQ(text, std::string(to_text(kind)) + ", at (1.23, -0.50)");
    words.insert(to_text(kind));
  }
  EXPECT_EQ(words.size(), kFallbackKinds.size());
  EXPECT_EQ(words.count("unknown"), 0u);
}

}  // namespace
}  // namespace mocha
