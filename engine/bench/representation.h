#pragma once
/// A way of keeping a scene for a walk, made and ready to be drawn, with what it costs: what bench
/// representations compares.

#include <memory>

#include "engine/pipeline/pipeline.h"

namespace acentric {

/// What is drawn of a representation.
class RepresentationView {
 public:
  virtual ~RepresentationView() = default;
  virtual Result<Frame> render(const PerspectiveView& view, TaskRunner& runner,
                               FrameMemory& memory) const = 0;
};

struct RepresentationCost {
  double samplesPerDegree = 0;     ///< 0 = has no captures
  int cameras = 0;                 ///< captures
  std::uint64_t captureBytes = 0;  ///< packed, on disk
  std::uint64_t lightBytes = 0;    ///< light on surfaces that are drawn as polygons
  std::uint64_t meshBytes = 0;     ///< of those polygons, see meshBytes() below; textures are not counted
  std::uint64_t samples = 0;       ///< of all captures
  std::size_t triangles = 0;       ///< the most that a frame draws
  double bakeSeconds = 0;          ///< also where an earlier run baked it
  bool reused = false;             ///< an earlier run baked it
  std::uint64_t bytes() const { return captureBytes + lightBytes + meshBytes; }
};

struct Representation {
  std::string name, description;
  RepresentationCost cost;
  std::unique_ptr<const RepresentationView> view;
};

/// Where representations are made: each keeps what it bakes in a folder of its own within `folder`, under
/// content keys, and takes from there what an earlier run made.
struct Workplace {
  const OpenProject& open;
  std::filesystem::path folder;
  TaskRunner& runner;
  const Progress& progress;
  std::stop_token stop;

  /// As if it were a project's file.
  std::filesystem::path fileOf(const std::string& name) const { return folder / (name + ".acentric.json"); }
};

/// Positions, normals, texture coordinates and indices as floats and 32-bit numbers.
constexpr std::uint64_t meshBytes(std::uint64_t vertices, std::uint64_t triangles) {
  return 32 * vertices + 12 * triangles;
}

/// Packed, of captures that are in the store.
Result<std::uint64_t> packedBytes(const CaptureStore& store, std::span<const ContentKey> keys);

/// What a finished bake leaves for the next run: at what it was baked, and how long it took.
struct BakeNote {
  ContentKey key;  ///< of all that it was made from
  double samplesPerDegree = 0, seconds = 0;
};
/// The note of that key; nothing where there is none.
std::optional<BakeNote> readNote(const Workplace& at, const std::string& name, const ContentKey& key);
Status writeNote(const Workplace& at, const std::string& name, const BakeNote& note);

}  // namespace acentric
