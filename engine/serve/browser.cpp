#include "engine/serve/browser.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>

#include "engine/base/spawn.h"

namespace acentric {
namespace {

Error noBrowser(const char* why, const std::string& address) {
  return {ErrorKind::notFound, fmt::format("{}: open {} in a browser yourself", why, address), {}};
}

}  // namespace

Status Browser::open(const std::string& address) {
  const auto process = spawnProgram({"xdg-open", address}, {});
  if (!process)
    return tl::unexpected(noBrowser("There is no xdg-open (package xdg-utils) to open a browser", address));
  started_.push_back({*process, address});
  return {};
}

std::optional<Error> Browser::takeTrouble() {
  std::optional<Error> trouble;
  std::erase_if(started_, [&](const Started& started) {
    int status = 0;
    const pid_t got = ::waitpid(started.process, &status, WNOHANG);
    if (got == 0 || (got < 0 && errno == EINTR)) return false;
    if (got > 0 && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
      trouble = noBrowser("xdg-open found no browser", started.address);
    return true;
  });
  return trouble;
}

}  // namespace acentric
