// rungc lsp: the language server for editors.
#include <csignal>
#include <memory>
#include <unistd.h>

#include "rtlib/text/version.h"
#include "tools/lsp/server.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {

void addLsp(CommandLine& app, int& status) {
  Command command = app.add("lsp", "Serve an editor by the language server protocol, on standard input and output");
  auto stdio = std::make_shared<bool>(false);
  command.flag("--stdio", *stdio, "Nothing else: some editors give it to every server");
  command.onRun([stdio, &status] {
    std::signal(SIGPIPE, SIG_IGN); // an editor that is gone is the end of the input
    lsp::Transport transport(STDIN_FILENO, STDOUT_FILENO);
    status = lsp::Server(transport, text::version()).run();
  });
}

} // namespace rung::rungc
