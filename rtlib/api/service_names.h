// Names of the services of an instance's programs. A request that waits has one of them, whichever program runs when it
// is taken, and whether the one that asks for it exists still.
#pragma once
#include <list>
#include <mutex>
#include <string>
#include <vector>

#include "rung/program.h"

namespace rung::api {

class ServiceNames {
public:
  // By the numbers of the services; valid as long as this. Programs that number them alike have one list. Any thread,
  // but not in real time.
  const char* const* of(const rung_program& program);

private:
  struct List {
    std::vector<std::string> texts;
    std::vector<const char*> names;
  };
  std::mutex mutex_;
  std::list<List> lists_;
};

} // namespace rung::api
