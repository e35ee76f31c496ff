// The live page (see web.h).
#include "tools/rungc/web.h"

#include <fmt/format.h>
#include <optional>

#include "tools/view/drawn_program.h"
#include "tools/web/access.h"
#include "tools/web/page.h"
#include "tools/web/server.h"
#include "tools/web/session_source.h"
#include "tools/web/shown_program.h"

namespace rung::rungc {
namespace {

class Delivery final : public ir::RungObserver {
public:
  explicit Delivery(std::shared_ptr<web::FlowObserver*> target) : target_(std::move(target)) {}
  void rungRan(uint32_t number, std::span<const uint64_t> values) override {
    if (*target_ != nullptr) (*target_)->rungRan(number, values);
  }

private:
  std::shared_ptr<web::FlowObserver*> target_;
};

// The program as the page shows it, read again from its files; fails if they have been changed.
Result<web::ShownProgram> shownProgram(const SourceOptions& options, const compiler::Compiled& compiled) {
  SourceManager sources;
  const Result<std::vector<FileId>> files =
      compiler::addFiles(sources, compiled.module->files, compiled.options.config);
  if (!files.ok()) return files.failure();
  frontend::CompileOptions compile = compiled.options;
  compile.configPlaces.clear(); // they are positions in the sources of the first compilation
  Diagnostics diagnostics;
  const std::string title = options.project ? options.project->name : "";
  const std::string changed = fmt::format("{} was changed while it was compiled", compiled.module->files.front());
  if (!view::hasDrawing(*compiled.dialect)) {
    auto listing = view::listedProgram(sources, files.value(), *compiled.dialect, compile, diagnostics);
    if (!listing) return failure(changed);
    if (!title.empty()) listing->title = title;
    return web::ShownProgram(std::move(*listing), *compiled.module, compiled.marks);
  }
  auto drawing = view::drawnProgram(sources, files.value(), *compiled.dialect, compile, diagnostics);
  if (!drawing) return failure(changed);
  if (!title.empty()) drawing->title = title;
  return web::ShownProgram(std::move(*drawing));
}

} // namespace

std::function<std::unique_ptr<ir::RungObserver>(const compiler::Compiled&)> WebFlow::observer() {
  return [target = target_](const compiler::Compiled&) { return std::make_unique<Delivery>(target); };
}

std::string webProblem(const std::string& listen, bool sharedObject, const std::string& engine) {
  if (!web::parseListen(listen))
    return fmt::format("--listen {}: expected a port, or ADDRESS:PORT such as 192.168.0.5:8080", listen);
  if (sharedObject) return "--web shows the rungs of sources, and this is a shared object: run its sources";
  if (!engine.empty() && engine != "interp") return fmt::format("--web runs on the interpreter, not on '{}'", engine);
  return {};
}

int serveSession(const SourceOptions& source, const std::string& listen, const compiler::Compiled& compiled,
                 scenario::Session& session, const scenario::Explainer& explainer, WebFlow& flow,
                 const std::function<bool()>& ended) {
  const Result<web::ShownProgram> program = shownProgram(source, compiled);
  if (!program.ok()) return environmentError(program.error());
  web::FlowObserver observer(*compiled.module, compiled.marks, program.value());
  flow.deliver(&observer);
  web::SessionSource shown(session, explainer, program.value(), observer);
  web::Page page(program.value(), shown);
  web::Server* server = nullptr;
  Result<std::unique_ptr<web::Server>> started =
      web::Server::start(*web::parseListen(listen), [&](const web::Request& request) {
        return page.respond(request, [&] { return server->newLink(); });
      });
  if (!started.ok()) return environmentError(started.error());
  server = started.value().get();
  fmt::print("{}\n", server->newLink());
  std::fflush(stdout);
  shown.run(ended);
  started.value().reset();
  flow.deliver(nullptr);
  return kOk;
}

} // namespace rung::rungc
