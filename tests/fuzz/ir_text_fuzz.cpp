// libFuzzer target: any bytes through the parser of the IR text. What parses must print to a text that prints to
// itself, and the verifier must survive it.
#include <cstddef>
#include <cstdint>

#include "ir/support/check.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace rung::ir;
  const ParseOutcome parsed = parse({reinterpret_cast<const char*>(data), size});
  if (!parsed.module) {
    RUNG_CHECK(!parsed.error.message.empty() && parsed.error.line > 0, "an error says what and where");
    return 0;
  }
  const std::vector<VerifyError> errors = verify(*parsed.module, Mode::Final);
  static_cast<void>(render(*parsed.module, errors));
  if (!errors.empty()) return 0; // such a module need not read back
  const std::string text = print(*parsed.module);
  const ParseOutcome again = parse(text);
  RUNG_CHECK(again.module.has_value(), "a printed module parses");
  RUNG_CHECK(print(*again.module) == text, "a printed module prints to itself");
  return 0;
}
