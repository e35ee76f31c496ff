// rungc explain and rungc doc: the reference, an entry or a page at a time.
#include <fmt/format.h>
#include <iostream>

#include "tools/driver/reference.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {

void addExplain(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("explain", "Explain a diagnostic code, an instruction or a signal");
  auto word = std::make_shared<std::string>();
  command
      ->add_option(
          "WORD", *word,
          "A code such as unbalanced-stack, a mnemonic such as TOND, a signal such as MF, its address F7.0, or AN_PLCA")
      ->required();
  command->callback([word, &status] {
    const std::optional<std::string> text = driver::explain(*word);
    if (text)
      std::cout << *text;
    else
      fmt::print(stderr, "rungc: no diagnostic code, instruction or signal: '{}'\n", *word);
    status = text ? kOk : kWrong;
  });
}

void addDoc(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("doc", "Print a page of the reference as Markdown");
  auto page = std::make_shared<std::string>();
  command->add_option("PAGE", *page, "gsk, nct, technol, diagnostics or ir")->required();
  command->callback([page, &status] {
    if (*page == "diagnostics")
      std::cout << driver::diagnosticReference();
    else if (*page == "ir")
      std::cout << driver::operationReference();
    else if (const frontend::Dialect* dialect = frontend::findDialect(*page))
      std::cout << driver::dialectReference(*dialect);
    else {
      fmt::print(stderr, "rungc: no such page: '{}'; there are gsk, nct, technol, diagnostics and ir\n", *page);
      status = kUsage;
    }
  });
}

} // namespace rung::rungc
