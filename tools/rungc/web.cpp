// The live page (see web.h).
#include "tools/rungc/web.h"

#include <fmt/format.h>

#include "tools/view/drawn_program.h"
#include "tools/web/access.h"
#include "tools/web/page.h"
#include "tools/web/past_source.h"
#include "tools/web/server.h"
#include "tools/web/session_source.h"
#include "tools/web/shown_program.h"

namespace rung::rungc {
namespace {

// The program as the page shows it, read again from its files; fails if they have been changed.
Result<web::ShownProgram> shownProgram(const std::string& title, const compiler::Compiled& compiled) {
  SourceManager sources;
  const Result<std::vector<FileId>> files =
      compiler::addFiles(sources, compiled.module->files, compiled.options.config);
  if (!files.ok()) return files.failure();
  frontend::CompileOptions compile = compiled.options;
  compile.configPlaces.clear(); // they are positions in the sources of the first compilation
  Diagnostics diagnostics;
  const std::string changed = fmt::format("{} was changed while it was compiled", compiled.module->files.front());
  auto drawing = view::drawnProgram(sources, files.value(), *compiled.dialect, compile, diagnostics);
  if (!drawing) return failure(changed);
  if (!title.empty()) drawing->title = title;
  return web::ShownProgram(std::move(*drawing));
}

int serve(const std::string& listen, const web::ShownProgram& program, web::PacedSource& source,
          const std::function<bool()>& ended) {
  web::Page page(program, source);
  Result<std::unique_ptr<web::Server>> server =
      web::Server::start(*web::parseListen(listen), [&page](const web::Request& request, web::Server& by) {
        return page.respond(request, [&by] { return by.newLink(); });
      });
  if (!server.ok()) return environmentError(server.error());
  fmt::print("{}\n", server.value()->newLink());
  std::fflush(stdout);
  source.run(ended);
  return kOk;
}

} // namespace

std::string listenProblem(const std::string& listen) {
  return web::parseListen(listen)
             ? ""
             : fmt::format("--listen {}: expected a port, or ADDRESS:PORT such as 192.168.0.5:8080", listen);
}

int serveSession(const std::string& title, const std::string& listen, const compiler::Compiled& compiled,
                 scenario::Session& session, scenario::Explainer& explainer, replay::FlowEngine& engine,
                 const std::function<bool()>& ended) {
  const Result<web::ShownProgram> program = shownProgram(title, compiled);
  if (!program.ok()) return environmentError(program.error());
  web::SessionSource source(session, explainer, program.value(), engine);
  return serve(listen, program.value(), source, ended);
}

int servePast(const std::string& title, const std::string& listen, replay::Past& past,
              const std::function<bool()>& ended) {
  const Result<web::ShownProgram> program = shownProgram(title, past.compiled());
  if (!program.ok()) return environmentError(program.error());
  web::PastSource source(past, program.value());
  return serve(listen, program.value(), source, ended);
}

} // namespace rung::rungc
