#pragma once
/// A pixel of the walk that was asked about (pipeline/ask_picture.h), answered in the background: first what
/// it is, then what would improve it. Main thread only.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/session/job.h"
#include "engine/pipeline/ask_picture.h"

namespace acentric::editor {

struct PictureQuestion {
  std::shared_ptr<const OpenProject> open;
  std::shared_ptr<const LoadedWalk> walk;  ///< that the frame was drawn from
  std::shared_ptr<const Frame> frame;
  PerspectiveView view;  ///< of the frame
  glm::ivec2 pixel{0};
};

class PictureAsk {
 public:
  static constexpr std::size_t kImprovements = 3;

  PictureAsk(Inbox& inbox, int threads, ImportHost host)
      : threads_(threads), host_(std::move(host)), job_(inbox) {}

  void ask(const PictureQuestion& question);
  void clear();

  const std::optional<PictureQuestion>& question() const { return question_; }
  /// Null while it is asked for.
  const std::shared_ptr<const PictureAnswer>& answer() const { return answer_; }
  /// The best first; null while they are looked for.
  const std::shared_ptr<const std::vector<Improvement>>& improvements() const { return improvements_; }
  const std::string& problem() const { return problem_; }  ///< one line; empty: none

 private:
  int threads_;
  ImportHost host_;
  std::optional<PictureQuestion> question_;
  std::shared_ptr<const PictureAnswer> answer_;
  std::shared_ptr<const std::vector<Improvement>> improvements_;
  std::string problem_;
  Job job_;
};

}  // namespace acentric::editor
