#include "editor/session/picture_ask.h"

#include <utility>

#include "editor/session/engine_texts.h"
#include "ui/translate.h"

namespace acentric::editor {

void PictureAsk::clear() {
  job_.abandon();
  question_.reset();
  answer_.reset();
  improvements_.reset();
  problem_.clear();
}

void PictureAsk::ask(const PictureQuestion& question) {
  clear();
  question_ = question;
  job_.restart(tr("Asking the picture"), [this, asked = question, threads = threads_,
                                          host = host_](const Job::Context& context) {
    TaskRunner runner(threads - 1);
    const auto fail = [&](const Error& error) {
      context.post([this, text = engineText(error)] { problem_ = text; });
    };
    auto found = askPicture(*asked.open, asked.walk->walk, *asked.frame, asked.view, asked.pixel, runner,
                            context.stop());
    if (!found) return fail(found.error());
    const auto answer = std::make_shared<const PictureAnswer>(std::move(*found));
    context.post([this, answer] { answer_ = answer; });
    auto better = improvementsOf(*asked.open, *answer, kImprovements, host, runner, context.stop());
    if (!better) return fail(better.error());
    const auto improvements = std::make_shared<const std::vector<Improvement>>(std::move(*better));
    context.post([this, improvements] { improvements_ = improvements; });
  });
}

}  // namespace acentric::editor
