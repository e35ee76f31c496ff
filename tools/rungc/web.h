// The live page of a program that rungc runs.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/explain.h"
#include "tools/scenario/session.h"
#include "tools/web/flow_observer.h"

namespace rung::rungc {

// What the engine of a program shows the page. The observer is made with the engine, the page's program afterwards.
class WebFlow {
public:
  // Makes the engine's observer.
  std::function<std::unique_ptr<ir::RungObserver>(const compiler::Compiled&)> observer();
  // From now on the observer delivers to `flow`, which must outlive the engine's last scan.
  void deliver(web::FlowObserver* flow) { *target_ = flow; }

private:
  std::shared_ptr<web::FlowObserver*> target_ = std::make_shared<web::FlowObserver*>(nullptr);
};

// "" or why there can be no page: an address that is none, a program that the interpreter does not run.
std::string webProblem(const std::string& listen, bool sharedObject, const std::string& engine);

// Prints the link and runs the session until `ended` returns true. Returns the exit status.
int serveSession(const SourceOptions& source, const std::string& listen, const compiler::Compiled& compiled,
                 scenario::Session& session, const scenario::Explainer& explainer, WebFlow& flow,
                 const std::function<bool()>& ended);

} // namespace rung::rungc
