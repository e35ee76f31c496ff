// Marks in embedded texts.
#include <gtest/gtest.h>

#include "rtlib/text/embedded.h"

namespace rung {
namespace {

TEST(Embedded, MarksAreFilledOnce) {
  const text::Mark marks[] = {{"A", "{{B}}"}, {"B", "b"}};
  EXPECT_EQ(text::filled("x {{A}} {{B}}{{B}}", marks), "x {{B}} bb");
  EXPECT_EQ(text::filled("{ {{C}} {{{B}}} {{A", marks), "{ {{C}} {b} {{A");
}

TEST(Embedded, FilesByName) {
  const text::EmbeddedFile files[] = {{"a/b.css", "b{}"}, {"c.js", "c()"}};
  EXPECT_EQ(text::textOf(files, "c.js"), "c()");
}

} // namespace
} // namespace rung
