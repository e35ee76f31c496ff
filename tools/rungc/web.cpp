// The live page (see web.h).
#include "tools/rungc/web.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <utility>

#include "tools/rungc/drawn_sources.h"
#include "tools/web/access.h"
#include "tools/web/machine_source.h"
#include "tools/web/page.h"
#include "tools/web/past_source.h"
#include "tools/web/server.h"
#include "tools/web/session_source.h"
#include "tools/web/shown_program.h"

namespace rung::rungc {
namespace {

using Shown = std::shared_ptr<const web::ShownProgram>;

// What was compiled in this process knows its files and their configuration.
web::PastSource::Draw drawFrom(const std::vector<std::string>& files) {
  return [files](const compiler::Compiled& program) {
    return program.files.empty() ? drawnFrom(program, files) : drawnAgain(program);
  };
}

int serve(const std::string& listen, web::PacedSource& source, const std::function<bool()>& ended) {
  web::Page page(source);
  Result<std::unique_ptr<web::Server>> server =
      web::Server::start(*web::parseListen(listen), [&page](const web::Request& request, web::Server& by) {
        return page.respond(request, [&by] { return by.newLink(); });
      });
  if (!server.ok()) return environmentError(server.error());
  fmt::print("{}\n", server.value()->newLink());
  if (std::fflush(stdout) != 0) return kOk; // the link is lost, which CommandLine::run reports
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
                 scenario::Session& session, replay::SessionPast& past, replay::FlowEngine& engine,
                 const std::function<bool()>& ended) {
  Result<web::ShownProgram> program = drawnAgain(compiled, title);
  if (!program.ok()) return environmentError(program.error());
  const web::Drawn drawn{1, std::make_shared<const web::ShownProgram>(std::move(program).value())};
  web::SessionSource source(session, past, drawn, engine);
  return serve(listen, source, ended);
}

int servePast(const std::string& listen, replay::Past& past, const std::vector<std::string>& files,
              const std::function<bool()>& ended) {
  const web::PastSource::Draw draw = drawFrom(files);
  Result<web::ShownProgram> program = draw(past.compiled());
  if (!program.ok()) return environmentError(program.error());
  web::PastSource source(past, std::make_shared<const web::ShownProgram>(std::move(program).value()), draw);
  return serve(listen, source, ended);
}

int serveMachine(const std::string& listen, FollowedHost host, const std::vector<std::string>& files,
                 const std::function<bool()>& ended) {
  const web::PastSource::Draw draw = drawFrom(files);
  Result<web::ShownProgram> program = draw(host.followed.past->compiled());
  if (!program.ok()) return environmentError(program.error());
  host.client.reset(); // a host serves a limited number of connections
  web::HostLink link(host.name, files);
  web::MachineSource source(link, std::move(host.followed),
                            std::make_shared<const web::ShownProgram>(std::move(program).value()), draw);
  return serve(listen, source, ended);
}

} // namespace rung::rungc
