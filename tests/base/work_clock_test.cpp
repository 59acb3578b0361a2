#include "engine/base/work_clock.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <thread>

#include "engine/base/priority.h"

namespace acentric {
namespace {

double threadSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

void workFor(double seconds) {
  for (const double end = threadSeconds() + seconds; threadSeconds() < end;) {
  }
}

/// This thread and a process that never rests, on one processor.
class Competitor {
 public:
  Competitor() {
    ::sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(::sched_getcpu(), &one);
    ::sched_setaffinity(0, sizeof one, &one);
    process_ = ::fork();
    if (process_ == 0)
      for (;;) {
      }
  }
  ~Competitor() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    ::sched_setaffinity(0, sizeof before_, &before_);
  }

 private:
  cpu_set_t before_{};
  pid_t process_ = -1;
};

TEST(WorkClock, LeavesOutWhatOtherWorkTakes) {
  const Competitor competitor;
  const WorkClock clock;
  const Stopwatch wall;
  const double begun = threadSeconds();
  workFor(0.5);
  const double work = clock.seconds(), waited = wall.seconds(), own = threadSeconds() - begun;
  if (waited < 1.3 * own) GTEST_SKIP() << "the other process did not run";
  if (work == waited) GTEST_SKIP() << "the system does not tell of waiting threads";
  EXPECT_NEAR(work, own, 0.1 * own);
}

TEST(WorkClock, ThreadsOfAnotherPriorityDoNotCount) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  const std::jthread window([](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
    }
  });
  double work = 0, waited = 0, own = 0;
  std::thread([&] {
    lowerThreadPriority();
    const Competitor competitor;
    const WorkClock clock;
    const Stopwatch wall;
    const double begun = threadSeconds();
    workFor(0.15);
    work = clock.seconds(), waited = wall.seconds(), own = threadSeconds() - begun;
  }).join();
  if (waited < 1.3 * own) GTEST_SKIP() << "the other process did not run";
  if (work == waited) GTEST_SKIP() << "the system does not tell of waiting threads";
  EXPECT_NEAR(work, own, 0.2 * own);
}

TEST(WorkClock, RestCounts) {
  const WorkClock clock;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(clock.seconds(), 0.025);
}

TEST(WorkClock, ThreadsOfWorkThatEndedDoNotConfuseIt) {
  const Stopwatch wall;
  const WorkClock clock;
  std::thread([] { workFor(0.05); }).join();
  workFor(0.05);
  EXPECT_GT(clock.seconds(), 0.0);
  EXPECT_LE(clock.seconds(), wall.seconds());
}

}  // namespace
}  // namespace acentric
