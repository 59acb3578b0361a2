/// acentric-importer MODEL OPTIONS OUTPUT MEMORY_BYTES SECONDS PARENT
/// Reads one model and writes one scene file, under limits of its own, so that a broken model takes down this
/// process and nothing else. Started by importScene; what it prints is for that (importer_protocol.h).

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/scene/importer_protocol.h"
#include "engine/scene/parse.h"

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // reserves terabytes of address space
#else
constexpr bool kSanitized = false;
#endif

void say(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

int refuse(const acentric::Error& error) {
  say(acentric::errorLine(error));
  return 1;
}

void limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(resource, &both);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace acentric;
  if (argc != 7) {
    std::fputs(
        "acentric-importer is run by acentric; it takes MODEL OPTIONS OUTPUT MEMORY_BYTES SECONDS PARENT\n",
        stderr);
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphan goes on when the editor is killed
  // Gone before that was said? The parent may well be process 1, as in a container.
  if (::getppid() != std::strtol(argv[6], nullptr, 10)) return 1;
  const double seconds = std::strtod(argv[5], nullptr);
  const unsigned long long memory = std::strtoull(argv[4], nullptr, 10);
  limit(RLIMIT_CORE, 0);
  if (memory > 0 && !kSanitized) limit(RLIMIT_AS, rlim_t(memory));
  if (seconds > 0) limit(RLIMIT_CPU, rlim_t(std::ceil(seconds * 4 + 5)));  // the parent keeps the wall clock

  const auto options = optionsFromJson(argv[2]);
  if (!options) return refuse(options.error());
  auto last = std::chrono::steady_clock::time_point{};
  const Progress progress = [&](const ProgressState& state) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last < std::chrono::milliseconds(50)) return;
    last = now;
    say(progressLine(state));
  };
  const auto parsed = parseModel(argv[1], *options, progress, memory);
  if (!parsed) return refuse(parsed.error());
  if (auto status = writeSceneFile(*parsed, argv[3]); !status) return refuse(status.error());
  say(writtenLine());
  return 0;
}
