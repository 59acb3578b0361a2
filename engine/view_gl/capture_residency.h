#pragma once
/// Which captures are on the graphics card, and on their way there. Either frames wait for what they lack, or
/// it is packed in the background and sent piece by piece, and frames are told what there is.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/capture_builder.h"
#include "engine/view_gl/residency.h"
#include "engine/view_gl/send_limit.h"

namespace acentric {

/// Of what is packed: what the last frame lacked, or also what is for those to come.
enum class Which { lacked, all };

/// To the graphics card, packed for it by the frame itself included.
struct Sent {
  std::size_t bytes = 0;
  double seconds = 0;
};

class CaptureResidency : public Residency<CaptureBuffers> {
 public:
  /// Without a builder frames wait. `largestBuffer`: bytes, 0 = what the driver allows.
  explicit CaptureResidency(std::unique_ptr<CaptureBuilder> builder = nullptr, std::size_t largestBuffer = 0)
      : builder_(std::move(builder)), largestBuffer_(largestBuffer) {}

  /// Before a frame: gives up what is on its way for captures that are not among these, or are ready.
  void begin(const CaptureSet& inScene);
  /// Are these parts of it on the graphics card? They are used in this frame.
  bool ready(const std::shared_ptr<const DisplayCapture>& capture,
             CaptureParts parts = CaptureParts::samples);
  /// The buffers of `capture`, packed and sent now if it is not ready. Valid until the next call of begin,
  /// receive, dropGone or trim.
  Result<const CaptureBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture,
                                    const std::string& name, CaptureParts parts = CaptureParts::samples);
  /// Is to be packed in the background, after what this frame asked for before it. `lacked`: by this frame;
  /// otherwise it is for those to come. Fails if it could not be.
  Status ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
             CaptureParts parts = CaptureParts::samples, bool lacked = true);
  /// After a frame: what it asked for is packed next.
  void end();

  /// Sends what is packed, as far as the limit allows. True if something is now ready, or cannot be, that the
  /// last frame lacked.
  Result<bool> receive(SendLimit& limit, Which which = Which::all);
  /// Is there something for receive() to do?
  bool anyToReceive() const { return builder_ && (upload_ || builder_->anyBuilt()); }
  /// Gives up what is on its way, until frames ask for it again.
  void stopBuilding() {
    keepOnly([](const CaptureTask&) { return false; });
  }
  /// Since the last call.
  Sent takeSent() { return std::exchange(sent_, {}); }
  /// As Residency::trim; what is on its way counts.
  void trim(std::size_t bytes);

 private:
  CaptureTask taskOf(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                     CaptureParts parts) const;
  /// Gives up what is not `useful`, on its way and failed too.
  void keepOnly(const std::function<bool(const CaptureTask&)>& useful);
  bool isAwaited(const CaptureTask& task) const;
  /// The next to be sent; keeps what failed.
  bool takeBuilt(Which which, bool& news);

  std::unique_ptr<CaptureBuilder> builder_;
  std::size_t largestBuffer_;
  std::optional<CaptureUpload> upload_;
  std::vector<std::pair<CaptureTask, Error>> failed_;
  std::vector<CaptureTask> wanted_;   ///< by this frame
  std::vector<CaptureTask> lacked_;   ///< by this frame
  std::vector<CaptureTask> awaited_;  ///< lacked by the last
  Sent sent_;
};

}  // namespace acentric
