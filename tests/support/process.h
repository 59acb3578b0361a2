#pragma once
/// Runs a program as a user would, for tests of whole programs.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace acentric::test {

struct ProcessResult {
  int exitCode = -1;  ///< -1 when ended by a signal
  int signal = 0;
  std::string output;  ///< stdout
  std::string errors;  ///< stderr
  double seconds = 0;
};

/// Runs to the end, or sends SIGKILL after `limit` (then signal is 9).
ProcessResult runProcess(const std::vector<std::string>& arguments,
                         std::chrono::milliseconds limit = std::chrono::minutes(5));

/// A new empty folder below the system's temporary one, removed with its content at the end of its life.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace acentric::test
