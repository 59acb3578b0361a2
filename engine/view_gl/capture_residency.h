#pragma once
/// Which captures are on the graphics card, and on their way there. Either frames wait for what they lack, or
/// it is sent piece by piece, and frames are told what there is.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/residency.h"
#include "engine/view_gl/send_limit.h"

namespace acentric {

/// To the graphics card.
struct Sent {
  std::size_t bytes = 0;
  double seconds = 0;
};

class CaptureResidency : public Residency<CaptureBuffers> {
 public:
  /// `largestBuffer`: bytes, 0 = what the driver allows.
  explicit CaptureResidency(std::size_t largestBuffer = 0) : largestBuffer_(largestBuffer) {}

  /// Before a frame: gives up what is on its way for captures that are not among these, or are there.
  void begin(const CaptureSet& inScene);
  /// Is it on the graphics card? It is used in this frame.
  bool ready(const std::shared_ptr<const DisplayCapture>& capture) { return find(capture) != nullptr; }
  /// The buffers of `capture`, sent now if it is not there. Valid until the next call of begin, receive,
  /// dropGone or trim.
  Result<const CaptureBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture,
                                    const std::string& name);
  /// Is to be sent, after what this frame asked for before it. `lacked`: by this frame; otherwise it is for
  /// those to come. Fails if it could not be.
  Status ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
             bool lacked = true);
  /// After a frame: what it asked for is sent next.
  void end() { waiting_ = std::exchange(wanted_, {}); }

  /// Sends what was asked for, as far as the limit allows. True if something is now ready, or cannot be, that
  /// the last frame lacked.
  Result<bool> receive(SendLimit& limit);
  /// Is there something for receive() to do?
  bool anyToReceive() const { return upload_ || !waiting_.empty(); }
  /// Gives up what is on its way, until frames ask for it again.
  void stop();
  /// Since the last call.
  Sent takeSent() { return std::exchange(sent_, {}); }
  /// As Residency::trim; what is on its way counts.
  void trim(std::size_t bytes);

 private:
  struct Asked {
    std::weak_ptr<const DisplayCapture> capture;
    std::string name;
    bool lacked = false;
    bool isOf(const std::weak_ptr<const DisplayCapture>& other) const {
      return !capture.owner_before(other) && !other.owner_before(capture);
    }
  };
  struct Failed {
    Asked asked;
    Error error;
  };
  /// The next that waits, if there is any that can be sent.
  void beginNext(bool& news);

  std::size_t largestBuffer_;
  std::optional<CaptureUpload> upload_;
  Asked uploading_;  ///< what upload_ is of
  std::vector<Failed> failed_;
  std::vector<Asked> wanted_;   ///< by this frame
  std::vector<Asked> waiting_;  ///< to be sent, the last frame's
  Sent sent_;
};

}  // namespace acentric
