#pragma once
/// Publishing the open project: in the background its folder for web servers is written, then a server on
/// this machine shows it to the browser until another project is opened, the user stops it, or the editor
/// ends.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "editor/session/job.h"
#include "editor/session/messages.h"
#include "editor/session/preferences.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/publish_walk.h"
#include "engine/serve/browser.h"
#include "engine/serve/folder_server.h"

namespace acentric::editor {

/// "kitchen.acentric.json" -> "kitchen-web" beside it.
std::filesystem::path suggestedPublishFolder(const std::filesystem::path& project);

/// As it is typed, without a view; fails for anything but http and https.
Result<std::string> checkPublicAddress(const std::string& typed);

/// A view of the walk as the page's address has it: "#at=x,y,yaw,pitch", metres and degrees, and "&storey=".
std::string viewAddress(const glm::dvec3& eye, double yawRadians, double pitchRadians, int storey);

struct Published {
  PublishPlace place;
  PublishReport report;
  double seconds = 0;  ///< that it took
  bool again = false;  ///< it took the place of an earlier one
};

/// Belongs to the main thread.
class Publisher {
 public:
  /// `page`: folder of the built page; empty = where it is installed or built.
  Publisher(Inbox& inbox, Messages& messages, std::filesystem::path page);

  /// All storeys of the project as it is open here. Asks about what is not baked (gaps()), unless that may be
  /// missing; nothing is written then.
  void publish(std::shared_ptr<const OpenProject> open, const PublishPlace& place, bool allowMissing,
               const ImportHost& host, int threads);
  /// What was published before stays.
  void cancel() { job_.cancel(); }
  const Job& job() const { return job_; }

  /// What the last publish() asked about.
  const std::optional<BakeGaps>& gaps() const { return gaps_; }
  /// Why the last one failed; empty: it did not.
  const std::string& trouble() const { return trouble_; }
  void forgetAnswers();
  const std::optional<Published>& published() const { return published_; }

  bool serving() const { return server_ != nullptr; }
  /// Serves what is published, if it is not yet.
  void serve();
  void stopServing();
  /// Of the page, where the walk begins; empty unless it is served.
  std::string address() const { return server_ ? server_->address() : std::string(); }
  void openInBrowser();
  /// Of the page that was opened last, once it showed a frame.
  std::optional<PageLoad> lastLoad() const { return server_ ? server_->lastLoad() : std::nullopt; }

  /// Another project is opened: stops all, and forgets it.
  void close();
  /// Tells of browsers that did not open.
  void poll();

 private:
  using Outcome = Result<Published>;
  static Outcome write(const OpenProject& open, const PublishPlace& place, bool allowMissing,
                       const std::filesystem::path& page, const ImportHost& host, TaskRunner& runner,
                       const Job::Context& context, std::optional<BakeGaps>& asked);
  void ended(const Outcome& outcome, const std::optional<BakeGaps>& asked);

  Inbox& inbox_;
  Messages& messages_;
  std::filesystem::path page_;
  std::optional<BakeGaps> gaps_;
  std::string trouble_;
  std::optional<Published> published_;
  Browser browser_;
  std::unique_ptr<FolderServer> server_;
  Job job_{inbox_};
  Job stopping_{inbox_};
};

}  // namespace acentric::editor
