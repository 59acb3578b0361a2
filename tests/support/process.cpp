#include "tests/support/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace acentric::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    read = ends[0], write = ends[1];
  }
  ~Pipe() { closeRead(), closeWrite(); }
  void closeRead() {
    if (read >= 0) ::close(read), read = -1;
  }
  void closeWrite() {
    if (write >= 0) ::close(write), write = -1;
  }
};

[[noreturn]] void becomeProgram(const std::vector<std::string>& arguments, int out, int err) {
  ::setpgid(0, 0);  // its children are killed with it
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) {
  Pipe out, err;
  const auto begin = Clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) becomeProgram(arguments, out.write, err.write);
  out.closeWrite();
  err.closeWrite();

  ProcessResult result;
  pollfd waits[2] = {{out.read, POLLIN, 0}, {err.read, POLLIN, 0}};
  std::string* texts[2] = {&result.output, &result.errors};
  int open = 2;
  bool killed = false;
  while (open > 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(limit - (Clock::now() - begin)).count();
    if (left <= 0 && !killed) ::kill(-child, SIGKILL), killed = true;
    ::poll(waits, 2, killed ? 1000 : int(std::max<long>(1, long(left))));
    for (int k = 0; k < 2; ++k) {
      if (waits[k].fd < 0 || waits[k].revents == 0) continue;
      char buffer[4096];
      const ssize_t got = ::read(waits[k].fd, buffer, sizeof buffer);
      if (got > 0)
        texts[k]->append(buffer, std::size_t(got));
      else
        waits[k].fd = -1, --open;
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / ("acentric-" + name + "-XXXXXX")).string();
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

}  // namespace acentric::test
