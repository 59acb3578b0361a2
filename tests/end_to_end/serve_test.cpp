/// `acentric serve` serves a walk's file with the page until Ctrl+C.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/base/file.h"
#include "engine/base/spawn.h"
#include "tests/support/process.h"

namespace acentric::test {
namespace {

/// The address that a server tells in its log; empty if it does not within a minute.
std::string addressIn(const std::filesystem::path& log) {
  for (int i = 0; i < 600; ++i) {
    std::ifstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      const auto event = nlohmann::json::parse(line, nullptr, false);
      if (event.is_object() && event.value("event", "") == "serving") return event.value("address", "");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return {};
}

TEST(ServeCommand, ServesAFolderUntilItIsInterruptedAndTellsOfFirstFrames) {
  const TemporaryFolder folder("serve");
  std::filesystem::create_directories(folder.path() / "site");
  ASSERT_TRUE(writeTextAtomically(folder.path() / "site" / "index.html", "<p>page"));
  const std::filesystem::path log = folder.path() / "log", output = folder.path() / "output";
  const int descriptor = ::open(output.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const auto server =
      spawnProgram({ACENTRIC_PROGRAM, "serve", (folder.path() / "site").string(), "--port", "0", "--json"},
                   {descriptor, log});
  ::close(descriptor);
  ASSERT_TRUE(server) << server.error().describe();
  const std::string address = addressIn(log);
  const std::size_t colon = address.rfind(':');
  if (colon != std::string::npos && colon > 4) {
    httplib::Client client("127.0.0.1", std::stoi(address.substr(colon + 1)));
    const auto page = client.Get("/?report");
    EXPECT_TRUE(page && page->body == "<p>page");
    EXPECT_TRUE(client.Get("/.acentric/first-frame?ms=1500"));
    const auto outside = client.Get("/../log");
    EXPECT_TRUE(outside && outside->status == 404);
  }
  ::kill(*server, SIGINT);
  int status = 0;
  while (::waitpid(*server, &status, 0) < 0 && errno == EINTR) {
  }
  EXPECT_FALSE(address.empty()) << readText(log).value_or("");
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << readText(log).value_or("");
  const auto report = nlohmann::json::parse(readText(output).value_or(""), nullptr, false);
  ASSERT_TRUE(report.is_object()) << readText(output).value_or("");
  EXPECT_EQ(report.value("address", ""), address);
  ASSERT_EQ(report["loads"].size(), 1u);
  EXPECT_EQ(report["loads"][0]["seconds"], 1.5);
  EXPECT_EQ(report["loads"][0]["bytes"], 7);
}

TEST(ServeCommand, SaysWhatIsNotThere) {
  const auto none = runProcess({ACENTRIC_PROGRAM, "serve", "/no/such/folder"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_NE(none.errors.find("/no/such/folder: no such file or folder"), std::string::npos) << none.errors;
}

}  // namespace
}  // namespace acentric::test
