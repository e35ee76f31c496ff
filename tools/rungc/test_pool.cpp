// Runs scenarios on several threads (see test_pool.h). They share compiled programs (EngineStore) and nothing else.
#include "tools/rungc/test_pool.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace rung::rungc {
namespace {

constexpr std::chrono::milliseconds kTick{200};

class Pool {
public:
  Pool(const std::vector<std::string>& files, const scenario::RunOptions& options)
      : files_(files), options_(options), results_(files.size()) {}

  void run(unsigned threads, const PoolCalls& calls) {
    std::vector<std::jthread> workers;
    for (size_t i = 0; i < std::min<size_t>(threads, files_.size()); ++i) workers.emplace_back([this] { work(); });
    for (size_t i = 0; i < files_.size(); ++i)
      if (!calls.finished(take(i, calls))) break;
    const std::lock_guard lock(mutex_);
    next_ = files_.size();
  }

private:
  void work() {
    for (size_t i = begin(); i < files_.size(); i = begin()) {
      TestCase result = runOne(files_[i], options_);
      const std::lock_guard lock(mutex_);
      results_[i] = std::move(result);
      changed_.notify_one();
    }
  }

  size_t begin() {
    const std::lock_guard lock(mutex_);
    return next_ < files_.size() ? next_++ : files_.size();
  }

  TestCase take(size_t i, const PoolCalls& calls) {
    std::unique_lock lock(mutex_);
    std::optional<TestCase>& result = results_[i];
    while (!result) {
      if (changed_.wait_for(lock, kTick, [&] { return result.has_value(); })) continue;
      lock.unlock();
      calls.waiting(files_[i]);
      lock.lock();
    }
    TestCase taken = std::move(*result);
    result.reset();
    return taken;
  }

  const std::vector<std::string>& files_;
  const scenario::RunOptions& options_;
  std::mutex mutex_; // of what follows
  std::condition_variable changed_;
  std::vector<std::optional<TestCase>> results_;
  size_t next_ = 0;
};

} // namespace

void runAll(const std::vector<std::string>& files, const scenario::RunOptions& options, unsigned threads,
            const PoolCalls& calls) {
  Pool(files, options).run(threads, calls);
}

} // namespace rung::rungc
