#include <fmt/format.h>

#include <condition_variable>
#include <mutex>

#include "engine/base/program_file.h"
#include "engine/cli/commands.h"
#include "engine/export/bundle.h"
#include "engine/export/web_page.h"
#include "engine/serve/browser.h"
#include "engine/serve/folder_server.h"

namespace acentric::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kUsualPort = 8000;

/// The folder of the page, where the subject has none; empty where it needs none.
Result<fs::path> pageFor(const fs::path& subject) {
  std::error_code error;
  const bool folder = fs::is_directory(subject, error);
  if (folder && !fs::exists(subject / kBundleIndex, error)) return fs::path();  // whatever it is
  if (folder && fs::exists(subject / kPageFiles.back(), error)) return fs::path();
  return findWebPage(ownProgram());
}

Result<std::unique_ptr<FolderServer>> startServer(const ServeCommandOptions& options, ServeOptions serving) {
  if (options.port) {
    serving.port = *options.port;
    return FolderServer::start(std::move(serving));
  }
  serving.port = kUsualPort;
  if (auto usual = FolderServer::start(serving)) return usual;
  serving.port = 0;
  return FolderServer::start(std::move(serving));
}

}  // namespace

Result<Report> runServe(const ServeCommandOptions& options, const Common& common) {
  std::error_code error;
  const fs::path subject = fs::absolute(options.subject, error).lexically_normal();
  if (!fs::exists(subject, error))
    return fail(ErrorKind::notFound, "no such file or folder", options.subject.string());
  const auto page = pageFor(subject);
  if (!page) return tl::unexpected(page.error());

  std::mutex mutex;
  std::condition_variable_any changed;
  std::vector<PageLoad> loads;  // not told of yet
  auto server = startServer(options, {subject, *page, 0, [&](const PageLoad& load) {
                                        const std::lock_guard lock(mutex);
                                        loads.push_back(load);
                                        changed.notify_one();
                                      }});
  if (!server) return tl::unexpected(server.error());
  const std::string address = (*server)->address();
  common.notice(fmt::format("{} is at {} (stop it with Ctrl+C)", subject.string(), address),
                {{"event", "serving"}, {"folder", subject.string()}, {"address", address}});
  Browser browser;
  if (options.open)
    if (Status opened = browser.open((*server)->reportingAddress()); !opened)
      common.notice(opened.error().describe(), {{"event", "noBrowser"}, {"address", address}});

  Report report;
  report.json = {{"address", address}, {"loads", Json::array()}};
  const auto tellLoads = [&] {
    for (const PageLoad& load : std::exchange(loads, {})) {
      const Json told = {{"seconds", load.seconds}, {"bytes", load.bytes}, {"requests", load.requests}};
      report.json["loads"].push_back(told);
      common.notice(fmt::format("first frame after {:.1f} s: {} in {} requests", load.seconds,
                                bytesText(load.bytes), load.requests),
                    {{"event", "firstFrame"}, {"load", told}});
    }
  };
  std::unique_lock lock(mutex);
  while (!common.stop.stop_requested()) {
    constexpr auto kLook = std::chrono::milliseconds(500);  // at the browser
    changed.wait_for(lock, common.stop, kLook, [&] { return !loads.empty(); });
    if (const auto trouble = browser.takeTrouble())
      common.notice(trouble->describe(), {{"event", "noBrowser"}, {"address", address}});
    tellLoads();
  }
  lock.unlock();
  server->reset();  // whatever it has answered is in `loads` now
  tellLoads();
  return report;
}

}  // namespace acentric::cli
