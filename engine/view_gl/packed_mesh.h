#pragma once
/// The mesh of a capture as the graphics card takes it. Making it needs no context: any thread may.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/capture_mesh.h"
#include "engine/view/frame.h"
#include "engine/view/view_settings.h"

namespace acentric {

/// What a mesh is built from and for.
struct MeshTask {
  std::weak_ptr<const DisplayCapture> capture;
  int camera = 0;
  std::string name;  ///< of the capture, for messages
  double reach = 0;  ///< eyeReach, metres
  double error = 0;  ///< ViewSettings, as the next
  int maxTriangles = 0;
  std::size_t largestBuffer = 0;  ///< bytes

  bool isFor(const ViewSettings& settings) const {
    return error == settings.meshError && maxTriangles == settings.maxMeshTriangles;
  }
  /// Do both ask for the same mesh of the same capture?
  bool sameAs(const MeshTask& other) const;
};

/// Patches and their samples, as much as one buffer holds.
struct PackedChunk {
  std::vector<MeshPatch> patches;     ///< first samples count from the chunk's texels
  std::vector<glm::uvec2> texels;     ///< a sample each: inverse distance | roles, colour | fringes
  std::vector<std::uint8_t> mirrors;  ///< a byte each, in whole words; none without mirrors
};

struct PackedMesh {
  std::vector<PackedChunk> chunks;
  std::vector<float> borders;  ///< two floats a column border (direction), one a row border (tangent)
  MeshBound bound;
  int widestPatch = 0;  ///< columns
  MeshCost cost;        ///< without the bytes

  std::size_t bytes() const;
};

/// `capture` is the task's. Fails on one whose arrays contradict each other, and when stopped.
Result<PackedMesh> packMesh(const DisplayCapture& capture, const MeshTask& task, TaskRunner& runner,
                            const std::stop_token& stop = {});

}  // namespace acentric
