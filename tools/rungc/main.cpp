// rungc: compiles, runs, tests and explains PLC programs of CNC controls. A thin main over libraries.
#include <optional>

#include "ir/support/version.h"
#include "tools/rungc/command_line.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/usage.h"

int main(int argc, char** argv) {
  using namespace rung::rungc;
  CommandLine app("Compiler for the PLC programs of CNC machine tools (NCT2xx/3xx, GSK25i, MEFI TECHNOL)",
                  rung::compilerName(),
                  "Exit status: 0 ok, 1 the program or scenario is wrong, 2 wrong usage, 3 environment.");
  int status = kOk;
  addNew(app, status);
  addCheck(app, status);
  addBuild(app, status);
  addSeal(app, status);
  addKey(app, status);
  addEmit(app, status);
  addConvert(app, status);
  addView(app, status);
  addRun(app, status);
  addTest(app, status);
  addProfile(app, status);
  addExplain(app, status);
  addDoc(app, status);
  addCompletion(app, status);
  addHelp(app, status);
  const std::optional<int> decided =
      app.run(argc, argv, [&app](const WrongWords& words) { return wrongUsage(app, words); });
  return decided.value_or(status);
}
