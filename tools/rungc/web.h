// The live page of a program that rungc runs, whose recording it plays, or whose machine it follows.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "tools/replay/past.h"
#include "tools/replay/session_past.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/host.h"
#include "tools/scenario/session.h"

namespace rung::rungc {

inline constexpr const char* kDefaultListen = "127.0.0.1:0";

// "" or why no page can be served there.
std::string listenProblem(const std::string& listen);

// Each of them prints a link, serves the page until `ended` returns true, and returns the exit status.

// `title`: of the page; "": the names of the files. The session has started; its only engine is that of `engine`.
int serveSession(const std::string& title, const std::string& listen, const compiler::Compiled& compiled,
                 scenario::Session& session, replay::SessionPast& past, replay::FlowEngine& engine,
                 const std::function<bool()>& ended);
// `files`: the sources of the program (drawnFrom).
int servePast(const std::string& listen, replay::Past& past, const std::vector<std::string>& files,
              const std::function<bool()>& ended);
int serveMachine(const std::string& listen, FollowedHost host, const std::vector<std::string>& files,
                 const std::function<bool()>& ended);

} // namespace rung::rungc
