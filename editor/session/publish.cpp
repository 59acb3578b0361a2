#include "editor/session/publish.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "editor/session/engine_texts.h"
#include "editor/session/project_files.h"
#include "engine/base/priority.h"
#include "engine/base/program_file.h"
#include "engine/base/stopwatch.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {

namespace fs = std::filesystem;

fs::path suggestedPublishFolder(const fs::path& project) {
  std::string name = project.filename().string();
  if (name.ends_with(kProjectEnding)) name.resize(name.size() - std::string_view(kProjectEnding).size());
  return project.parent_path() / (name + "-web");
}

std::string viewAddress(const glm::dvec3& eye, double yawRadians, double pitchRadians, int storey) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  return fmt::format("#at={:.2f},{:.2f},{:.1f},{:.1f}&storey={}", eye.x, eye.y, yawRadians * kDegrees,
                     pitchRadians * kDegrees, storey);
}

Result<std::string> checkPublicAddress(const std::string& typed) {
  std::string address = typed.substr(0, typed.find('#'));
  const bool plain = std::ranges::all_of(address, [](unsigned char c) { return c > ' ' && c != 0x7f; });
  const std::size_t scheme = address.find("://");
  const bool web = address.starts_with("http://") || address.starts_with("https://");
  if (address.empty() || (web && plain && address.size() > scheme + 3)) return address;
  return fail(ErrorKind::invalidArgument, tr("is no address of a page: it begins with https:// or http://"),
              typed);
}

Publisher::Publisher(Inbox& inbox, Messages& messages, fs::path page)
    : inbox_(inbox), messages_(messages), page_(std::move(page)) {}

void Publisher::forgetAnswers() {
  gaps_.reset();
  trouble_.clear();
}

void Publisher::close() {
  job_.abandon();
  forgetAnswers();
  published_.reset();
  stopServing();
}

void Publisher::publish(std::shared_ptr<const OpenProject> open, const PublishPlace& place, bool allowMissing,
                        const ImportHost& host, int threads) {
  forgetAnswers();
  job_.restart(tr("Publishing"), [this, open = std::move(open), place, allowMissing, page = page_, host,
                                  threads](const Job::Context& context) {
    lowerThreadPriority();  // the window comes first
    TaskRunner runner(threads - 1);
    std::optional<BakeGaps> asked;
    const Outcome outcome = write(*open, place, allowMissing, page, host, runner, context, asked);
    context.post([this, outcome, asked] { ended(outcome, asked); });
  });
}

/// Where it asks, it says so in `asked`, and fails.
Publisher::Outcome Publisher::write(const OpenProject& open, const PublishPlace& place, bool allowMissing,
                                    const fs::path& page, const ImportHost& host, TaskRunner& runner,
                                    const Job::Context& context, std::optional<BakeGaps>& asked) {
  const Stopwatch watch;
  PublishOptions options;
  options.page = page;
  std::error_code error;
  if (page.empty()) {
    auto found = findWebPage(ownProgram());
    if (!found) return tl::unexpected(found.error());
    options.page = std::move(*found);
  }
  if (Status free = checkPublishTarget(place.folder); !free) return tl::unexpected(free.error());
  const auto storeys = openStoreys(open, host, context.progress(), context.stop());
  if (!storeys) return tl::unexpected(storeys.error());
  const auto missing = bakeGaps(*storeys);
  if (!missing) return tl::unexpected(missing.error());
  if (missing->cameras == 0)
    return fail(ErrorKind::invalidArgument, tr("there are no cells, so there is nothing to publish"));
  if (missing->all() || (missing->any() && !allowMissing)) {
    asked = *missing;
    return fail(ErrorKind::notFound, missing->describe());
  }
  options.oneFile = place.oneFile;
  options.bundle.allowMissing = allowMissing;
  options.bundle.storey = open.project.storey;
  options.bundle.generator = "Acentric " ACENTRIC_VERSION;
  Published published{place, {}, 0, fs::exists(place.folder / "index.html", error)};
  auto report = publishWalk(*storeys, place.folder, options, runner, context.progress(), context.stop());
  if (!report) return tl::unexpected(report.error());
  published.report = std::move(*report);
  published.seconds = watch.seconds();
  return published;
}

void Publisher::ended(const Outcome& outcome, const std::optional<BakeGaps>& asked) {
  gaps_ = asked;
  if (asked) return;
  if (!outcome) {
    const Error& error = outcome.error();
    if (error.kind == ErrorKind::cancelled)
      return messages_.add(MessageLevel::info,
                           tr("Publishing was cancelled; what was published before stays"));
    trouble_ = engineText(error);
    return messages_.add(MessageLevel::error, trf("Publishing failed. {}", trouble_));
  }
  const bool elsewhere = published_ && published_->place.folder != outcome->place.folder;
  published_ = *outcome;
  if (elsewhere) stopServing();
  const bool shown = serving();
  serve();
  const PublishReport& report = published_->report;
  messages_.add(MessageLevel::good, trf("Published {} in {} files to {}{}", ui::formatBytes(report.bytes),
                                        report.files, published_->place.folder.string(),
                                        serving() ? trf(", which is at {} now", address()) : std::string()));
  if (serving() && published_->place.openBrowser && !shown) openInBrowser();
}

void Publisher::serve() {
  if (!published_ || serving()) return;
  auto started = FolderServer::start({published_->place.folder, {}, 0, [&inbox = inbox_](const PageLoad&) {
                                        inbox.post([] {});  // what is shown of it is drawn anew
                                      }});
  if (started)
    server_ = std::move(*started);
  else
    messages_.add(MessageLevel::error, trf("It cannot be served here. {}", engineText(started.error())));
}

/// Elsewhere: browsers hold their connections for a while.
void Publisher::stopServing() {
  if (server_)
    stopping_.restart(tr("Stopping the server"), [old = std::shared_ptr<FolderServer>(std::move(server_))](
                                                     const Job::Context&) mutable { old.reset(); });
}

void Publisher::openInBrowser() {
  if (!serving()) return;
  if (Status opened = browser_.open(server_->reportingAddress()); !opened)
    messages_.add(MessageLevel::warning, engineText(opened.error()));
}

void Publisher::poll() {
  if (const auto trouble = browser_.takeTrouble()) messages_.add(MessageLevel::warning, engineText(*trouble));
}

}  // namespace acentric::editor
