#pragma once
/// What captures have on the graphics card, and on its way there. Either frames wait for what they lack, or
/// it is packed in the background and sent piece by piece, and frames are told what there is.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/view_gl/capture_builder.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/residency.h"
#include "engine/view_gl/send_limit.h"

namespace acentric {

/// So much is sent before a frame looks at the clock.
inline constexpr std::size_t kBytesAtOnce = std::size_t(1) << 20;

/// Of what is built: what the last frame lacked, or also what is for those to come.
enum class Which { lacked, all };

/// To the graphics card, packed for it by the frame itself included.
struct Sent {
  std::size_t bytes = 0;
  double seconds = 0;
};

/// `Upload` is made of a task and what it was packed to; it has `task`, `send`, `done`, `bytes` and `take`,
/// which gives `Buffers` (residency.h). Task and Packed: capture_builder.h.
template <class Task, class Packed, class Upload, class Buffers>
class BuiltResidency : public Residency<Buffers> {
 public:
  using Builder = CaptureBuilder<Task, Packed>;

  /// Sends what is packed, as far as the limit allows. True if something is now ready, or cannot be, that the
  /// last frame lacked.
  Result<bool> receive(SendLimit& limit, Which which = Which::all) {
    if (!builder_) return false;
    const Stopwatch watch;
    bool news = false;
    while (limit.left() > 0 && (upload_ || takeBuilt(Which::lacked, news) || takeBuilt(which, news))) {
      if (which == Which::lacked && !isAwaited(upload_->task())) break;
      const std::size_t sentNow = upload_->send(std::min(limit.left(), kBytesAtOnce));
      limit.sent(sentNow);
      sent_.bytes += sentNow;
      const Task task = upload_->task();
      if (Status sent = checkSent(task); !sent) {
        upload_.reset();
        return tl::unexpected(sent.error());
      }
      if (!upload_->done()) continue;
      if (const auto capture = task.capture.lock()) {
        this->put(capture, upload_->take());
        news = news || isAwaited(task);
      }
      upload_.reset();
    }
    sent_.seconds += watch.seconds();
    return news;
  }
  /// Is there something for receive() to do?
  bool anyToReceive() const { return builder_ && (upload_ || builder_->anyBuilt()); }
  /// Gives up what is on its way, until frames ask for it again.
  void stopBuilding() {
    keepOnly([](const Task&) { return false; });
  }
  /// Since the last call.
  Sent takeSent() { return std::exchange(sent_, {}); }
  /// As Residency::trim; what is on its way counts.
  void trim(std::size_t bytes) {
    const std::size_t coming = upload_ ? upload_->bytes() : 0;
    Residency<Buffers>::trim(bytes - std::min(bytes, coming));
  }

 protected:
  /// Without a builder frames wait, and what they lack is packed with `runner`.
  BuiltResidency(typename Builder::Pack pack, TaskRunner& runner, std::unique_ptr<Builder> builder)
      : pack_(std::move(pack)), runner_(runner), builder_(std::move(builder)) {}

  bool waits() const { return !builder_; }
  /// Gives up what is not `useful`, on its way and failed too.
  template <class Useful>
  void keepOnly(const Useful& useful) {
    wanted_.clear();
    lacked_.clear();
    if (!builder_) return;
    builder_->keepOnly(useful);
    if (upload_ && !useful(upload_->task())) upload_.reset();
    std::erase_if(failed_, [&](const auto& failed) { return !useful(failed.first); });
  }
  /// Is to be packed, after what was asked for before it. `lacked`: by this frame; otherwise it is for those
  /// to come. Fails if it could not be.
  Status want(const Task& task, bool lacked = true) {
    const auto same = [&](const Task& other) { return task.sameAs(other); };
    if (lacked) lacked_.push_back(task);
    for (const auto& [failed, error] : failed_)
      if (same(failed)) return tl::unexpected(error);
    if (std::ranges::none_of(wanted_, same) && !(upload_ && same(upload_->task()))) wanted_.push_back(task);
    return {};
  }
  void beginWanted() {
    awaited_ = std::exchange(lacked_, {});
    if (builder_) builder_->want(std::exchange(wanted_, {}));
  }
  /// Packs and sends it here and now.
  Result<Buffers*> build(const std::shared_ptr<const DisplayCapture>& capture, const Task& task) {
    const Stopwatch watch;
    Result<Packed> packed = pack_(*capture, task, runner_, {});
    if (!packed) return tl::unexpected(packed.error());
    Upload upload(task, std::move(*packed));
    sent_.bytes += upload.send(std::numeric_limits<std::size_t>::max());
    sent_.seconds += watch.seconds();
    if (Status sent = checkSent(task); !sent) return tl::unexpected(sent.error());
    return &this->put(capture, upload.take());
  }

  std::vector<Task> wanted_;  ///< by this frame

 private:
  static Status checkSent(const Task& task) {
    return checkGl(fmt::format("uploading {}", task.name).c_str());
  }
  bool isAwaited(const Task& task) const {
    return std::ranges::any_of(awaited_, [&](const Task& other) { return task.sameAs(other); });
  }
  /// The next to be sent; keeps what failed.
  bool takeBuilt(Which which, bool& news) {
    const auto wanted = [&](const Task& task) { return which == Which::all || isAwaited(task); };
    while (std::optional<typename Builder::Built> built = builder_->takeBuilt(wanted)) {
      if (built->packed) {
        upload_.emplace(std::move(built->task), std::move(*built->packed));
        return true;
      }
      news = news || isAwaited(built->task);
      failed_.emplace_back(std::move(built->task), built->packed.error());
    }
    return false;
  }

  typename Builder::Pack pack_;
  TaskRunner& runner_;
  std::unique_ptr<Builder> builder_;
  std::optional<Upload> upload_;
  std::vector<std::pair<Task, Error>> failed_;
  std::vector<Task> lacked_;   ///< by this frame
  std::vector<Task> awaited_;  ///< lacked by the last
  Sent sent_;
};

}  // namespace acentric
