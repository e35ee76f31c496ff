// rungc: compiles, runs, tests and explains PLC programs of CNC controls. A thin main over libraries.
#include <iostream>
#include <optional>

#include "machine/command-line/command_line.h"
#include "machine/command-line/usage.h"
#include "tools/rungc/commands.h"

int main(int argc, char** argv) {
  using namespace rung::rungc;
  namespace cli = rung::cli;
  CommandLine app(
      {.name = "rungc",
       .description =
           "Compiler for the PLC programs of CNC machine tools (FANUC PMC, NCT2xx/3xx, GSK25i, MEFI TECHNOL)",
       .exitStatus = "0 ok, 1 the program or scenario is wrong, 2 wrong usage, 3 environment",
       .guide = "docs/guide.md",
       .seeAlso = {"rung.toml(5)", "rung-map(5)", "rung-binding(5)", "rung-scenario(5)", "rung-ladder(5)",
                   "rung-coverage(5)", "rung-profile(5)", "rung-wcet(5)", "rung_hal(9)"}});
  int status = kOk;
  addNew(app, status);
  addCheck(app, status);
  addBuild(app, status);
  addMap(app, status);
  addBind(app, status);
  addSeal(app, status);
  addKey(app, status);
  addEmit(app, status);
  addOpt(app, status);
  addConvert(app, status);
  addImport(app, status);
  addFormat(app, status);
  addView(app, status);
  addXref(app, status);
  addDiff(app, status);
  addRun(app, status);
  addTest(app, status);
  addReplay(app, status);
  addWeb(app, status);
  addProfile(app, status);
  addWcet(app, status);
  addLsp(app, status);
  addExplain(app, status);
  addDoc(app, status);
  cli::addUsage(app, status);
  const std::optional<int> decided = app.run(argc, argv, [&app](const cli::WrongWords& words) {
    std::cerr << cli::wrongUsage(app, words);
    return kUsage;
  });
  return decided.value_or(status);
}
